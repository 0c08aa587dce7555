// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Consistent states from rough poses: holds, branches, rates, and what is said when there is none.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <yoke/core/assembly.hpp>
#include <yoke/core/equations/dynamics.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

BodyId add_rod(Model& m, const std::string& name, const Vec2& from, const Vec2& to) {
  const Vec2 d = to - from;
  return m.add({.name = name,
                .mass = 1.0,
                .inertia = 0.1,
                .pose = {0.5 * (from + to), std::atan2(d.y(), d.x())}});
}

/// Crank 0.3 m, coupler 1 m, rocker 0.7 m over a base of 1 m.
Model four_bar() {
  Model m;
  const Vec2 a(0.0, 0.3);
  const double x = 0.7,
               y = std::sqrt(0.49 - 0.09);  // not assembled: the coupler's end is elsewhere
  const Vec2 b(x, y);
  const BodyId crank = add_rod(m, "crank", {0.0, 0.0}, a);
  const BodyId coupler = add_rod(m, "coupler", a, a + Vec2(1.0, 0.0));
  const BodyId rocker = add_rod(m, "rocker", {1.0, 0.0}, b);
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "foot", .a = ground, .b = rocker, .at = {1.0, 0.0}});
  m.add(Revolute{.name = "pin", .a = crank, .b = coupler, .at = a});
  m.add(Distance{.name = "wrist",
                 .a = coupler,
                 .b = rocker,
                 .at_a = a + Vec2(1.0, 0.0),
                 .at_b = b,
                 .length = 0.4});
  m.add(Gravity{});
  return m;
}

std::string refusal(const Model& m, const AssemblyOptions& options) {
  return message_of([&] { assemble(m, options); });
}

/// Two links from the origin to a fixed point: elbow up or down.
Model arm() {
  Model m;
  const BodyId upper = add_rod(m, "upper", {0.0, 0.0}, {0.8, 0.6});
  const BodyId lower = add_rod(m, "lower", {0.8, 0.6}, {1.6, 0.0});
  m.add(Revolute{.name = "shoulder", .a = ground, .b = upper, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "elbow", .a = upper, .b = lower, .at = {0.8, 0.6}});
  m.add(Revolute{.name = "hand", .a = ground, .b = lower, .at = {1.6, 0.0}});
  return m;
}

}  // namespace

TEST_CASE("bodies on a heap with wrong angles are assembled, the same way every time") {
  const Model m = four_bar();
  State rough = m.start_state();
  rough.q << 0, 0, 2.0, 0, 0, -3.0, 0, 0, 1.0, Eigen::VectorXd::Zero(rough.q.size() - 9);
  const State state = assemble(m, rough, {});
  Dynamics dynamics(m);
  CHECK(dynamics.position_violation(state).largest() < 1e-12);
  CHECK(state.q == assemble(m, rough, {}).q);
}

TEST_CASE("a held coordinate is exact, the mechanism follows") {
  const Model m = four_bar();
  for (const double angle : {0.4, 1.9, 4.0}) {
    const State state = assemble(m, {.hold = {{"crank", Coordinate::angle, angle}}});
    CHECK(state.q[2] == angle);
    Dynamics dynamics(m);
    CHECK(dynamics.position_violation(state).largest() < 1e-12);
  }
}

TEST_CASE("of two assemblies the one asked for is found") {
  const Model m = arm();
  for (const double side : {0.6435, -0.6435}) {
    const State state = assemble(m, {.near = {{"upper", Coordinate::angle, side, 0.3}}});
    CHECK(state.q[2] == doctest::Approx(side > 0 ? std::atan2(0.6, 0.8) : -std::atan2(0.6, 0.8)));
  }
  const std::string message = refusal(m, {.near = {{"upper", Coordinate::angle, 2.5, 0.3}}});
  CHECK(contains(message, "angle of 'upper' near 2.5 rad"));
  CHECK(contains(message, "0.6435"));
}

TEST_CASE("velocities follow from the rates given, and rates that cannot be had are refused") {
  const Model m = four_bar();
  const State state = assemble(m, {.rates = {{"crank", Coordinate::angle, 3.0}}});
  CHECK(state.v[2] == 3.0);
  Dynamics dynamics(m);
  CHECK(dynamics.velocity_violation(state).largest() < 1e-12);
  const std::string message =
      refusal(m, {.rates = {{"crank", Coordinate::angle, 3.0}, {"crank", Coordinate::x, 7.0}}});
  CHECK(contains(message, "the rates given cannot be had: the rate of '"));
  CHECK(contains(message, " m/s"));
}

TEST_CASE("a hold out of reach names a joint and its residual") {
  const std::string message = refusal(arm(), {.hold = {{"upper", Coordinate::angle, 2.0}}});
  CHECK(contains(message, "no pose was found that satisfies all joints and holds: '"));
  CHECK(contains(message, " m"));
  CHECK(contains(refusal(arm(), {.hold = {{"uper", Coordinate::angle, 2.0}}}), "unknown body"));
}

TEST_CASE("how near and how many starts are refused if negative") {
  CHECK(contains(refusal(arm(), {.near = {{"upper", Coordinate::angle, 0.6, -1.0}}}),
                 "body 'upper': within = -1 rad must be finite and at least 0 rad"));
  CHECK(contains(refusal(arm(), {.near = {{"upper", Coordinate::x, 0.6, std::nan("")}}}),
                 "body 'upper': within = nan m must be finite"));
  CHECK(contains(refusal(arm(), {.starts = -1}), "assembly: starts = -1 must be at least 0"));
  assemble(arm(), {.starts = 0});
}
