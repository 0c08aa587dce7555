// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Springs and loads in the motion of fixture.hpp; expectations worked out on paper.
#include <doctest/doctest.h>

#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/tests/joints/fixture.hpp>

using namespace yoke;
using namespace yoke::tests;

TEST_CASE("translational spring: ends (3, 4) apart, lengthening at 2.42 m/s") {
  const Trio m;
  // The end on b is at (4.08, 0.56) in its axes, which is (2, 3.6) now.
  const auto spring = TranslationalSpring{.name = "spring",
                                          .a = m.a,
                                          .b = m.b,
                                          .at_a = {1.0, 3.0},
                                          .at_b = {6.08, 3.56},
                                          .stiffness = 100.0,
                                          .damping = 10.0,
                                          .free_length = 4.5}
                          .build(m.model);
  const Loads x = evaluate(*spring, m.model, HandMotion(m).at());
  CHECK(near(x.Q, {44.52, 59.36, 0.0, -44.52, -59.36, 41.552}));
  CHECK(near(x.energy.potential, 0.5 * 100.0 * 0.25));
  CHECK(near(x.energy.dissipated_power, 10.0 * 2.42 * 2.42));
  CHECK(spring->dissipates());
}

TEST_CASE("translational spring: relaxed in the start pose if no free length is given") {
  const Trio m;
  const auto spring = TranslationalSpring{.name = "spring",
                                          .a = m.a,
                                          .b = m.b,
                                          .at_a = {1.0, 3.0},
                                          .at_b = {4.0, 7.0},
                                          .stiffness = 100.0}
                          .build(m.model);
  CHECK(near(spring->parameters()[2].value, 5.0));
  CHECK(spring->parameters()[2].name == "free_length");
}

TEST_CASE("translational spring: force and Jacobian stay finite when the ends meet") {
  Model model;
  const BodyId a = model.add({.name = "a", .mass = 1, .inertia = 1, .pose = {{0.5, 0.25}, 0}});
  for (const double free_length : {0.0, 0.3}) {
    const auto spring = TranslationalSpring{.name = "spring",
                                            .a = ground,
                                            .b = a,
                                            .at_a = {0.25, 0.25},
                                            .at_b = {0.5, 0.25},
                                            .stiffness = 40.0,
                                            .damping = 3.0,
                                            .free_length = free_length}
                            .build(model);
    std::vector<BodyMotion> bodies(2);
    bodies[1] = {0.25, 0.25, 0.0, 1.0, 0.0, 0.7, 0.2, 0.3};
    const Motion motion{.t = 0, .bodies = bodies, .inertia = model.bodies()};
    const Loads x = evaluate(*spring, model, motion);
    for (const double q : x.Q) CHECK(q == 0.0);
    std::vector<double> slope(36);
    const double parameters[] = {40.0, 3.0, free_length};
    spring->evaluate({.motion = motion, .parameters = parameters}, {.dQ_dq = slope.data()});
    for (const double s : slope) CHECK(std::isfinite(s));
  }
}

TEST_CASE("torsional spring: torque on b against its twist and rate") {
  const Trio m;
  const auto spring = TorsionalSpring{.name = "torsion",
                                      .a = m.a,
                                      .b = m.b,
                                      .stiffness = 8.0,
                                      .damping = 0.5,
                                      .free_angle = 0.1}
                          .build(m.model);
  const Loads x = evaluate(*spring, m.model, HandMotion(m).at());
  const double twist = std::atan2(0.28, 0.96) - 0.1;  // angle_b - angle_a by the addition theorem
  CHECK(near(x.Q, {0, 0, 8 * twist - 2.5, 0, 0, -8 * twist + 2.5}));
  CHECK(near(x.energy.potential, 4 * twist * twist));
  CHECK(near(x.energy.dissipated_power, 12.5));
}

TEST_CASE("gravity: weight of every body, also of those added later, and its potential") {
  Trio m;
  m.model.add(Gravity{.acceleration = {0.5, -10.0}});
  m.model.add({.name = "late", .mass = 4.0, .inertia = 1.0});
  const ForceElement& gravity = *m.model.forces().front();
  CHECK(gravity.bodies(m.model).size() == 4);
  std::vector<BodyMotion> bodies(5);
  bodies[4] = {0.3, 0.6, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0};
  const Motion motion{.t = 0.0, .bodies = bodies, .inertia = m.model.bodies()};
  const Loads x = evaluate(gravity, m.model, motion);
  CHECK(near(x.Q, {1.25, -25, 0, 0.65, -13, 0, 0.4, -8, 0, 2, -40, 0}));
  CHECK(near(x.energy.potential, -4.0 * (0.15 - 6.0)));
}

TEST_CASE("applied force: in global axes, in axes of the body, and its power") {
  const Trio m;
  const auto f = [](double t) { return Vec2(10.0 * t, 5.0); };
  AppliedForce load{.name = "push", .body = m.b, .at = {2.5, 3.0}, .force = f};
  // The point is (0.3, 0.4) from the centre of b and moves at (-0.5, 0.9) - 3 (-0.4, 0.3).
  const Loads x = evaluate(*load.build(m.model), m.model, HandMotion(m).at(2.0));
  CHECK(near(x.Q, {20.0, 5.0, 0.3 * 5.0 - 0.4 * 20.0}));
  CHECK(near(x.energy.supplied_power, 20.0 * 0.7 + 5.0 * 0.0));
  load.frame = Frame::body;
  const Loads y = evaluate(*load.build(m.model), m.model, HandMotion(m).at(2.0));
  CHECK(near(y.Q, {12.0 - 4.0, 16.0 + 3.0, 0.5 * 5.0}));
}

TEST_CASE("loads that depend on the state equal the same loads written as functions of time") {
  const Trio m;
  const HandMotion motion(m);
  const auto drag = applied_force("drag", m.b, {2.5, 3.0}, [](auto t, const auto& b) {
    return vec(-2.0 * b.vx + t, 3.0 * b.omega);
  });
  const Loads x = evaluate(*drag.build(m.model), m.model, motion.at(0.25));
  const auto same =
      AppliedForce{.name = "drag", .body = m.b, .at = {2.5, 3.0}, .force = [](double) {
                     return Vec2(1.25, -9.0);
                   }};
  const Loads y = evaluate(*same.build(m.model), m.model, motion.at(0.25));
  CHECK(near(x.Q, y.Q));
  CHECK(near(x.energy.supplied_power, y.energy.supplied_power));
  const auto motor =
      applied_torque("motor", m.b, [](auto, const auto& b) { return 4.0 - 0.5 * b.omega; });
  const Loads z = evaluate(*motor.build(m.model), m.model, motion.at());
  CHECK(near(z.Q, {0.0, 0.0, 5.5}));
  CHECK(near(z.energy.supplied_power, -16.5));
  CHECK(motor.build(m.model)->supplies());
}
