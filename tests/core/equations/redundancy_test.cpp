// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Dependent equations: found, told apart from conflicts and singular positions, left out.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/messages.hpp>
#include <yoke/tests/over_closed.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

BodyId add_rod(Model& m, const std::string& name, const Vec2& from, const Vec2& to,
               double omega = 0.0, const Vec2& velocity = Vec2::Zero()) {
  const Vec2 d = to - from;
  return m.add({.name = name,
                .mass = d.norm(),
                .inertia = std::pow(d.norm(), 3) / 12.0,
                .pose = {0.5 * (from + to), std::atan2(d.y(), d.x())},
                .twist = {velocity + 0.5 * omega * perp(d), omega}});
}

/// `cranks` parallel cranks of 0.3 m at angle phi carry a coupler; the last `stretch` times as
/// long.
Model parallelogram(int cranks, double phi = 1.1, double stretch = 1.0) {
  Model m;
  const Vec2 up = rotate(phi, {0.3, 0.0});
  const double omega = 2.0;
  const BodyId coupler = add_rod(m, "coupler", up, up + Vec2(1.0, 0.0), 0.0, omega * perp(up));
  for (int i = 0; i < cranks; ++i) {
    const Vec2 base(i == 0 ? 0.0 : i == 1 ? 1.0 : 0.5, 0.0), tip = base + up;
    const Vec2 foot = tip - (i == 2 ? stretch : 1.0) * up;
    const std::string name = "crank " + std::to_string(i + 1);
    const BodyId crank = add_rod(m, name, foot, tip, omega);
    m.add(Revolute{.name = name + " foot", .a = ground, .b = crank, .at = foot});
    m.add(Revolute{.name = name + " tip", .a = coupler, .b = crank, .at = tip});
  }
  m.add(Gravity{});
  return m;
}

std::vector<std::string> names(const System& system, const std::vector<int>& rows) {
  std::vector<std::string> list;
  for (const int row : rows) list.push_back(system.equation_name(row));
  return list;
}

}  // namespace

TEST_CASE(
    "a third parallel crank is redundant: one equation of it is left out, the motion is that of "
    "two") {
  const Model two = parallelogram(2), three = parallelogram(3);
  Dynamics a(two), b(three);
  State sa = two.start_state(), sb = three.start_state();
  REQUIRE(a.assemble(sa));
  CHECK(a.redundancy().redundant.empty());
  const Outcome outcome = b.assemble(sb);
  INFO(outcome.why);
  REQUIRE(outcome);
  REQUIRE(b.redundancy().redundant.size() == 1);
  CHECK(b.redundancy().rank == b.system().rows() - 1);
  CHECK_FALSE(b.redundancy().singular_here);
  CHECK(names(b.system(), b.redundancy().redundant).front().starts_with("crank 3 tip"));
  CHECK(b.system().dropped_rows() == b.redundancy().redundant);
  CHECK(sb.lambda[b.redundancy().redundant.front()] == 0.0);
  // Weights pull on the cranks alike, and the third adds its own inertia: not the same
  // acceleration, but the constraints hold for all of them.
  CHECK(std::abs(sb.a[2]) < 1e-12);
  CHECK(std::abs(sb.a[5] - sb.a[8]) < 1e-12);
  CHECK(std::abs(sb.a[5] - sb.a[11]) < 1e-12);
}

TEST_CASE(
    "reactions of a redundant mechanism that are not unique are marked, the unique ones not") {
  // In a parallelogram the cranks' axial forces can be shared at will between three of them; what
  // crosses each crank is fixed by its own moments.
  const Model m = parallelogram(3, pi / 2.0);
  Dynamics dynamics(m);
  State state = m.start_state();
  REQUIRE(dynamics.assemble(state));
  const std::vector<std::string> doubtful =
      column_names(dynamics.system(), dynamics.redundancy().doubts);
  CHECK(std::ranges::find(doubtful, "crank 1 foot.fy_N") != doubtful.end());
  for (const std::string& name : doubtful) CHECK_FALSE(contains(name, "moment"));
  // A pendulum beside it has nothing to do with it.
  Model with = parallelogram(3);
  const BodyId bob = add_rod(with, "bob", {3.0, 0.0}, {3.0, -1.0});
  with.add(Revolute{.name = "hook", .a = ground, .b = bob, .at = {3.0, 0.0}});
  Dynamics both(with);
  State s = with.start_state();
  REQUIRE(both.assemble(s));
  for (const std::string& name : column_names(both.system(), both.redundancy().doubts))
    CHECK_FALSE(contains(name, "hook"));
  const Reaction hook = both.reaction(6, s.lambda.data());
  CHECK(hook.force.y() == doctest::Approx(9.81).epsilon(1e-12));
}

TEST_CASE("two guides in line share the load; the split is in doubt, the sum is not") {
  Model m;
  const BodyId slider = m.add({.name = "slider", .mass = 2.0, .inertia = 0.5});
  m.add(Prismatic{.name = "left", .a = ground, .b = slider, .at = Vec2(-0.5, 0.0)});
  m.add(Prismatic{.name = "right", .a = ground, .b = slider, .at = Vec2(0.5, 0.0)});
  m.add(Gravity{});
  Dynamics dynamics(m);
  State state = m.start_state();
  REQUIRE(dynamics.assemble(state));
  CHECK(names(dynamics.system(), dynamics.redundancy().redundant) ==
        std::vector<std::string>{"right: transverse", "right: rotation"});
  const Reaction left = dynamics.reaction(0, state.lambda.data());
  const Reaction right = dynamics.reaction(1, state.lambda.data());
  CHECK((left.force + right.force).y() == doctest::Approx(2.0 * 9.81).epsilon(1e-13));
  const std::vector<std::string> doubtful =
      column_names(dynamics.system(), dynamics.redundancy().doubts);
  CHECK(doubtful ==
        std::vector<std::string>{"left.fy_N", "left.moment_N_m", "right.fy_N", "right.moment_N_m"});
}

TEST_CASE("a way that only a heavy body can go is found beside light ones that cannot move") {
  // Pins twice over tie the light plate to the wheel; a rod at a short lever holds the wheel's light
  // link. Found by the random mechanisms (20022).
  const Model m = tests::plate_on_heavy_wheel();
  Dynamics dynamics(m);
  State state = m.start_state();
  const Outcome outcome = dynamics.assemble(state);
  INFO(outcome.why);
  CHECK(outcome);
}

TEST_CASE("the equation left out is the one that says least of its own, whatever others say") {
  // The guide's normal is turned by 0.03 rad from the x axis, so that it says nearly what the pin says
  // of x. The rod beside has a lever of 0.04 m only: what is nearly dependent there does not matter.
  Model m;
  const BodyId wheel = add_rod(m, "wheel", {0.0, 0.0}, {1.0, 0.0});
  const BodyId plate = add_rod(m, "plate", {0.3, 0.2}, {0.5, 0.2});
  const BodyId lever = add_rod(m, "lever", {2.0, 0.0}, {3.0, 0.0});
  m.add(Revolute{.name = "axle", .a = ground, .b = wheel, .at = {0.0, 0.0}});
  m.add(Prismatic{.name = "guide",
                  .a = wheel,
                  .b = plate,
                  .along = rotate(0.03, Vec2(0.0, 1.0)),
                  .at = Vec2(0.4, 0.1)});
  m.add(Revolute{.name = "pin", .a = wheel, .b = plate, .at = {0.4, 0.1}});
  m.add(Revolute{.name = "foot", .a = ground, .b = lever, .at = {2.0, 0.0}});
  m.add(Distance{.name = "rod", .a = ground, .b = lever, .at_a = {4.0, 0.04}, .at_b = {3.0, 0.0}});
  Dynamics dynamics(m);
  State state = m.start_state();
  REQUIRE(dynamics.assemble(state));
  CHECK(names(dynamics.system(), dynamics.redundancy().here.dependent) ==
        std::vector<std::string>{"pin: x"});
}

TEST_CASE("a crank that agrees at the start pose only is in conflict and named") {
  const Model m = parallelogram(3, 1.1, 0.7);
  Dynamics dynamics(m);
  State state = m.start_state();
  const Outcome outcome = dynamics.assemble(state);
  REQUIRE_FALSE(outcome);
  MESSAGE(outcome.why);
  CHECK(contains(outcome.why, "'crank 3 tip: "));
  CHECK(contains(outcome.why, "in conflict with"));
}

TEST_CASE(
    "two motors that agree run, two that differ in angle or rate are refused with the residual") {
  const auto driven = [](double start, double speed) {
    Model m;
    const BodyId crank = add_rod(m, "crank", {0.0, 0.0}, {1.0, 0.0});
    m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
    m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(0.0, 3.0)});
    m.add(AngleDriver{.name = "second", .body = crank, .angle = constant_speed(start, speed)});
    return m;
  };
  const auto outcome_of = [](const Model& m) {
    Dynamics dynamics(m);
    State state = m.start_state();
    Outcome outcome = dynamics.assemble(state);
    if (outcome) outcome.why = dynamics.system().equation_name(dynamics.redundancy().redundant[0]);
    return outcome;
  };
  const Outcome agree = outcome_of(driven(0.0, 3.0));
  INFO(agree.why);
  REQUIRE(agree);
  CHECK(agree.why == "second: angle");
  const Outcome angle = outcome_of(driven(0.2, 3.0));
  REQUIRE_FALSE(angle);
  MESSAGE(angle.why);
  CHECK(contains(angle.why, "motor: angle"));
  CHECK(contains(angle.why, "second: angle"));
  CHECK(contains(angle.why, "0.1 rad"));
  const Outcome rate = outcome_of(driven(0.0, 4.0));
  REQUIRE_FALSE(rate);
  MESSAGE(rate.why);
  CHECK(contains(rate.why, "in conflict with"));
  CHECK(contains(rate.why, "0.5 rad/s"));
}

TEST_CASE("a stretched four-bar is at a singular position, where nothing is redundant") {
  const Model m = parallelogram(2, 0.0);
  Dynamics dynamics(m);
  State state = m.start_state();
  const Outcome outcome = dynamics.assemble(state);
  INFO(outcome.why);
  REQUIRE(outcome);
  CHECK(dynamics.redundancy().singular_here);
  CHECK(dynamics.redundancy().redundant.empty());
  CHECK(dynamics.system().dropped_rows().empty());
  CHECK(dynamics.independence(state.t, state.q.data()) < 1e-12);
  Model at_rest = parallelogram(2, 0.0);
  State still = at_rest.start_state();
  still.v.setZero();
  Dynamics other(at_rest);
  const Outcome refused = other.assemble(still);
  REQUIRE_FALSE(refused);
  CHECK(contains(refused.why, "singular position at rest"));
}

TEST_CASE("independence falls like the square of the distance to a singular position") {
  double last = 0.0;
  for (const double phi : {0.1, 0.025, 0.00625}) {
    const Model m = parallelogram(2, phi);
    Dynamics dynamics(m);
    State state = m.start_state();
    REQUIRE(dynamics.assemble(state));
    double value = 0.0;
    for (int i = 0; i < 10; ++i) value = dynamics.independence(state.t, state.q.data());
    if (last > 0.0) CHECK(last / value == doctest::Approx(16.0).epsilon(0.1));
    last = value;
  }
}

TEST_CASE("bodies far from where they belong are assembled") {
  for (const int cranks : {2, 3}) {
    const Model m = parallelogram(cranks);
    State state = m.start_state();
    state.q.setZero();  // all on one heap
    for (Eigen::Index i = 2; i < state.q.size(); i += 3) state.q[i] = 0.7 * static_cast<double>(i);
    Dynamics dynamics(m);
    const Outcome outcome = dynamics.assemble(state);
    INFO(outcome.why);
    REQUIRE(outcome);
    CHECK(dynamics.position_violation(state).largest() < 1e-12);
  }
}
