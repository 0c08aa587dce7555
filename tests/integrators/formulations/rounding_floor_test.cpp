// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Accuracy that does not depend on bystanders, and tolerances below rounding.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/wall.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// Speed of a ball that has bounced on a floor without loss, beside others that only fall.
double bounced_speed(int bystanders, const std::string& formulation) {
  Model m;
  const BodyId ball =
      m.add(Body{.name = "ball", .mass = 1.0, .inertia = 0.01, .pose = {{0.0, 0.1}, 0.0}});
  for (int i = 0; i < bystanders; ++i)
    m.add(Body{.name = "bystander " + std::to_string(i),
               .mass = 1.0,
               .inertia = 0.01,
               .pose = {{0.01 * (i + 1), 0.1}, 0.0}});
  m.add(Gravity{});
  m.add(Wall{.name = "floor", .body = ball, .law = ContactLaw(PowerLaw{.K = 1e7, .n = 1.5})});
  // The same scales for both: only the norm may differ.
  const Result run = simulate(m, {.until = 0.2,
                                  .relative_tolerance = 1e-9,
                                  .formulation = formulation,
                                  .samples = 2,
                                  .length_scale = 0.1,
                                  .time_scale = 0.1});
  REQUIRE(run.summary.ok());
  const auto& e = run.events;
  REQUIRE(e.size() == 2);
  return std::abs(e[1].speed / e[0].speed + 1.0);
}

}  // namespace

TEST_CASE("bodies that only fall do not change the accuracy of one that bounces") {
  for (const char* formulation : {"arkode-projection", "ida-ggl", "cvode-projection"}) {
    const std::string name = formulation;
    INFO(name);
    const double alone = bounced_speed(0, name), among_many = bounced_speed(300, name);
    CHECK(among_many < 3.0 * alone + 1e-12);
  }
}

TEST_CASE("the tightest tolerance is reached, and a note says where rounding bounds it") {
  for (const char* formulation : {"ida-ggl", "cvode-projection", "arkode-projection"}) {
    const std::string name = formulation;
    INFO(name);
    const Result run = simulate(
        scotch_yoke(),
        {.until = yoke_period, .relative_tolerance = 1e-13, .formulation = name, .samples = 2});
    INFO(run.summary.reason);
    REQUIRE(run.summary.ok());
    CHECK(run.summary.steps < 100000);
    if (name == "arkode-projection") continue;
    const auto about_rounding = [](const std::string& s) { return s.starts_with("rounding"); };
    CHECK(std::ranges::count_if(run.summary.notes, about_rounding) == 1);
  }
}

TEST_CASE("a thousand turns cost an explicit run no digit of what is driven by them") {
  // A pendulum on a rotor that spins freely: in the rotor's frame it rests.
  Model m;
  const BodyId rotor = m.add(
      Body{.name = "rotor", .mass = 1.0, .inertia = 1.0, .pose = {}, .twist = {{0.0, 0.0}, 50.0}});
  const BodyId bob = m.add(Body{.name = "bob",
                                .mass = 0.1,
                                .inertia = 1e-4,
                                .pose = {{0.3, 0.0}, 0.0},
                                .twist = {{0.0, 15.0}, 50.0}});
  m.add(Revolute{.name = "bearing", .a = ground, .b = rotor, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "pin", .a = rotor, .b = bob, .at = {0.1, 0.0}});
  const double turns = 1000.0;
  const Result run = simulate(m, {.until = 2.0 * pi * turns / 50.0,
                                  .relative_tolerance = 1e-12,
                                  .formulation = "arkode-projection",
                                  .samples = 2});
  INFO(run.summary.reason);
  REQUIRE(run.summary.ok());
  CHECK(std::abs(run["rotor.omega_rad_per_s"](1) - 50.0) < 1e-9);
  CHECK(std::abs(run["rotor.angle_rad"](1) - 2.0 * pi * turns) < 1e-7);
  CHECK(std::abs(run["bob.angle_rad"](1) - run["rotor.angle_rad"](1)) < 1e-9);
}

// Random mechanism 24312, made smaller.
TEST_CASE(
    "a falling weight that jerks a chain of light links straight is followed through the jerk") {
  for (const char* formulation : {"cvode-projection", "ida-ggl", "arkode-projection"}) {
    const std::string name = formulation;
    INFO(name);
    Model m;
    const BodyId upper =
        m.add(Body{.name = "upper", .mass = 4.3, .inertia = 0.061, .pose = {{0.24, -0.08}, 0.0}});
    const BodyId middle =
        m.add(Body{.name = "middle", .mass = 1.5, .inertia = 0.015, .pose = {{0.42, -0.28}, 0.0}});
    const BodyId lower =
        m.add(Body{.name = "lower", .mass = 2.0, .inertia = 0.017, .pose = {{0.34, -0.62}, 0.0}});
    const BodyId weight =
        m.add(Body{.name = "weight", .mass = 9.7e6, .inertia = 3e4, .pose = {{0.48, -0.76}, 0.0}});
    m.add(Revolute{.name = "hook", .a = ground, .b = upper, .at = {0.13, -0.11}});
    m.add(Revolute{.name = "pin 1", .a = upper, .b = middle, .at = {0.29, -0.25}});
    m.add(Revolute{.name = "pin 2", .a = middle, .b = lower, .at = {0.44, -0.51}});
    m.add(Distance{
        .name = "rod", .a = lower, .b = weight, .at_a = {0.29, -0.7}, .at_b = {0.61, -0.78}});
    m.add(Gravity{.acceleration = {-0.25, -1.0}});
    const Result run =
        simulate(m, {.until = 0.85, .relative_tolerance = 1e-9, .formulation = name, .samples = 2});
    CHECK_MESSAGE(run.summary.ok(), run.summary.reason);
    CHECK(std::abs(run.summary.energy_balance) < 1e-5 * run.summary.energy_exchanged);
    CHECK(run.summary.steps < 20000);
  }
}
