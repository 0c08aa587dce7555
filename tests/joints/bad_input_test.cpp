// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Descriptions that make no sense are refused, with a message that says what to change.
#include <doctest/doctest.h>

#include <limits>

#include <yoke/joints/distance.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/gear.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/joints/weld.hpp>
#include <yoke/tests/joints/fixture.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::tests;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

template <class Description>
std::string refusal(const Trio& m, const Description& description) {
  return message_of([&] { description.build(m.model); });
}

}  // namespace

TEST_CASE("a joint given a body twice names the fields and the body") {
  const Trio m;
  CHECK(refusal(m, Revolute{.name = "pin", .a = m.a, .b = m.a}) ==
        "revolute 'pin': a and b are both body 'a'; give different bodies");
  CHECK(refusal(m, Weld{.name = "weld", .a = ground, .b = ground}) ==
        "weld 'weld': a and b are both body 'ground'; give different bodies");
  CHECK(refusal(m, AngleDriver{.name = "motor", .body = ground, .angle = constant(1.0)}) ==
        "angle driver 'motor': body and relative_to are both body 'ground'; give different bodies");
  CHECK(refusal(m, Gear{.name = "mesh", .a = m.a, .b = m.b, .carrier = m.b, .ratio = 2.0}) ==
        "gear 'mesh': b and carrier are both body 'b'; give different bodies");
}

TEST_CASE("a body of another model is unknown") {
  const Trio m;
  CHECK(refusal(m, Revolute{.name = "pin", .a = m.a, .b = BodyId{7}}) ==
        "revolute 'pin': b = body 7 is unknown; the model has bodies 0 to 3");
  CHECK(refusal(m, AppliedForce{.name = "push", .body = BodyId{-1}}) ==
        "applied force 'push': body = body -1 is unknown; the model has bodies 0 to 3");
}

TEST_CASE("an axis without length is refused") {
  const Trio m;
  CHECK(refusal(m, Prismatic{.name = "guide", .a = m.a, .b = m.b, .along = {0.0, 0.0}}) ==
        "prismatic 'guide': along = (0, 0) must have a finite length greater than 0");
  CHECK(refusal(m, PointOnLine{.name = "slot", .a = m.a, .b = m.b, .along = {0.0, 0.0}}) ==
        "point on line 'slot': along = (0, 0) must have a finite length greater than 0");
  CHECK(refusal(m, DisplacementDriver{.name = "jack", .body = m.a, .along = {0.0, 0.0}}) ==
        "displacement driver 'jack': along = (0, 0) must have a finite length greater than 0");
}

TEST_CASE("numbers that are not finite are refused") {
  const Trio m;
  CHECK(refusal(m, Revolute{.name = "pin", .a = m.a, .b = m.b, .at = {not_a_number, 1.0}}) ==
        "revolute 'pin': at = (nan, 1) must have finite components");
  CHECK(refusal(m, Prismatic{.name = "guide", .a = m.a, .b = m.b, .along = {1.0, infinity}}) ==
        "prismatic 'guide': along = (1, inf) must have finite components");
  CHECK(refusal(m, Gear{.name = "mesh", .a = m.a, .b = m.b, .ratio = not_a_number}) ==
        "gear 'mesh': ratio = nan must be a finite number");
  CHECK(refusal(m, Gravity{.acceleration = {0.0, not_a_number}}) ==
        "gravity 'gravity': acceleration = (0, nan) must have finite components");
  CHECK(refusal(m, AngleDriver{.name = "motor", .body = m.a, .angle = time_function([](auto t) {
                                                               return sqrt(t);
                                                             })}) ==
        "angle driver 'motor': rate of angle at t = 0 = inf must be a finite number");
  CHECK(message_of([] { smooth_ramp(0.0, not_a_number, 1.0); }) ==
        "smooth_ramp: speed = nan must be a finite number");
}

TEST_CASE("a rod or spring between one and the same place is refused") {
  const Trio m;
  CHECK(refusal(m, Distance{.name = "rod", .a = m.a, .b = m.b, .at_a = {1, 2}, .at_b = {1, 2}}) ==
        "distance 'rod': the distance from at_a = (1, 2) to at_b = (1, 2) is 0 m; it must be "
        "greater than 0 m");
  CHECK(refusal(m, TranslationalSpring{.name = "coil", .a = m.a, .b = m.b}) ==
        "translational spring 'coil': the distance from at_a = (0, 0) to at_b = (0, 0) is 0 m; it "
        "must be greater than 0 m");
  CHECK(refusal(m, Distance{.name = "rod", .a = m.a, .b = m.b, .at_b = {1, 2}, .length = 0.0}) ==
        "distance 'rod': length = 0 m must be finite and greater than 0 m");
}

TEST_CASE("constants out of range are refused") {
  const Trio m;
  CHECK(refusal(m, Gear{.name = "mesh", .a = m.a, .b = m.b}) ==
        "gear 'mesh': ratio = 0 must not be 0; it is -r_a / r_b for external gears, +r_a / r_b for "
        "internal ones");
  TranslationalSpring spring{.name = "coil", .a = m.a, .b = m.b, .at_b = {1.0, 2.0}};
  spring.stiffness = -2.0;
  CHECK(refusal(m, spring) ==
        "translational spring 'coil': stiffness = -2 N/m must be finite and at least 0 N/m");
  CHECK(refusal(m, TorsionalSpring{.name = "bar", .a = m.a, .b = m.b, .damping = -0.5}) ==
        "torsional spring 'bar': damping = -0.5 N m s/rad must be finite and at least 0 N m s/rad");
  CHECK(message_of([] { smooth_ramp(0.0, 1.0, -2.0); }) ==
        "smooth_ramp: duration = -2 s must be finite and at least 0 s");
}

TEST_CASE("a driver or load without its function is refused") {
  const Trio m;
  CHECK(refusal(m, AngleDriver{.name = "motor", .body = m.a}) ==
        "angle driver 'motor': angle is missing; give a function of time such as "
        "constant_speed(start, speed)");
  CHECK(refusal(m, AppliedForce{.name = "push", .body = m.a}) ==
        "applied force 'push': force is missing; give a function of time or a value");
  CHECK(refusal(m, AppliedTorque{.name = "twist", .body = m.a}) ==
        "applied torque 'twist': torque is missing; give a function of time or a value");
  CHECK(refusal(m, AppliedTorque{.name = "twist", .body = ground}) ==
        "applied torque 'twist': body is the ground; give a body that moves");
}
