// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Joints in the motion of fixture.hpp. The expectations were worked out on paper from the
// positions, velocities and centripetal accelerations of the points; the derivatives are checked
// elsewhere.
#include <doctest/doctest.h>

#include <yoke/joints/distance.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/gear.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/joints/weld.hpp>
#include <yoke/tests/joints/fixture.hpp>

using namespace yoke;
using namespace yoke::tests;

namespace {
const double angle_a = std::atan2(0.6, 0.8);
const double angle_b = std::atan2(0.8, 0.6);
}  // namespace

TEST_CASE("revolute: a pin with arms (1.2, 0.9) on a and (0.3, 0.4) on b") {
  const Trio m;
  const HandMotion motion(m);
  // Arms 1.5 on a and 0.5 on b along their x axes: the pin started at (2.5, 3).
  const auto joint = Revolute{.name = "pin", .a = m.a, .b = m.b, .at = {2.5, 3.0}}.build(m.model);
  const Blocks x = evaluate(*joint, motion.at(), {10.0, -20.0});
  CHECK(near(x.phi, {2.5 - 2.4, 3.0 - 3.1}));
  CHECK(near(x.G, {-1, 0, 0.9, 1, 0, -0.4, 0, -1, -1.2, 0, 1, 0.3}));
  CHECK(near(x.phi_t, {0, 0}));
  CHECK(near(x.gamma, {9 * 0.3 - 4 * 1.2, 9 * 0.4 - 4 * 0.9}));
  CHECK(near(x.H, {0, 0, 2.4, 0, 0, 0.9, 0, 0, 1.8, 0, 0, 1.2}));
  std::vector<double> K(36);
  K[14] = 1.2 * 10 - 0.9 * 20, K[35] = -(0.3 * 10 - 0.4 * 20);
  CHECK(near(x.K, K));
  CHECK((joint->reaction_point(motion.at()) - Vec2(2.5, 3.0)).norm() < 1e-14);
  CHECK(joint->equations()[0].label == "x");
  CHECK(joint->equations()[1].label == "y");
  CHECK(!joint->rheonomic());
}

TEST_CASE("weld: the centre of b keeps its place on a, one metre from its centre") {
  const Trio m;
  const auto joint = Weld{.name = "weld", .a = m.a, .b = m.b}.build(m.model);
  const Blocks x = evaluate(*joint, HandMotion(m).at(), {10.0, -20.0, 5.0});
  CHECK(near(x.phi, {2.2 - 2.0, 2.6 - 2.8, angle_b - angle_a}));
  CHECK(near(x.G, {-1, 0, 0.6, 1, 0, 0, 0, -1, -0.8, 0, 1, 0, 0, 0, -1, 0, 0, 1}));
  CHECK(near(x.gamma, {-4 * 0.8, -4 * 0.6, 0}));
  CHECK(joint->equations()[2].measure == Measure::angle);
}

TEST_CASE("prismatic: seen from a, b is displaced across the guide and turned") {
  const Trio m;
  const HandMotion motion(m);
  const auto joint =
      Prismatic{.name = "guide", .a = m.a, .b = m.b, .along = {7.0, 0.0}}.build(m.model);
  const Blocks x = evaluate(*joint, motion.at(), {10.0, -20.0});
  // Normal (-0.6, 0.8), from centre to centre (1, 0.4), relative velocity (-0.9, 1.6).
  CHECK(near(x.phi, {angle_b - angle_a, -0.28}));
  CHECK(near(x.G, {0, 0, -1, 0, 0, 1, 0.6, -0.8, -1.04, -0.6, 0.8, 0}));
  CHECK(near(x.gamma, {0, 4 * -0.28 - 2 * 2 * -0.24}));
  CHECK(joint->equations()[0].label == "rotation");
  CHECK(joint->equations()[1].label == "transverse");
  CHECK(near(joint->reaction_point(motion.at()).x(), 2.2));
}

TEST_CASE("prismatic: a guide along an axis of the ground needs two entries of G on the slider") {
  const Trio m;
  const auto joint = Prismatic{.name = "guide", .a = ground, .b = m.b}.build(m.model);
  int entries = 0;
  for (int row = 0; row < 2; ++row)
    for (int column = 3; column < 6; ++column) entries += joint->in_pattern(row, column) ? 1 : 0;
  CHECK(entries == 2);
}

TEST_CASE("distance: a rod of 5 m whose ends are (-1, 4.4) apart") {
  const Trio m;
  const auto joint =
      Distance{.name = "rod", .a = m.a, .b = m.b, .at_a = {1.0, 3.0}, .at_b = {4.0, 7.0}}.build(
          m.model);
  const Blocks x = evaluate(*joint, HandMotion(m).at());
  CHECK(near(x.phi[0], (1.0 + 19.36 - 25.0) / 10.0));
  CHECK(near(x.G, {0.2, -0.88, 0, -0.2, 0.88, -0.96}));
  // Relative velocity (11.1, 7.6), of which w^2 d gives 35.28 back.
  CHECK(near(x.gamma[0], -(180.97 / 5.0 - 35.28)));
}

TEST_CASE("distance: a given length is kept instead of the start distance") {
  const Trio m;
  const auto joint =
      Distance{
          .name = "rod", .a = m.a, .b = m.b, .at_a = {1.0, 3.0}, .at_b = {4.0, 7.0}, .length = 4.0}
          .build(m.model);
  CHECK(near(evaluate(*joint, HandMotion(m).at()).phi[0], (20.36 - 16.0) / 8.0));
}

TEST_CASE("point on line: a point of a beside a line fixed in b") {
  const Trio m;
  const auto joint = PointOnLine{
      .name = "slot",
      .a = m.a,
      .at = {1.5, 3.0},
      .b = m.b,
      .through = {2.0, 4.0},
      .along = {0.0,
                3.0}}.build(m.model);
  const Blocks x = evaluate(*joint, HandMotion(m).at());
  // The line runs through the centre of b; its normal is now (-0.6, -0.8), the point at (1.6, 2.5).
  CHECK(near(x.phi[0], 0.44));
  CHECK(near(x.G[0], -0.6));
  CHECK(near(x.G[1], -0.8));
  CHECK(near(x.G[2], -0.4 * 0.8 + 0.3 * 0.6));
}

TEST_CASE("gear: external wheels counter-rotate, seen from the carrier") {
  const Trio m;
  const HandMotion motion(m);
  const auto fixed = Gear{.name = "mesh", .a = m.a, .b = m.b, .ratio = -0.5}.build(m.model);
  const Blocks x = evaluate(*fixed, motion.at());
  CHECK(near(x.phi[0], angle_b + 0.5 * angle_a));
  CHECK(near(x.G, {0, 0, 0.5, 0, 0, 1, 0, 0, -1.5}));
  const auto epicyclic =
      Gear{.name = "mesh", .a = m.a, .b = m.b, .carrier = m.c, .ratio = -0.5}.build(m.model);
  CHECK(near(evaluate(*epicyclic, motion.at()).phi[0], angle_b + 0.5 * angle_a));  // c stood still
}

TEST_CASE("angle driver: the angle of the body itself, or against another body") {
  const Trio m;
  const HandMotion motion(m);
  const AngleDriver driver{.name = "motor", .body = m.b, .angle = constant_speed(0.2, 3.0)};
  const Blocks x = evaluate(*driver.build(m.model), motion.at(0.5));
  CHECK(near(x.phi[0], angle_b - 1.7));
  CHECK(near(x.phi_t[0], -3.0));
  CHECK(near(x.gamma[0], 0.0));
  CHECK(near(x.G, {0, 0, -1, 0, 0, 1}));
  CHECK(driver.build(m.model)->rheonomic());

  const AngleDriver relative{.name = "motor",
                             .body = m.b,
                             .relative_to = m.a,
                             .angle = time_function([](auto t) { return 0.4 * t * t; })};
  const Blocks y = evaluate(*relative.build(m.model), motion.at(0.5));
  CHECK(near(y.phi[0], angle_b - angle_a - 0.1));
  CHECK(near(y.gamma[0], 0.8));
}

TEST_CASE("displacement driver: counts from the start pose unless told otherwise") {
  const Trio m;
  const HandMotion motion(m);
  DisplacementDriver driver{.name = "cylinder",
                            .body = m.b,
                            .at = {2.0, 3.0},
                            .along = {0.6, 0.8},
                            .displacement = time_function([](auto t) { return 0.7 * t * t; })};
  const Blocks x = evaluate(*driver.build(m.model), motion.at(2.0));
  CHECK(near(x.phi[0], 0.6 * 0.2 + 0.8 * -0.4 - 2.8));
  CHECK(near(x.phi_t[0], -2.8));
  CHECK(near(x.gamma[0], 1.4));
  driver.from = Vec2(0.0, 0.0);
  CHECK(near(evaluate(*driver.build(m.model), motion.at(2.0)).phi[0], 0.6 * 2.2 + 0.8 * 2.6 - 2.8));
}
