// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Violations and drifts of the constraints in the summary: of lengths and of angles, each with its unit.
#include <doctest/doctest.h>

#include <cmath>

#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>

namespace {

using namespace yoke;

/// A pendulum of a length, which swings in the same way whatever the length: only its pin constrains.
Model hung(double length) {
  Model m;
  const BodyId rod = m.add(Body{.name = "rod",
                                .mass = 2.0,
                                .inertia = 0.1 * length * length,
                                .pose = {{0.5 * length, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = rod, .at = {0.0, 0.0}});
  m.add(Gravity{.acceleration = {0.0, -10.0 * length}});
  return m;
}

/// A free body whose angle is driven: only the angle is constrained.
Model driven() {
  Model m;
  const BodyId disc = m.add(Body{.name = "disc", .mass = 2.0, .inertia = 0.1});
  m.add(AngleDriver{.name = "motor", .body = disc, .angle = time_function([](auto t) {
                                                     return 2.0 * sin(3.0 * t);
                                                   })});
  return m;
}

Summary summary_of(const Model& model) {
  const Result run = simulate(
      model,
      {.until = 2.0, .relative_tolerance = 1e-5, .formulation = "arkode-baumgarte", .samples = 21});
  REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
  return run.summary;
}

}  // namespace

TEST_CASE("violations of lengths and of angles are told apart, each in its unit") {
  const Summary pin = summary_of(hung(1.0)), motor = summary_of(driven());
  CHECK(pin.position_drift > 0.0);
  CHECK(pin.velocity_drift > 0.0);
  CHECK(pin.angle_drift == 0.0);
  CHECK(pin.angular_velocity_drift == 0.0);
  CHECK(pin.angle_violation == 0.0);
  CHECK(motor.angle_drift > 0.0);
  CHECK(motor.angular_velocity_drift > 0.0);
  CHECK(motor.position_drift == 0.0);
  CHECK(motor.velocity_drift == 0.0);
  CHECK(motor.position_violation == 0.0);
  // Metres follow the size of the model.
  const Summary large = summary_of(hung(1024.0));
  CHECK(large.position_drift == doctest::Approx(1024.0 * pin.position_drift).epsilon(0.01));
  CHECK(large.velocity_drift == doctest::Approx(1024.0 * pin.velocity_drift).epsilon(0.01));
}
