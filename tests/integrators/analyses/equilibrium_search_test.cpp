// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Where the potential energy is bounded below an equilibrium is found, and what is called stable is
// a minimum of the energy.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/analyses/equilibrium.hpp>
#include <yoke/joints/gear.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/tests/integrators/analyses/random_held.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

double energy(Dynamics& dynamics, const State& state) {
  System& system = dynamics.system();
  system.bind(state);
  system.set_motion(state.t, state.q.data(), state.v.data());
  const EnergyTerms terms = system.calc_energy();
  return terms.potential + terms.stored;
}

/// The forces on all coordinates [N, N m], joints included if `lambda` is given.
Eigen::VectorXd forces(Dynamics& dynamics, const State& state, const double* lambda = nullptr) {
  System& system = dynamics.system();
  system.bind(state);
  system.set_motion(state.t, state.q.data(), state.v.data());
  std::vector<double> phi(static_cast<std::size_t>(system.rows()));
  system.calc_position_level(phi.data());
  Eigen::VectorXd Q = Eigen::VectorXd::Zero(system.dofs() + 1);
  system.add_forces(Q.data(), nullptr, nullptr);
  if (lambda != nullptr) system.subtract_constraint_forces(lambda, Q.data());
  return Q.head(system.dofs());
}

/// The largest force that is left on a body, in parts of the largest at the start.
double imbalance(Dynamics& dynamics, const State& rest) {
  const State start = dynamics.system().model().start_state();
  const double largest = std::max(1.0, forces(dynamics, start).cwiseAbs().maxCoeff());
  return forces(dynamics, rest, rest.lambda.data()).cwiseAbs().maxCoeff() / largest;
}

/// By how much the energy falls at most when the mechanism is moved a little, at random, along its
/// joints.
double largest_fall(const Model& model, const State& rest) {
  Dynamics dynamics(model);
  State state = rest;
  REQUIRE(dynamics.assemble(state));
  const double least = energy(dynamics, state);
  std::mt19937_64 random(7);
  double fall = 0.0;
  for (int i = 0; i < 10; ++i) {
    State beside = state;
    for (double& q : beside.q)
      q += 1e-4 * (2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1);
    if (!dynamics.project_positions(beside.t, beside.q.data(), Correction::exact)) continue;
    fall = std::max(fall, least - energy(dynamics, beside));
  }
  return fall / std::max(1.0, std::abs(least));
}

}  // namespace

TEST_CASE("an equilibrium of every mechanism that springs, gravity and joints hold is found") {
  int stable = 0, minima = 0;
  for (unsigned seed = 1; seed <= 335; ++seed) {
    INFO("seed " << seed);
    const Model model = held_mechanism(seed);
    const Equilibrium e = equilibrium(model, {.allow_neutral = true});
    CHECK_MESSAGE(e.found, e.reason);
    if (!e.found) continue;
    Dynamics dynamics(model);
    CHECK(imbalance(dynamics, e.state) < 1e-9);
    CHECK(dynamics.position_violation(e.state).length < 1e-10);
    stable += e.stable ? 1 : 0;
    if (!e.stable || e.neutral) continue;
    ++minima;
    CHECK(largest_fall(model, e.state) < 1e-12);
  }
  CHECK(stable >= 330);
  CHECK(minima > 200);
}

TEST_CASE("a light body on a stiff spring, stretched at the start, hangs straight down") {
  Model m;
  const double k = 1e4, mass = 0.029;
  const BodyId body =
      m.add(Body{.name = "body", .mass = mass, .inertia = 1e-4, .pose = {{0.4, 0.3}, 0.5}});
  const Vec2 end(0.45, 0.36);
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = body,
                            .at_a = {0.0, 0.0},
                            .at_b = end,
                            .stiffness = k,
                            .free_length = 0.5 * end.norm()});
  m.add(Gravity{});
  const double arm = (end - Vec2(0.4, 0.3)).norm();
  const Equilibrium e = equilibrium(m);
  REQUIRE_MESSAGE(e.found, e.reason);
  CHECK(e.stable);
  CHECK(std::abs(e["body.x_m"]) < 1e-9);
  CHECK(e["body.y_m"] ==
        doctest::Approx(-(0.5 * end.norm() + mass * 9.81 / k + arm)).epsilon(1e-10));
}

TEST_CASE("light bodies on stiff springs come to rest beside one of 9e6 kg") {
  // Seed 1073 of the random mechanisms, shrunk: stiff springs make valleys that bend, along which a
  // descent in the metric of the masses crawls because the heavy body does not move.
  Model m;
  const auto body = [&](const char* name, double mass, double inertia, const Vec2& at) {
    return m.add(Body{.name = name, .mass = mass, .inertia = inertia, .pose = {at, 0.0}});
  };
  const auto spring = [&](const char* name, BodyId a, BodyId b, const Vec2& at_a, const Vec2& at_b,
                          double stiffness, double length) {
    m.add(TranslationalSpring{.name = name,
                              .a = a,
                              .b = b,
                              .at_a = at_a,
                              .at_b = at_b,
                              .stiffness = stiffness,
                              .free_length = length});
  };
  const BodyId crank = body("crank", 3.5, 0.0016, {0.033, 0.00077}),
               rod = body("rod", 4.4, 0.00048, {0.006, 0.036}),
               tail = body("tail", 6.8, 0.001, {-0.032, 0.058}),
               heavy = body("heavy", 9.2e6, 2600.0, {0.049, 0.008}),
               guide = body("guide", 10.0, 0.002, {-0.079, 0.039}),
               block = body("block", 1.2, 4.8e-5, {-0.06, 0.0096});
  m.add(Revolute{"pivot", ground, crank, {0.0087, 0.00084}});
  m.add(Revolute{"knee", rod, tail, {-0.021, 0.067}});
  m.add(Revolute{"hip", rod, heavy, {0.033, 0.035}});
  m.add(Prismatic{.name = "slide", .a = guide, .b = block, .along = {0.78, -0.63}});
  spring("soft 1", crank, block, {0.02, 0.0047}, {-0.061, 0.017}, 40.0, 0.0819);
  spring("soft 2", block, heavy, {-0.071, -0.018}, {0.043, 0.026}, 16.0, 0.0912);
  const double stiff = 2.76e8, length = 0.0248228;
  const Vec2 up(0.0148937, 0.0198583);
  for (const auto& [held, at] : {std::pair{rod, Vec2(0.0159291, 0.036)},
                                 {guide, Vec2(-0.0690709, 0.039)},
                                 {block, Vec2(-0.0500709, 0.0096)}})
    spring(("holds " + std::to_string(held.index)).c_str(), ground, held, at + up, at, stiff,
           length);
  const Equilibrium e = equilibrium(m, {.allow_neutral = true});
  REQUIRE_MESSAGE(e.found, e.reason);
  Dynamics dynamics(m);
  CHECK(imbalance(dynamics, e.state) < 1e-9);
  CHECK(e.iterations < 2000);
}

// Random mechanism 6275, made smaller.
TEST_CASE("a body held at three lines and rods nearly through one point is let down to rest") {
  Model m;
  const BodyId held = m.add(Body{.name = "held",
                                 .mass = 4.1000000000000005,
                                 .inertia = 0.027,
                                 .pose = {{0.10034068359226209, -0.028196846638729105}}});
  const BodyId heavy = m.add(Body{.name = "heavy",
                                  .mass = 479073.566,
                                  .inertia = 3000.0,
                                  .pose = {{-0.19445484835865487, 0.12676441096685603}}});
  const BodyId light = m.add(Body{.name = "light",
                                  .mass = 4.1000000000000005,
                                  .inertia = 0.005,
                                  .pose = {{0.17, 0.056}, 1.198467387647252}});
  const auto line = [&](const char* name, BodyId body, const Vec2& at, const Vec2& through,
                        const Vec2& along) {
    m.add(PointOnLine{
        .name = name, .a = body, .at = at, .b = ground, .through = through, .along = along});
  };
  line("line 1", held, {0.04484944074064031, -0.007380406265532689},
       {-0.05892988961291502, -0.09935329117488191}, {0.7483946885145356, 0.6632536394195143});
  line("line 3", light, {0.08001626714736673, 0.01657597308415498},
       {0.14614105334810212, 0.019955697985808377}, {-0.9986963702568908, -0.05104468665504036});
  line("line 4", held, {0.07610285624779703, -0.025773765152945594},
       {-0.009507169810719501, -0.11982840539216436}, {0.6731281612506302, 0.7395258471016044});
  m.add(Revolute{
      .name = "pin", .a = ground, .b = heavy, .at = {-0.03705391754715234, 0.06646961014373576}});
  m.add(Distance{
      .name = "rod", .a = ground, .b = held, .at_a = {-0.022, -0.082}, .at_b = {0.098, -0.028}});
  m.add(
      Gear{.name = "gear", .a = held, .b = heavy, .carrier = ground, .ratio = 1.6632159621822111});
  m.add(TorsionalSpring{.name = "coil 1",
                        .a = heavy,
                        .b = light,
                        .stiffness = 0.0761842989081799,
                        .damping = 0.0,
                        .free_angle = 1.198467387647252});
  m.add(TorsionalSpring{.name = "coil 2",
                        .a = light,
                        .b = heavy,
                        .stiffness = 0.06604887220792265,
                        .damping = 0.0,
                        .free_angle = -0.30407265360682567});
  m.add(TranslationalSpring{.name = "spring",
                            .a = light,
                            .b = held,
                            .at_a = {0.0693794299943755, 0.027805254112357496},
                            .at_b = {0.1462430844057824, -0.027002614087565595},
                            .stiffness = 7.072600785979768,
                            .free_length = 0.05612145680536439});
  m.add(TranslationalSpring{.name = "holds",
                            .a = ground,
                            .b = light,
                            .at_a = {0.26773577180605235, 0.13418861744484184},
                            .at_b = {0.20909430872242094, 0.056},
                            .stiffness = 14372452.99,
                            .free_length = 0.09773577180605232});
  const Equilibrium e = equilibrium(m, {.allow_neutral = true});
  REQUIRE_MESSAGE(e.found, e.reason);
  Dynamics dynamics(m);
  CHECK(imbalance(dynamics, e.state) < 1e-9);
  CHECK(e.iterations < 2000);
}

TEST_CASE("a start away from any equilibrium goes to a stable one, a start on one stays") {
  const auto pendulum = [](double angle) {
    Model m;
    const BodyId rod = m.add(Body{
        .name = "rod", .mass = 2.0, .inertia = 0.2, .pose = {rotate(angle, {0.5, 0.0}), angle}});
    m.add(Revolute{"pivot", ground, rod, {0.0, 0.0}});
    m.add(Gravity{});
    return m;
  };
  for (const double angle : {0.3, 1.2, 1.5, 2.9, -0.1}) {
    const Equilibrium e = equilibrium(pendulum(angle));
    REQUIRE_MESSAGE(e.found, e.reason);
    CHECK(e.stable);
    CHECK(e["rod.y_m"] == doctest::Approx(-0.5));
  }
  const Equilibrium upright = equilibrium(pendulum(0.5 * pi));
  REQUIRE(upright.found);
  CHECK(!upright.stable);
  CHECK(upright["rod.y_m"] == doctest::Approx(0.5));
}
