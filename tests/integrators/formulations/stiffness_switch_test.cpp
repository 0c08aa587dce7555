// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Where stability bounds explicit steps, that is seen; and what methods without stages see of a driver.
// Who goes on then is tested with cases: tests/cases/friction/stiff_runs_test.cpp.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <yoke/core/motion_laws.hpp>
#include <yoke/integrators/formulations/explicit/explicit_pairs.hpp>
#include <yoke/integrators/formulations/explicit/own_step.hpp>
#include <yoke/integrators/formulations/explicit/stability_watch.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>

namespace {

using namespace yoke;

/// y = (q, v) with v' = -stiffness q - damping v, seen by steps of h.
bool is_bounded(double stiffness, double damping, double h) {
  const ExplicitPair& pair = explicit_pair(5);
  StabilityWatch watch({1.0, 1.0}, 1);
  watch.bound(pair.stable);
  std::vector<std::vector<double>> stages(2, std::vector<double>(2));
  int at = 0;
  const auto rates = [&](double t, const double* y, double* y_dot) {
    y_dot[0] = y[1];
    y_dot[1] = -stiffness * y[0] - damping * y[1];
    std::vector<double>& kept = stages[static_cast<std::size_t>(at++ % 2)];
    kept = {y_dot[0], y_dot[1]};
    watch.see(t, y, kept.data());
    return true;
  };
  OwnStep step(2, rates);
  double y[] = {1.0, 0.0}, next[2];
  for (int i = 0; i < 40; ++i) {
    watch.begin_step();
    step.from(i * h, y);
    REQUIRE(step.to((i + 1) * h, next));
    step.rate((i + 1) * h, next);  // its last stage
    watch.end_step(h);
    std::copy_n(next, 2, y);
  }
  return watch.bounds_steps();
}

TEST_CASE("steps are seen to be bounded by stability where damping or stiffness bounds them") {
  CHECK(is_bounded(1.0, 1000.0, 3e-3));
  CHECK_FALSE(is_bounded(1.0, 1000.0, 1e-3));
  CHECK(is_bounded(1e6, 1000.0, 2.5e-3));
  CHECK_FALSE(is_bounded(1e6, 10.0, 2e-4));  // an oscillation that is followed
  CHECK_FALSE(is_bounded(1.0, 0.1, 0.1));
}

TEST_CASE("the stability of an explicit pair ends where a decaying solution grows") {
  CHECK(explicit_pair(5).stable == doctest::Approx(3.307).epsilon(1e-3));
  CHECK(explicit_pair(7).stable > explicit_pair(5).stable);
}

TEST_CASE("an own step that cannot keep the tolerance is none") {
  const auto rates = [](double, const double* y, double* y_dot) {
    y_dot[0] = -1e9 * (y[0] - 1.0);
    return true;
  };
  OwnStep step(1, rates);
  const double from = 0.0;
  double y = 0.0;
  step.from(0.0, &from);
  CHECK_FALSE(step.to(1.0, &y, [](const double* error) { return std::abs(*error) / 1e-8; }));
}

TEST_CASE("methods without stages see the stroke of a driver that stands at the start") {
  // Up, rest, down, rest: a step over all of it would find everything where it was.
  const auto slider = [] {
    Model m;
    const BodyId body = m.add(Body{.name = "slider", .mass = 1.0, .inertia = 1.0});
    m.add(DisplacementDriver{
        .name = "cam",
        .body = body,
        .along = {1.0, 0.0},
        .displacement =
            motion({{cycloidal, 1.0, 0.1}, {dwell, 1.0}, {cycloidal, 1.0, 0.0}, {dwell, 1.0}},
                   {.start = 0.0})});
    return m;
  };
  for (const char* formulation :
       {"ida-ggl", "ida-baumgarte", "cvode-projection", "generalised-alpha"}) {
    CAPTURE(formulation);
    const Result run = simulate(
        slider(),
        {.until = 4.0, .relative_tolerance = 1e-6, .formulation = formulation, .samples = 41});
    CHECK(run.summary.ok());
    CHECK(run.summary.steps >= 32);
    CHECK(run.samples.value(15, run.samples.index("slider.x_m")) == doctest::Approx(0.1));
  }
}

}  // namespace
