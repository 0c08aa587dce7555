// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Every element of the folder against differences of itself, in every combination of ground and
// moving bodies.
#include <doctest/doctest.h>

#include <utility>

#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/curves/smooth_curves.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/gear.hpp>
#include <yoke/joints/point_on_curve.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/joints/weld.hpp>
#include <yoke/tests/joints/fixture.hpp>

using namespace yoke;
using namespace yoke::tests;

namespace {

Trio ugly_trio() {
  Trio t;
  t.model = Model();
  t.a = t.model.add({.name = "a", .mass = 2.5, .inertia = 0.7, .pose = {{0.31, -0.72}, 0.43}});
  t.b = t.model.add({.name = "b", .mass = 1.3, .inertia = 0.4, .pose = {{-0.57, 0.88}, -1.19}});
  t.c = t.model.add({.name = "c", .mass = 0.8, .inertia = 0.2, .pose = {{0.93, 0.26}, 2.07}});
  return t;
}

template <class Description>
void check(const Trio& t, const Description& description, double tolerance = 1e-8) {
  const auto element = description.build(t.model);
  const ElementCheck result = check_element(*element, t.model);
  INFO(result.message());
  CHECK(result.ok(tolerance));
  CHECK(result.entries > 0);
}

const Vec2 p(0.12, 0.34);
const Vec2 r(-0.41, 0.27);

auto swing() {
  return time_function([](auto t) { return 0.3 + 0.8 * sin(2.0 * t) + 0.1 * t * t; });
}

}  // namespace

TEST_CASE("derivatives of the joints of two bodies agree with differences") {
  const Trio t = ugly_trio();
  const std::pair<BodyId, BodyId> pairs[] = {{t.a, t.b}, {ground, t.b}, {t.a, ground}};
  for (const auto& pair : pairs) {
    const BodyId a = pair.first, b = pair.second;
    CAPTURE(a.index);
    CAPTURE(b.index);
    check(t, Revolute{.name = "revolute", .a = a, .b = b, .at = p});
    check(t, Weld{.name = "weld", .a = a, .b = b});
    check(t, Weld{.name = "weld at", .a = a, .b = b, .at = p});
    check(t, Prismatic{.name = "prismatic", .a = a, .b = b, .along = r});
    check(t, Prismatic{.name = "prismatic x", .a = a, .b = b});
    check(t, Prismatic{.name = "prismatic at", .a = a, .b = b, .along = r, .at = p});
    check(t, Distance{.name = "distance", .a = a, .b = b, .at_a = p, .at_b = r});
    check(t, PointOnLine{.name = "slot", .a = a, .at = p, .b = b, .through = r, .along = {3, 4}});
    check(t, AngleDriver{.name = "angle", .body = a, .relative_to = b, .angle = swing()});
    check(t, DisplacementDriver{.name = "displacement",
                                .body = a,
                                .at = p,
                                .along = r,
                                .relative_to = b,
                                .displacement = swing()});
    check(t, AngleDriver{.name = "set angle", .body = a, .relative_to = b, .speed = 1.3});
    check(t, AngleDriver{
                 .name = "both", .body = a, .relative_to = b, .angle = swing(), .speed = -0.7});
    check(t, DisplacementDriver{.name = "set displacement",
                                .body = a,
                                .at = p,
                                .along = r,
                                .relative_to = b,
                                .from = Vec2(0.3, 0.1),
                                .speed = 0.9});
    check(t, Gear{.name = "gear", .a = a, .b = b, .carrier = t.c, .ratio = -1.7});
    check(t, Gear{.name = "belt", .a = a, .b = b, .carrier = t.c, .ratio = 1.0});
  }
  check(t, Gear{.name = "fixed axes", .a = t.a, .b = t.b, .ratio = 0.4});
}

TEST_CASE("derivatives of a point on any curve agree with differences") {
  const Trio t = ugly_trio();
  std::vector<Vec2> ring;
  for (int i = 0; i < 24; ++i) {
    const double a = 2.0 * pi * i / 24.0, size = 1.5 + 0.2 * std::cos(3.0 * a);
    ring.emplace_back(size * std::cos(a), size * std::sin(a));
  }
  const std::pair<BodyId, BodyId> pairs[] = {{t.a, t.b}, {ground, t.b}, {t.a, ground}};
  for (const auto& [a, b] : pairs) {
    const PointOnCurve on{.name = "track", .a = a, .at = p, .b = b, .curve = circle(r, 0.7)};
    check(t, on);
    PointOnCurve other = on;
    other.curve = straight_line(r, {3.0, 4.0});
    check(t, other);
    other.curve = curve_through(ring, {.closed = true});
    check(t, other, 1e-6);
    other.curve = polyline({{-2.0, -1.0}, {0.5, 0.1}, {2.0, 2.5}}, {.fillet = 0.5});
    check(t, other);
  }
}

TEST_CASE("a point on a line as a curve is the point on a line") {
  const Trio t = ugly_trio();
  const HandMotion motion(t);
  const auto curve =
      PointOnCurve{
          .name = "curve", .a = t.a, .at = p, .b = t.b, .curve = straight_line(r, {3.0, 4.0})}
          .build(t.model);
  const auto line =
      PointOnLine{.name = "line", .a = t.a, .at = p, .b = t.b, .through = r, .along = {3.0, 4.0}}
          .build(t.model);
  const Blocks first = evaluate(*curve, motion.at(), {1.7}),
               second = evaluate(*line, motion.at(), {1.7});
  CHECK(first.phi[0] == doctest::Approx(second.phi[0]).epsilon(1e-13));
  CHECK(first.gamma[0] == doctest::Approx(second.gamma[0]).epsilon(1e-12));
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(std::abs(first.G[i] - second.G[i]) < 1e-14);
    CHECK(std::abs(first.H[i] - second.H[i]) < 1e-13);
  }
  for (std::size_t i = 0; i < 36; ++i) CHECK(std::abs(first.K[i] - second.K[i]) < 1e-13);
}

TEST_CASE("a point at the centre of a body has no entry for its angle in the pattern") {
  const Trio t = ugly_trio();
  const Vec2 centre = t.model.body(t.b).pose.position;
  const Revolute revolute{.name = "revolute", .a = t.a, .b = t.b, .at = centre};
  check(t, revolute);
  CHECK(!revolute.build(t.model)->in_pattern(0, 5));
  CHECK(revolute.build(t.model)->in_pattern(0, 2));
}

TEST_CASE("derivatives and powers of springs agree with differences") {
  const Trio t = ugly_trio();
  const std::pair<BodyId, BodyId> pairs[] = {{t.a, t.b}, {ground, t.b}, {t.a, ground}};
  for (const auto& pair : pairs) {
    const BodyId a = pair.first, b = pair.second;
    check(t, TranslationalSpring{.name = "spring",
                                 .a = a,
                                 .b = b,
                                 .at_a = p,
                                 .at_b = r,
                                 .stiffness = 130.0,
                                 .damping = 17.0,
                                 .free_length = 0.37});
    check(t, TorsionalSpring{.name = "torsion",
                             .a = a,
                             .b = b,
                             .stiffness = 13.0,
                             .damping = 1.7,
                             .free_angle = 0.3});
  }
}

TEST_CASE("derivatives and powers of loads agree with differences") {
  const Trio t = ugly_trio();
  const auto push = [](double time) { return Vec2(3.0 + time, -2.0 * time); };
  check(t, Gravity{.acceleration = {1.3, -9.7}});
  check(t, AppliedForce{.name = "global", .body = t.b, .at = p, .force = push});
  check(t, AppliedForce{.name = "body", .body = t.b, .at = p, .force = push, .frame = Frame::body});
  check(t, AppliedTorque{.name = "torque", .body = t.b, .torque = [](double s) { return 2 + s; }});
  check(t, applied_force("wind", t.b, p, [](auto, const auto& b) {
          return vec(-0.3 * b.vx * b.vx, sin(b.angle) - 0.4 * b.vy);
        }));
  check(t, applied_force(
               "thrust", t.b, p, [](auto time, const auto& b) { return vec(2.0 + time, b.omega); },
               Frame::body));
  check(t, applied_torque("motor", t.b, [](auto time, const auto& b) {
          return 2.0 * (1.0 - b.omega / 75.0) * time;
        }));
}

TEST_CASE("all elements of a model are checked with one call") {
  Trio t = ugly_trio();
  t.model.add(Revolute{.name = "pin", .a = ground, .b = t.a, .at = p});
  t.model.add(AngleDriver{.name = "motor", .body = t.a, .angle = swing()});
  t.model.add(TorsionalSpring{.name = "torsion", .a = t.a, .b = t.b, .stiffness = 3, .damping = 2});
  t.model.add(Gravity{});
  const auto checks = check_elements(t.model);
  CHECK(checks.size() == 4);
  for (const ElementCheck& c : checks) {
    INFO(c.message());
    CHECK(c.ok(1e-8));
  }
}
