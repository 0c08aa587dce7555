// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <cmath>

#include <yoke/core/motion_laws.hpp>
#include <yoke/core/types.hpp>
#include <yoke/core/units.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::literals;
using yoke::tests::contains;
using yoke::tests::message_of;

namespace {

/// The largest |what| of a law over 0 ... 1.
double peak_of(const MotionLaw& law, double MotionValue::*what) {
  double most = 0.0;
  for (int i = 0; i <= 100000; ++i) most = std::max(most, std::abs(law.at(1e-5 * i).*what));
  return most;
}

// Derivatives by central differences, fourth order.
template <class F>
double slope_of(const F& f, double x, double MotionValue::*what, double h = 1e-4) {
  const auto g = [&](double at) { return f(at).*what; };
  return (8.0 * (g(x + h) - g(x - h)) - (g(x + 2 * h) - g(x - 2 * h))) / (12.0 * h);
}

template <class F>
void check_derivatives(const F& f, double x) {
  CAPTURE(x);
  CHECK(std::abs(slope_of(f, x, &MotionValue::value) - f(x).first) < 1e-9);
  CHECK(std::abs(slope_of(f, x, &MotionValue::first) - f(x).second) < 1e-8);
  CHECK(std::abs(slope_of(f, x, &MotionValue::second) - f(x).third) < 1e-6);
}

}  // namespace

TEST_CASE("laws of motion: they rise from 0 to 1, with exact derivatives") {
  CHECK(motion_laws().size() == 10);
  for (const MotionLaw& law : motion_laws()) {
    CAPTURE(law.name);
    CHECK(std::abs(law.at(0.0).value) < 1e-15);
    CHECK(std::abs(law.at(1.0).value - (law.name == "dwell" ? 0.0 : 1.0)) < 1e-15);
    // Away from eighths, where second or third derivatives of the modified laws jump.
    for (const double x : {0.06, 0.11, 0.19, 0.31, 0.42, 0.47, 0.56, 0.69, 0.81, 0.93})
      check_derivatives(law.at, x);
  }
}

TEST_CASE("laws of motion: the pieces of the modified laws join up to the acceleration") {
  for (const MotionLaw& law : {modified_sine, modified_trapezoid})
    for (int i = 1; i < 8; ++i) {
      const MotionValue left = law.at(i / 8.0 - 1e-13), right = law.at(i / 8.0 + 1e-13);
      CAPTURE(law.name);
      CAPTURE(i);
      CHECK(std::abs(left.value - right.value) < 1e-12);
      CHECK(std::abs(left.first - right.first) < 1e-11);
      CHECK(std::abs(left.second - right.second) < 1e-10);
    }
}

TEST_CASE("laws of motion: peaks of velocity and acceleration in closed form") {
  const double root3 = std::sqrt(3.0), root5 = std::sqrt(5.0);
  struct Peaks {
    MotionLaw law;
    double velocity, acceleration;
  };
  for (const Peaks& p :
       {Peaks{constant_velocity, 1.0, 0.0}, Peaks{simple_harmonic, pi / 2.0, pi * pi / 2.0},
        Peaks{cycloidal, 2.0, 2.0 * pi},
        Peaks{modified_sine, 4.0 * pi / (4.0 + pi), 4.0 * pi * pi / (4.0 + pi)},
        Peaks{modified_trapezoid, 2.0, 8.0 * pi / (2.0 + pi)},
        Peaks{polynomial_345, 1.875, 10.0 / root3},
        Peaks{polynomial_4567, 2.1875, 84.0 * root5 / 25.0}, Peaks{cycloidal_start, 2.0, pi},
        Peaks{cycloidal_end, 2.0, pi}}) {
    CAPTURE(p.law.name);
    CHECK(std::abs(peak_of(p.law, &MotionValue::first) - p.velocity) < 1e-8);
    CHECK(std::abs(peak_of(p.law, &MotionValue::second) - p.acceleration) < 1e-6);
  }
  // As the handbooks print them.
  CHECK(peak_of(modified_sine, &MotionValue::first) == doctest::Approx(1.7596).epsilon(1e-4));
  CHECK(peak_of(modified_sine, &MotionValue::second) == doctest::Approx(5.528).epsilon(1e-4));
  CHECK(peak_of(modified_trapezoid, &MotionValue::second) == doctest::Approx(4.888).epsilon(1e-4));
  CHECK(peak_of(polynomial_345, &MotionValue::second) == doctest::Approx(5.7735).epsilon(1e-5));
  CHECK(peak_of(polynomial_4567, &MotionValue::second) == doctest::Approx(7.5132).epsilon(1e-5));
}

TEST_CASE("a cam's lift: rise, dwell, return, dwell, over and over") {
  const MotionChain lift = motion({{cycloidal, 120.0_deg, 20.0_mm},
                                   {dwell, 60.0_deg},
                                   {polynomial_345, 90.0_deg, 0.0},
                                   {dwell, 90.0_deg}},
                                  {.repeat = Repeat::periodic});
  CHECK(lift.period() == doctest::Approx(2.0 * pi).epsilon(1e-15));
  CHECK(lift(60.0_deg).value == doctest::Approx(10.0_mm).epsilon(1e-14));
  CHECK(lift(60.0_deg).first == doctest::Approx(2.0 * 20.0_mm / 120.0_deg).epsilon(1e-14));
  CHECK(lift(150.0_deg).value == 20.0_mm);
  CHECK(lift(150.0_deg).first == 0.0);
  CHECK(lift(225.0_deg).value == doctest::Approx(10.0_mm).epsilon(1e-13));
  CHECK(lift(300.0_deg).value == 0.0);
  for (const double x : {0.2, 1.9, 3.5, 4.4}) {
    check_derivatives(lift, x);
    for (const double turns : {-3.0, -1.0, 1.0, 40.0}) {
      CHECK(std::abs(lift(x + turns * 2.0 * pi).value - lift(x).value) < 1e-15);
      CHECK(std::abs(lift(x + turns * 2.0 * pi).second - lift(x).second) < 1e-13);
    }
  }
}

TEST_CASE("a chain starts anywhere, holds its ends, and advances if it is to") {
  const MotionChain once =
      motion({{modified_sine, 0.5, 3.0}, {dwell, 0.2}, {simple_harmonic, 0.3, 1.0}},
             {.start = 2.0, .begin = -1.0});
  CHECK(once.begin() == -1.0);
  CHECK(once.end() == doctest::Approx(0.0).epsilon(1e-15));
  CHECK(once(-7.0).value == 2.0);
  CHECK(std::abs(once(7.0).value - 1.0) < 1e-15);
  CHECK(once(7.0).first == 0.0);
  CHECK(once(-0.4).value == 3.0);
  CHECK(std::isinf(once.period()));

  const MotionChain index =
      motion({{polynomial_4567, 0.4, 60.0_deg}, {dwell, 0.6}}, {.repeat = Repeat::advancing});
  for (const double t : {0.1, 0.2, 0.35, 0.7}) {
    CHECK(index(t + 5.0).value == doctest::Approx(index(t).value + 300.0_deg).epsilon(1e-14));
    CHECK(index(t - 2.0).value == doctest::Approx(index(t).value - 120.0_deg).epsilon(1e-14));
    CHECK(index(t + 5.0).first == doctest::Approx(index(t).first).epsilon(1e-10));
  }
}

TEST_CASE("run up, constant velocity, run down: the velocity is continuous and goes on") {
  // 2 m/s from 0.1 s to 0.4 s: the run up covers half of what the full speed would.
  const MotionChain travel = motion(
      {{cycloidal_start, 0.1, 0.1}, {constant_velocity, 0.3, 0.7}, {cycloidal_end, 0.1, 0.8}});
  for (const double t : {0.11, 0.25, 0.39}) {
    CHECK(travel(t).first == doctest::Approx(2.0).epsilon(1e-14));
    CHECK(travel(t).second == 0.0);
  }
  for (const double t : {0.03, 0.07, 0.43, 0.48}) check_derivatives(travel, t);
  CHECK(travel(0.6).value == doctest::Approx(0.8));
  CHECK(std::abs(travel(0.6).first) < 1e-14);

  const MotionChain forever = motion({{cycloidal_start, 0.1, 0.1}, {constant_velocity, 0.3, 0.7}});
  CHECK(forever(2.4).value == doctest::Approx(0.7 + 2.0 * 2.0).epsilon(1e-14));
  CHECK(forever(2.4).first == doctest::Approx(2.0).epsilon(1e-14));
  CHECK(forever(-2.0).value == 0.0);
}

TEST_CASE("a motion is a function of time for a driver") {
  const TimeFunction f = motion({{cycloidal, 2.0, 0.5}});
  CHECK(f(1.0).value == doctest::Approx(0.25));
  CHECK(f(1.0).rate == doctest::Approx(0.5));
  CHECK(f(0.5).acceleration == doctest::Approx(0.5 / 4.0 * 2.0 * pi));
  CHECK(f(9.0).value == 0.5);
}

TEST_CASE("a chain that does not fit together is refused, and says where") {
  const auto refused = [](std::vector<MotionSegment> segments, MotionOptions options = {}) {
    return message_of([&] { motion(segments, options); });
  };
  CHECK(contains(refused({}), "no segments"));
  CHECK(contains(refused({{cycloidal, 0.0, 1.0}}), "segment 1 (cycloidal): over = 0 must be"));
  CHECK(contains(refused({{cycloidal, 1.0}}), "`to`, the value at its end, is missing"));
  CHECK(contains(refused({{cycloidal, 1.0, 2.0}, {dwell, 1.0, 3.0}}),
                 "segment 2 (dwell): to = 3, but a dwell stays at 2"));
  CHECK(contains(refused({{cycloidal, 1.0, NAN}}), "to = nan"));
  CHECK(contains(refused({{cycloidal, 1.0, 1.0}}, {.start = NAN}), "start = nan"));
  CHECK(contains(refused({{cycloidal, 1.0, 2.0}}, {.repeat = Repeat::periodic}),
                 "starts at 0 and ends at 2"));
  const std::string jump = refused({{cycloidal, 1.0, 2.0}, {constant_velocity, 0.5, 3.5}});
  CHECK(contains(jump, "velocity jumps from 0 to 3 at 1"));
  CHECK(contains(jump, "1 'cycloidal' and 2 'constant velocity'"));
  // Once around, too.
  const std::string around = refused({{constant_velocity, 0.5, 1.0}, {constant_velocity, 0.5, 2.0}},
                                     {.repeat = Repeat::advancing});
  CHECK(around == "no error");
  CHECK(contains(refused({{constant_velocity, 0.5, 1.0}, {cycloidal_end, 1.0, 2.0}},
                         {.repeat = Repeat::advancing}),
                 "velocity jumps from 0 to 2 at 1.5"));
  CHECK(contains(
      refused({{{"mine", [](double x) { return MotionValue{.value = 2.0 * x}; }}, 1.0, 1.0}}),
      "this one from 0 to 2"));
  CHECK(contains(refused({{MotionLaw{}, 1.0, 1.0}}), "needs its function"));
}
