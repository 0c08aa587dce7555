// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Analyses of mechanisms with massless bodies: closed forms, and the same mechanism written without
// massless bodies.
#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <string>

#include <yoke/core/assembly.hpp>
#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/analyses/details/linearisation.hpp>
#include <yoke/integrators/analyses/details/lowest_modes.hpp>
#include <yoke/integrators/analyses/equilibrium.hpp>
#include <yoke/integrators/analyses/inverse_dynamics.hpp>
#include <yoke/integrators/analyses/kinematics.hpp>
#include <yoke/integrators/analyses/modes.hpp>
#include <yoke/integrators/analyses/recovery.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/joints/weld.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

constexpr double gravity_ = 9.81;

/// Point masses of 1 kg on massless rods of 1 m, one below the other, turned by `angle`; `damping` of
/// the first pin.
Model hanging_bobs(int count, double damping = 0.0, double angle = 0.0, double omega = 0.0) {
  Model m;
  BodyId last = ground;
  const Vec2 along = rotate(angle, {0.0, -1.0});
  for (int i = 0; i < count; ++i) {
    const std::string name = std::to_string(i);
    const Twist of_rod{(i + 0.4) * omega * perp(along), omega};
    const Twist of_bob{(i + 1.0) * omega * perp(along), omega};
    const BodyId rod =
        m.add(Body{.name = "rod " + name, .pose = {(i + 0.4) * along, angle}, .twist = of_rod});
    const BodyId bob = m.add(Body{
        .name = "bob " + name, .mass = 1.0, .pose = {(i + 1.0) * along, 0.0}, .twist = of_bob});
    m.add(Revolute{.name = "pin " + name, .a = last, .b = rod, .at = i * along});
    m.add(Weld{.name = "eye " + name, .a = rod, .b = bob});
    if (i == 0 && damping > 0.0)
      m.add(TorsionalSpring{.name = "damper", .a = last, .b = rod, .damping = damping});
    last = bob;
  }
  m.add(Gravity{.name = "gravity", .acceleration = {0.0, -gravity_}});
  return m;
}

State hanging(const Model& m) { return assembled_state(m); }

}  // namespace

TEST_CASE("modes of point masses on massless rods are those of the closed forms") {
  const Model one = hanging_bobs(1);
  const Modes simple = modes(one, hanging(one));
  REQUIRE(simple.modes.size() == 1);
  CHECK(simple.modes[0].frequency * 2.0 * pi ==
        doctest::Approx(std::sqrt(gravity_)).epsilon(1e-12));
  // Mass-normalised: 1 kg moves by 1 m per kg^1/2, rod and bob turn by 1 rad.
  CHECK(std::abs(simple.modes[0].shape[3]) == doctest::Approx(1.0).epsilon(1e-12));
  CHECK(std::abs(simple.modes[0].shape[2]) == doctest::Approx(1.0).epsilon(1e-12));
  const Model two = hanging_bobs(2);
  const Modes twin = modes(two, hanging(two));
  REQUIRE(twin.modes.size() == 2);
  for (const int i : {0, 1}) {
    const double square = gravity_ * (2.0 + (i == 0 ? -1.0 : 1.0) * std::sqrt(2.0));
    CHECK(std::pow(2.0 * pi * twin.modes[static_cast<std::size_t>(i)].frequency, 2) ==
          doctest::Approx(square).epsilon(1e-12));
  }
}

TEST_CASE("a damper on a massless rod damps the mass it carries") {
  const double c = 0.8;
  const Model m = hanging_bobs(1, c);
  const Modes damped = modes(m, hanging(m));
  REQUIRE(damped.modes.size() == 1);
  const std::complex<double> s(-0.5 * c, std::sqrt(gravity_ - 0.25 * c * c));
  CHECK(std::abs(damped.modes[0].eigenvalue - s) < 1e-12);
}

TEST_CASE("modes from the sparse matrices are those from the dense ones with massless bodies too") {
  for (const double damping : {0.0, 0.3}) {
    INFO("damping " << damping);
    const Model m = hanging_bobs(8, damping);
    const State state = hanging(m);
    const Modes all = modes(m, state);
    Dynamics dynamics(m);
    State at_rest = state;
    REQUIRE(dynamics.assemble(at_rest));
    const Linearisation l = linearise_sparse(dynamics, at_rest);
    CHECK(l.degrees_of_freedom() == 8);
    const int count = 3;
    const LowestModes lowest =
        damping > 0.0 ? lowest_general(l, 2 * count) : lowest_undamped(l, count);
    REQUIRE(lowest.values.size() >= static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      double nearest = 1e300;
      std::size_t which = 0;
      for (std::size_t k = 0; k < lowest.values.size(); ++k) {
        const double off =
            std::abs(lowest.values[k] - all.modes[static_cast<std::size_t>(i)].eigenvalue);
        if (off < nearest) nearest = off, which = k;
      }
      CHECK(nearest < 1e-9);
      // The shapes agree up to a factor, rods included.
      const Eigen::VectorXcd a = all.modes[static_cast<std::size_t>(i)].shape.normalized();
      const Eigen::VectorXcd b = lowest.shapes[which].normalized();
      CHECK(std::abs(std::abs(a.dot(b)) - 1.0) < 1e-9);
    }
  }
}

TEST_CASE(
    "the linearisation of a motion has a basis that is orthonormal in the masses and turns "
    "least") {
  const Model m = hanging_bobs(3, 0.2, 0.4, 1.7);
  const Linearisation l = linearise(m, assembled_state(m));
  const Eigen::MatrixXd N = l.basis, rate = l.basis_rate;
  REQUIRE(N.cols() == 3);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(3, 3);
  CHECK((N.transpose() * l.mass.asDiagonal() * N - one).cwiseAbs().maxCoeff() < 1e-12);
  CHECK((N.transpose() * l.mass.asDiagonal() * rate).cwiseAbs().maxCoeff() < 1e-12);
  CHECK((l.G * N).cwiseAbs().maxCoeff() < 1e-12);
  CHECK((l.G * rate + l.H * N).cwiseAbs().maxCoeff() < 1e-12);
  // The motion that neighbours part from: eigenvalues are those of the same with inertial bobs.
  Model massive;
  BodyId last = ground;
  const Vec2 along = rotate(0.4, {0.0, -1.0});
  for (int i = 0; i < 3; ++i) {
    const std::string name = std::to_string(i);
    const BodyId bob = massive.add(Body{.name = "bob " + name,
                                        .mass = 1.0,
                                        .inertia = 1e-12,
                                        .pose = {(i + 1.0) * along, 0.4},
                                        .twist = {(i + 1.0) * 1.7 * perp(along), 1.7}});
    massive.add(Revolute{.name = "pin " + name, .a = last, .b = bob, .at = i * along});
    if (i == 0) massive.add(TorsionalSpring{.name = "damper", .a = last, .b = bob, .damping = 0.2});
    last = bob;
  }
  massive.add(Gravity{.name = "gravity", .acceleration = {0.0, -gravity_}});
  const Modes here = modes(m, assembled_state(m)), there = modes(massive, assembled_state(massive));
  REQUIRE(here.modes.size() == there.modes.size());
  for (std::size_t i = 0; i < here.modes.size(); ++i)
    CHECK(std::abs(here.modes[i].eigenvalue - there.modes[i].eigenvalue) < 1e-8);
}

TEST_CASE("an equilibrium of massless links is found, directly and from far away") {
  const Model far = hanging_bobs(2, 0.0, 2.5);
  const Equilibrium e = equilibrium(far);
  REQUIRE_MESSAGE(e.found, e.reason);
  CHECK(e.stable);
  CHECK(e.state.q[3 * 3 + 1] == doctest::Approx(-2.0).epsilon(1e-10));

  // A toggle: a massless crank and rod press a slider of 1 kg on a spring against a moment.
  Model toggle;
  const Vec2 pin = rotate(0.5, {0.1, 0.0});
  const double x = pin.x() + std::sqrt(0.09 - pin.y() * pin.y());
  const BodyId crank = toggle.add(Body{.name = "crank", .pose = {0.5 * pin, 0.5}});
  const BodyId rod =
      toggle.add(Body{.name = "rod", .pose = {pin, std::atan2(-pin.y(), x - pin.x())}});
  const BodyId slider =
      toggle.add(Body{.name = "slider", .mass = 1.0, .inertia = 1.0, .pose = {{x, 0.0}, 0.0}});
  toggle.add(Revolute{"pivot", ground, crank, {0.0, 0.0}});
  toggle.add(Revolute{"crank pin", crank, rod, pin});
  toggle.add(Revolute{"slider pin", rod, slider, {x, 0.0}});
  toggle.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  toggle.add(TorsionalSpring{
      .name = "coil", .a = ground, .b = crank, .stiffness = 2.0, .free_angle = 0.9});
  toggle.add(TranslationalSpring{.name = "spring",
                                 .a = ground,
                                 .b = slider,
                                 .at_a = {x + 1.0, 0.0},
                                 .at_b = {x, 0.0},
                                 .stiffness = 30.0,
                                 .free_length = 0.9});
  const Equilibrium t = equilibrium(toggle);
  REQUIRE_MESSAGE(t.found, t.reason);
  const double q = t.state.q[2];
  const double slope = -0.1 * std::sin(q) - 0.01 * std::sin(q) * std::cos(q) /
                                                std::sqrt(0.09 - std::pow(0.1 * std::sin(q), 2));
  const double push = 30.0 * (x + 1.0 - t.state.q[6] - 0.9);  // [N] of the spring, along x
  CHECK(std::abs(-2.0 * (q - 0.9) + push * slope) < 1e-9);
}

TEST_CASE("driven massless links: the motor lifts what they carry") {
  const double omega = 3.0;
  Model m;
  const BodyId rod = m.add(Body{.name = "rod", .pose = {{0.2, 0.0}, 0.0}});
  const BodyId bob = m.add(Body{.name = "bob", .mass = 2.0, .pose = {{0.5, 0.0}, 0.0}});
  m.add(Revolute{.name = "pin", .a = ground, .b = rod, .at = {0.0, 0.0}});
  m.add(Weld{.name = "eye", .a = rod, .b = bob});
  m.add(Gravity{.name = "gravity", .acceleration = {0.0, -gravity_}});
  m.add(AngleDriver{.name = "motor", .body = rod, .angle = constant_speed(0.0, omega)});
  const Result motion = kinematics(m, {.until = 1.0, .samples = 11});
  REQUIRE_MESSAGE(motion.summary.ok(), motion.summary.reason);
  CHECK(motion.final.q[4] == doctest::Approx(0.5 * std::sin(omega)).epsilon(1e-12));
  const Result drive = inverse_dynamics(m, {.until = 1.0, .samples = 11});
  REQUIRE_MESSAGE(drive.summary.ok(), drive.summary.reason);
  const Eigen::VectorXd power = drive["motor.power_W"], t = drive["t_s"];
  for (Eigen::Index i = 0; i < t.size(); ++i)
    CHECK(power[i] ==
          doctest::Approx(2.0 * gravity_ * 0.5 * omega * std::cos(omega * t[i])).epsilon(1e-9));
}

TEST_CASE("rows of a run with massless bodies give reactions again") {
  const Model m = hanging_bobs(2, 0.1, 1.0);
  const Result run = simulate(m, {.until = 1.0, .relative_tolerance = 1e-10, .samples = 11});
  REQUIRE(run.summary.ok());
  const Recovery found = recover(m, run.samples, run["t_s"][7]);
  for (const std::string& name : run.samples.names()) {
    if (name == "balance_J") continue;
    const Eigen::VectorXd column = run[name];
    CHECK_MESSAGE(
        std::abs(found[name] - column[7]) < 1e-10 * std::max(1.0, column.cwiseAbs().maxCoeff()),
        name);
  }
}

TEST_CASE("the effective mass at a massless body is what joints give it") {
  Model m;
  const BodyId rod = m.add(Body{.name = "rod", .pose = {{0.2, 0.0}, 0.0}});
  const BodyId bob = m.add(Body{.name = "bob", .mass = 2.0, .pose = {{0.5, 0.0}, 0.0}});
  m.add(Revolute{.name = "pin", .a = ground, .b = rod, .at = {0.0, 0.0}});
  m.add(Weld{.name = "eye", .a = rod, .b = bob});
  m.add(TranslationalSpring{
      .name = "slot", .a = ground, .b = rod, .at_a = {0.8, 1.0}, .at_b = {0.8, 0.0}});
  Dynamics dynamics(m);
  State state = m.start_state();
  REQUIRE(dynamics.assemble(state));
  // A push square to the rod, 0.8 m from the pin, 0.6 m from the frame of the rod.
  const double push[] = {0.0, 0.0, 0.0, 0.0, 1.0, 0.6};
  CHECK(dynamics.effective_mass(dynamics.system().forces().front(), push) ==
        doctest::Approx(2.0 * 0.25 / 0.64).epsilon(1e-12));
}
