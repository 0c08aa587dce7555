// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <thread>

#include <yoke/tests/integrators/mechanisms.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

bool same_bits(const Result& a, const Result& b) {
  if (a.samples.rows() != b.samples.rows()) return false;
  for (std::size_t i = 0; i < a.samples.rows(); ++i)
    for (std::size_t j = 0; j < a.samples.names().size(); ++j) {
      const double x = a.samples.value(i, j), y = b.samples.value(i, j);
      if (std::memcmp(&x, &y, sizeof x) != 0) return false;
    }
  return a.summary.steps == b.summary.steps && a.events.size() == b.events.size();
}

double worst_difference(const Result& a, const Result& b, const std::string& column, double shift) {
  return (a[column].array() - b[column].array() + shift).abs().maxCoeff();
}

}  // namespace

TEST_CASE("same inputs give the same bits, run twice and on several threads") {
  const Model model = scotch_yoke();
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "generalised-alpha"}) {
    INFO(formulation);
    const SimulationOptions options{
        .until = yoke_period, .relative_tolerance = 1e-7, .formulation = formulation};
    const Result first = simulate(model, options);
    Result runs[3];
    std::thread threads[3];
    for (int i = 0; i < 3; ++i)
      threads[i] = std::thread([&, i] { runs[i] = simulate(model, options); });
    for (std::thread& thread : threads) thread.join();
    CHECK(first.summary.events > 10);
    for (const Result& run : runs) CHECK(same_bits(first, run));
    CHECK(same_bits(first, simulate(model, options)));
  }
}

TEST_CASE("explicit steps do not know where the origin is") {
  const SimulationOptions options{.until = 1.0, .relative_tolerance = 1e-8, .samples = 11};
  const Result here = simulate(double_pendulum(), options);
  const Result there = simulate(double_pendulum({1000.0, -1000.0}), options);
  CHECK(here.summary.steps == there.summary.steps);
  CHECK(here.summary.time_scale == there.summary.time_scale);
  // Coordinates of 1 km are rounded to 1e-13 m; the motion amplifies that a hundredfold.
  CHECK(worst_difference(here, there, "b.x_m", 1000.0) < 1e-10);
  CHECK(worst_difference(here, there, "b.angle_rad", 0.0) < 1e-10);
  CHECK(worst_difference(here, there, "elbow.fx_N", 0.0) < 1e-8);
}

TEST_CASE(
    "a kilometre away and a hundred turns later the error against the reference is the same") {
  const double exact = -2.3851873498861929707;  // angle of the second rod after 1 s
  for (const std::string formulation : {"arkode-projection", "ida-ggl"}) {
    for (const double rtol : {1e-7, 1e-9, 1e-11}) {
      INFO(formulation, " ", rtol);
      const SimulationOptions options{
          .until = 1.0, .relative_tolerance = rtol, .formulation = formulation, .samples = 2};
      const double here = simulate(double_pendulum(), options)["b.angle_rad"](1);
      const double there =
          simulate(double_pendulum({1000.0, -1000.0}, 100), options)["b.angle_rad"](1) - 200.0 * pi;
      CHECK(std::abs(there - exact) < 10.0 * std::abs(here - exact) + 1e-10);
    }
  }
}

TEST_CASE("the scotch-yoke after a hundred revolutions meets the same contacts") {
  const SimulationOptions options{.until = 0.1 * yoke_period, .relative_tolerance = 1e-11};
  const Result here = simulate(scotch_yoke(), options);
  const Result later = simulate(scotch_yoke({.start_angle = -31.0_deg + 200.0 * pi}), options);
  const Result away = simulate(scotch_yoke({.origin = {1000.0, 0.0}}), options);
  REQUIRE(here.events.size() >= 4);
  for (const Result* other : {&later, &away}) {
    REQUIRE(other->events.size() == here.events.size());
    for (std::size_t i = 0; i < here.events.size(); ++i) {
      CHECK(other->events[i].kind == here.events[i].kind);
      CHECK(std::abs(other->events[i].t - here.events[i].t) < 1e-8);
    }
  }
}
