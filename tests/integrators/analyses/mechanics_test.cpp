// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The matrices behind the motion, against closed forms, differences and runs.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <yoke/integrators/analyses/mechanics.hpp>
#include <yoke/integrators/analyses/state_space.hpp>
#include <yoke/integrators/simulation.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// A rod of 1 m and 2 kg on a pivot at the origin, at `angle` [rad] and turning at `omega` [rad/s].
Model rod(double angle, double omega) {
  Model m;
  const Vec2 centre = rotate(angle, {0.5, 0.0});
  const BodyId b = m.add(Body{.name = "rod",
                              .mass = 2.0,
                              .inertia = 1.0 / 6.0,
                              .pose = {centre, angle},
                              .twist = {omega * perp(centre), omega}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = b, .at = {0.0, 0.0}});
  m.add(Gravity{});
  m.add(AppliedTorque{.name = "motor", .body = b, .value = 0.0});
  m.add(TorsionalSpring{.name = "damper", .a = ground, .b = b, .damping = 0.4});
  return m;
}

/// A slider-crank in motion, turned by a torque against a spring.
Model slider_crank() {
  Model m;
  const double phi = 0.7, r = 0.1, l = 0.3, omega = 20.0;
  const double x = r * std::cos(phi) + std::sqrt(l * l - std::pow(r * std::sin(phi), 2));
  const Vec2 pin = rotate(phi, {r, 0.0}), end(x, 0.0);
  const double psi = std::atan2(-pin.y(), x - pin.x());
  const BodyId crank = m.add(Body{.name = "crank",
                                  .mass = 0.5,
                                  .inertia = 1e-3,
                                  .pose = {0.5 * pin, phi},
                                  .twist = {0.5 * omega * perp(pin), omega}});
  const BodyId rod =
      m.add(Body{.name = "rod", .mass = 0.4, .inertia = 3e-3, .pose = {0.5 * (pin + end), psi}});
  const BodyId slider =
      m.add(Body{.name = "slider", .mass = 0.8, .inertia = 1e-3, .pose = {end, 0.0}});
  m.add(Revolute{.name = "main", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "crank pin", .a = crank, .b = rod, .at = pin});
  m.add(Revolute{.name = "wrist pin", .a = rod, .b = slider, .at = end});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  m.add(Gravity{});
  m.add(AppliedTorque{.name = "motor", .body = crank, .value = 1.5});
  m.add(AppliedForce{.name = "load", .body = slider, .at = end, .value = Vec2(-20.0, 0.0)});
  return m;
}

}  // namespace

TEST_CASE("mechanics of a rod on a pivot: closed forms") {
  const double angle = 0.4, omega = 3.0, c = std::cos(angle), s = std::sin(angle);
  const Model model = rod(angle, omega);
  Mechanics mechanics(model);
  CHECK(mechanics.coordinates() == 3);
  CHECK(mechanics.equations() == 2);
  CHECK(mechanics.freedom() == 1);
  mechanics.at(model.start_state());
  CHECK(mechanics.mass_matrix().isApprox(Eigen::Vector3d(2.0, 2.0, 1.0 / 6.0), 1e-15));
  CHECK(mechanics.positions_off().norm() < 1e-15);
  CHECK(mechanics.velocities_off().norm() < 1e-15);
  // Q = m g and the damper's torque.
  CHECK(mechanics.forces().isApprox(Eigen::Vector3d(0.0, -2.0 * 9.81, -0.4 * omega), 1e-14));
  const Eigen::MatrixXd& G = mechanics.constraint_jacobian();
  const Eigen::MatrixXd& N = mechanics.null_space();
  CHECK((G * N).norm() < 1e-15);
  // N = (-s/2, c/2, 1) / sqrt(I), I = m L^2 / 3 about the pivot.
  const double I = 2.0 / 3.0;
  Eigen::Vector3d n(-0.5 * s, 0.5 * c, 1.0);
  n /= std::sqrt(I);
  CHECK(std::min((N.col(0) - n).norm(), (N.col(0) + n).norm()) < 1e-14);

  Eigen::VectorXd F = Eigen::VectorXd::Zero(3), a(3), lambda(2);
  F[2] = 5.0;
  mechanics.accelerations(F, a, lambda);
  const double alpha = (5.0 - 0.4 * omega - 2.0 * 9.81 * 0.5 * c) / I;
  CHECK(a[2] == doctest::Approx(alpha).epsilon(1e-13));
  CHECK(a[0] == doctest::Approx(-0.5 * s * alpha - 0.5 * c * omega * omega).epsilon(1e-13));
  CHECK((G * a - mechanics.gamma()).norm() < 1e-13);
  const Eigen::VectorXd left = mechanics.mass_matrix().cwiseProduct(a) + G.transpose() * lambda;
  CHECK(left.isApprox(mechanics.forces().head(3) + F, 1e-13));

  // Across the end: I / L^2; along the rod nothing gives way.
  const BodyId b{1};
  CHECK(mechanics.effective_mass(b, {c, s}, {-s, c}) == doctest::Approx(I).epsilon(1e-13));
  CHECK(mechanics.effective_mass(b, {c, s}, {-3.0 * s, 3.0 * c}) ==
        doctest::Approx(I).epsilon(1e-13));
  CHECK(mechanics.effective_mass(b, {c, s}, {c, s}) == std::numeric_limits<double>::infinity());
}

TEST_CASE("mechanics of mechanisms in motion: identities, and the accelerations of a run") {
  for (const Model& model : {double_pendulum(), slider_crank()}) {
    Simulation run(model, {.until = 0.1, .samples = 0});
    run.advance_to(0.0731);
    const State& state = run.state();
    Mechanics mechanics(model);
    mechanics.at(state);
    const auto n = static_cast<Eigen::Index>(mechanics.coordinates());
    const Eigen::MatrixXd &G = mechanics.constraint_jacobian(), &N = mechanics.null_space();
    const Eigen::VectorXd& M = mechanics.mass_matrix();
    CHECK((G * N).cwiseAbs().maxCoeff() < 1e-12);
    CHECK(
        (N.transpose() * M.asDiagonal() * N)
            .isApprox(Eigen::MatrixXd::Identity(mechanics.freedom(), mechanics.freedom()), 1e-12));
    Eigen::VectorXd a(n), lambda(mechanics.equations());
    mechanics.accelerations(Eigen::VectorXd::Zero(n), a, lambda);
    CHECK((a - state.a).norm() < 1e-10 * state.a.norm());
    CHECK((lambda - state.lambda).norm() < 1e-10 * state.lambda.norm());

    // G against differences of Phi; gamma against those of G along the motion.
    const double h = 1e-6;
    Eigen::MatrixXd difference(G.rows(), n);
    const Eigen::MatrixXd here = G;
    const Eigen::VectorXd gamma = mechanics.gamma();
    for (Eigen::Index i = 0; i < n; ++i) {
      State beside = state;
      beside.q[i] += h;
      mechanics.at(beside);
      difference.col(i) = mechanics.positions_off();
      beside.q[i] -= 2.0 * h;
      mechanics.at(beside);
      difference.col(i) = (difference.col(i) - mechanics.positions_off()) / (2.0 * h);
    }
    CHECK((difference - here).cwiseAbs().maxCoeff() < 1e-8);
    State later = state;
    later.q += h * state.v;
    mechanics.at(later);
    const Eigen::VectorXd after = mechanics.velocities_off();
    later.q -= 2.0 * h * state.v;
    mechanics.at(later);
    const Eigen::VectorXd rate = (after - mechanics.velocities_off()) / (2.0 * h);
    CHECK((rate + gamma).norm() < 1e-6 * (1.0 + gamma.norm()));

    // The effective mass against the acceleration for a unit of force.
    mechanics.at(state);
    const BodyId body{2};
    const Vec2 point = state.q.segment<2>(3) + Vec2(0.02, -0.05), u(0.6, 0.8);
    const Vec2 arm = point - Vec2(state.q.segment<2>(3));
    Eigen::VectorXd F = Eigen::VectorXd::Zero(n), pushed(n);
    F.segment<3>(3) = Eigen::Vector3d(u.x(), u.y(), cross(arm, u));
    mechanics.accelerations(F, pushed, lambda);
    CHECK(mechanics.effective_mass(body, point, u) ==
          doctest::Approx(1.0 / F.dot(pushed - a)).epsilon(1e-9));
  }
}

TEST_CASE("mechanics: redundant equations, and what is refused") {
  Model m;
  const BodyId b = m.add(Body{.name = "b", .mass = 1.5, .inertia = 0.2});
  m.add(Prismatic{.name = "guide", .a = ground, .b = b, .along = {1.0, 0.0}});
  m.add(PointOnLine{.name = "again", .a = b, .at = {0.3, 0.0}, .b = ground, .along = {1.0, 0.0}});
  Mechanics mechanics(m);
  CHECK_THROWS_WITH_AS(mechanics.gamma(), "mechanics: call at() first", ModelError);
  mechanics.at(m.start_state());
  CHECK(mechanics.equations() == 3);
  CHECK(mechanics.freedom() == 1);
  CHECK(std::abs(mechanics.null_space()(0, 0)) == doctest::Approx(1.0 / std::sqrt(1.5)));
  CHECK(mechanics.effective_mass(b, {0.0, 0.0}, {1.0, 0.0}) == doctest::Approx(1.5));
  CHECK_THROWS_WITH_AS(mechanics.effective_mass(b, {0.0, 0.0}, {0.0, 0.0}),
                       doctest::Contains("direction = (0, 0) must be finite"), ModelError);
  CHECK_THROWS_AS(mechanics.effective_mass(ground, {0.0, 0.0}, {1.0, 0.0}), ModelError);
  Eigen::VectorXd a(2), F = Eigen::VectorXd::Zero(3), lambda(3);
  CHECK_THROWS_WITH_AS(mechanics.accelerations(F, a, lambda),
                       "mechanics: a has 2 entries, it must have 3", ModelError);
  CHECK_THROWS_WITH_AS(mechanics.at(double_pendulum().start_state()),
                       "mechanics: the state has 6 positions, the model 3", ModelError);
}

TEST_CASE("state space of a rod: closed forms") {
  const double angle = -0.5 * pi + 0.3, I = 2.0 / 3.0;
  const Model model = rod(angle, 0.0);
  const StateSpace s =
      state_space(model, model.start_state(), {"motor.torque", "damper.damping"},
                  {"rod.angle_rad", "rod.x_m", "rod.omega_rad_per_s", "rod.alpha_rad_per_s2"});
  REQUIRE(s.A.rows() == 2);
  // p = sqrt(I) theta, up to its sign.
  const double unit = s.C(0, 0);
  CHECK(std::abs(unit) == doctest::Approx(1.0 / std::sqrt(I)).epsilon(1e-9));
  CHECK(s.A(1, 0) == doctest::Approx(2.0 * 9.81 * 0.5 * std::sin(angle) / I).epsilon(1e-12));
  CHECK(s.A(1, 1) == doctest::Approx(-0.4 / I).epsilon(1e-12));
  CHECK(s.B(1, 0) == doctest::Approx(unit).epsilon(1e-9));
  CHECK(s.B(0, 0) == 0.0);
  CHECK(std::abs(s.B(1, 1)) < 1e-9);  // at rest a damper does nothing
  CHECK(s.C(1, 0) == doctest::Approx(-0.5 * std::sin(angle) * unit).epsilon(1e-9));
  CHECK(s.C(2, 1) == doctest::Approx(unit).epsilon(1e-9));
  CHECK(s.C(3, 0) == doctest::Approx(s.A(1, 0) * unit).epsilon(1e-8));
  CHECK(s.D(3, 0) == doctest::Approx(1.0 / I).epsilon(1e-9));
  CHECK(std::abs(s.D(0, 0)) < 1e-12);
  CHECK_THROWS_WITH_AS(state_space(model, model.start_state(), {"motor.speed"}, {}),
                       doctest::Contains("unknown parameter 'motor.speed'"), ModelError);
  CHECK_THROWS_WITH_AS(state_space(model, model.start_state(), {}, {"rod.z_m"}),
                       doctest::Contains("unknown column 'rod.z_m'"), ModelError);
}

TEST_CASE("a linear plant along a run is the state space at each of its states") {
  const Model model = slider_crank();
  const std::vector<std::string> inputs{"motor.torque", "load.fx"};
  const std::vector<std::string> outputs{"crank.angle_rad", "slider.ax_m_per_s2", "main.fx_N"};
  Simulation run(model, {.until = 0.3, .samples = 0});
  LinearPlant plant(model, inputs, outputs);
  CHECK(plant.state().q == run.state().q);
  for (const double t : {0.0, 0.1, 0.23}) {
    run.advance_to(t);
    plant.at(run.state());
    CHECK((plant.state().q - run.state().q).norm() < 1e-15);
    const StateSpace once = state_space(model, run.state(), inputs, outputs);
    CHECK(once.A == once.about.A);
    CHECK(plant.basis().isApprox(once.about.basis, 1e-12));
    CHECK(plant.basis_rate().isApprox(once.about.basis_rate, 1e-11));
    CHECK(plant.A().isApprox(once.A, 1e-11));
    CHECK(plant.B().isApprox(once.B, 1e-9));
    CHECK(plant.C().isApprox(once.C, 1e-7));
    CHECK(plant.D().isApprox(once.D, 1e-7));
  }
  CHECK_THROWS_WITH_AS(plant.at(double_pendulum().start_state()),
                       "state space: the state has 6 positions, the model 9", ModelError);
}

TEST_CASE("state space about a motion: what inputs do at once, and to a run") {
  const Model model = slider_crank();
  const StateSpace s = state_space(
      model, model.start_state(), {"motor.torque", "load.fx"},
      {"crank.angle_rad", "crank.omega_rad_per_s", "crank.alpha_rad_per_s2", "slider.ax_m_per_s2"});
  REQUIRE(s.about.freedom == 1);
  REQUIRE(s.A.rows() == 2);
  const double unit = s.C(0, 0);
  CHECK(s.C(1, 1) == doctest::Approx(unit).epsilon(1e-8));
  CHECK(s.D(2, 0) == doctest::Approx(unit * s.B(1, 0)).epsilon(1e-8));
  CHECK(s.D(2, 1) == doctest::Approx(unit * s.B(1, 1)).epsilon(1e-8));
  // d(omega) = B u t + O(t^2) after a short time.
  const auto omega_after = [&](double torque) {
    Simulation run(model, {.until = 1e-3, .relative_tolerance = 1e-12, .samples = 0});
    run.set("motor.torque", torque);
    run.advance_to(1e-4);
    return run.get("crank.omega_rad_per_s");
  };
  const double response = (omega_after(1.5 + 1e-2) - omega_after(1.5 - 1e-2)) / (2e-2 * 1e-4);
  CHECK(response == doctest::Approx(unit * s.B(1, 0)).epsilon(1e-2));
}
