// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <yoke/core/time_function.hpp>

using namespace yoke;

namespace {

// Derivatives of a function of time by central differences, fourth order.
double slope(const TimeFunction& f, double t, double TimeValue::*what) {
  const double h = 1e-3;
  const auto g = [&](double s) { return f(s).*what; };
  return (8.0 * (g(t + h) - g(t - h)) - (g(t + 2 * h) - g(t - 2 * h))) / (12.0 * h);
}

}  // namespace

TEST_CASE("constant speed") {
  const TimeValue x = constant_speed(0.5, -3.0)(2.0);
  CHECK(x.value == -5.5);
  CHECK(x.rate == -3.0);
  CHECK(x.acceleration == 0.0);
}

TEST_CASE("smooth ramp: rate and acceleration are the derivatives, before, during and after") {
  const TimeFunction f = smooth_ramp(0.3, 4.0, 0.7);
  for (const double t : {-0.4, 0.11, 0.35, 0.52, 0.66, 1.3}) {
    CAPTURE(t);
    CHECK(std::abs(slope(f, t, &TimeValue::value) - f(t).rate) < 1e-9);
    CHECK(std::abs(slope(f, t, &TimeValue::rate) - f(t).acceleration) < 1e-7);
  }
}

TEST_CASE("smooth ramp: joins rest and constant speed without a jump up to the jerk") {
  const double duration = 0.7, speed = 4.0, e = 1e-6;
  const TimeFunction f = smooth_ramp(0.3, speed, duration);
  CHECK(f(0.0).value == 0.3);
  CHECK(f(e).rate < 1e-14);
  CHECK(std::abs(f(e).acceleration) < 1e-9);
  CHECK(std::abs(f(duration - e).value - f(duration + e).value + 2 * e * speed) < 1e-12);
  CHECK(std::abs(f(duration - e).acceleration) < 1e-9);
  CHECK(std::abs(f(duration - e).acceleration - f(duration + e).acceleration) / e < 1e-2);
  // Half the duration is lost against full speed from the start.
  CHECK(std::abs(f(3.0).value - (0.3 + speed * (3.0 - 0.35))) < 1e-14);
}

TEST_CASE("smooth ramp of no duration is constant speed") {
  const TimeValue x = smooth_ramp(0.5, 2.0, 0.0)(0.0);
  CHECK(x.value == 0.5);
  CHECK(x.rate == 2.0);
}

TEST_CASE("a function of time from a lambda, given with its derivatives or without") {
  const TimeFunction by_hand([](double t) {
    return TimeValue{std::sin(3 * t), 3 * std::cos(3 * t), -9 * std::sin(3 * t)};
  });
  const TimeFunction automatic = time_function([](auto t) {
    const auto phase = 3.0 * t;
    return sin(phase);
  });
  for (const double t : {-0.2, 0.0, 1.7}) {
    CHECK(automatic(t).value == doctest::Approx(by_hand(t).value).epsilon(1e-14));
    CHECK(automatic(t).rate == doctest::Approx(by_hand(t).rate).epsilon(1e-14));
    CHECK(automatic(t).acceleration == doctest::Approx(by_hand(t).acceleration).epsilon(1e-14));
  }
  CHECK(time_function([](auto) { return 2.5; })(1.0).value == 2.5);
  CHECK(!TimeFunction());
}
