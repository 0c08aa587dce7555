// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Natural modes against closed forms and against simulate().
#include <doctest/doctest.h>

#include <boost/math/special_functions/bessel.hpp>

#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/analyses/modes.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/weld.hpp>
#include <yoke/tests/integrators/analyses/analysed.hpp>
#include <yoke/tests/integrators/relaxing_spring.hpp>
#include <yoke/tests/integrators/wall.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

constexpr double g = 9.81;

double omega(const Mode& mode) { return 2.0 * pi * mode.frequency; }

/// `links` uniform rods in a vertical row, each `length` long, hanging (or standing) from the
/// origin.
Model chain(int links, double length, double mass, double down = -1.0) {
  Model m;
  BodyId last = ground;
  for (int i = 0; i < links; ++i) {
    const Vec2 top(0.0, down * i * length), middle(0.0, down * (i + 0.5) * length);
    const auto link = m.add(Body{.name = "link " + std::to_string(i),
                                 .mass = mass,
                                 .inertia = mass * length * length / 12.0,
                                 .pose = {middle, 0.5 * down * pi}});
    m.add(Revolute{.name = "joint " + std::to_string(i), .a = last, .b = link, .at = top});
    last = link;
  }
  m.add(Gravity{});
  return m;
}

/// A slider of `mass` on a guide along x, spring and damper to the ground.
Model oscillator(double mass, double k, double c) {
  Model m;
  const auto slider =
      m.add(Body{.name = "slider", .mass = mass, .inertia = 1.0, .pose = {{1.0, 0.0}, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = slider,
                            .at_a = {0.0, 0.0},
                            .at_b = {1.0, 0.0},
                            .stiffness = k,
                            .damping = c});
  return m;
}

}  // namespace

TEST_CASE("a pendulum swings with sqrt(m g s / I), upside down it falls with the same rate") {
  const double expected = std::sqrt(g * 0.5 / (1.0 / 3.0));
  const Model hanging = chain(1, 1.0, 2.0);
  const Modes down = modes(hanging, assembled_state(hanging));
  REQUIRE(down.modes.size() == 1);
  CHECK(omega(down.modes[0]) == doctest::Approx(expected).epsilon(1e-12));
  CHECK(down.modes[0].damping_ratio == 0.0);
  CHECK(down.stable);
  CHECK(down.linearisation.warning.empty());
  const Eigen::VectorXcd& shape = down.modes[0].shape;
  CHECK(std::abs(shape[0] / shape[2] - 0.5) < 1e-12);  // x of the centre by the angle
  CHECK(std::abs(shape.cwiseAbs2().dot(down.linearisation.mass) - 1.0) < 1e-12);

  const Model standing = chain(1, 1.0, 2.0, 1.0);
  const Modes up = modes(standing, assembled_state(standing));
  REQUIRE(up.modes.size() == 2);
  CHECK(!up.stable);
  CHECK(std::abs(up.modes[0].eigenvalue.real()) == doctest::Approx(expected).epsilon(1e-12));
  CHECK(up.modes[0].damping_ratio * up.modes[1].damping_ratio == doctest::Approx(-1.0));
}

TEST_CASE("a double pendulum has the two frequencies of its closed form") {
  // Uniform rods: det([4/3 1/2; 1/2 1/3] w^2 - [3/2 0; 0 1/2] g/l) = 0.
  const double a = 4.0 / 9.0 - 0.25, b = -(4.0 / 3.0 * 0.5 + 1.0 / 3.0 * 1.5), c = 0.75;
  const double root = std::sqrt(b * b - 4.0 * a * c);
  const Model m = chain(2, 1.0, 1.0);
  const Modes found = modes(m, assembled_state(m));
  REQUIRE(found.modes.size() == 2);
  CHECK(omega(found.modes[0]) ==
        doctest::Approx(std::sqrt((-b - root) / (2 * a) * g)).epsilon(1e-12));
  CHECK(omega(found.modes[1]) ==
        doctest::Approx(std::sqrt((-b + root) / (2 * a) * g)).epsilon(1e-12));
  // In phase, then against each other.
  CHECK((found.modes[0].shape[2] / found.modes[0].shape[5]).real() > 0.0);
  CHECK((found.modes[1].shape[2] / found.modes[1].shape[5]).real() < 0.0);
}

TEST_CASE("a damped oscillator has its frequency and damping ratio, overdamped its two rates") {
  const double mass = 2.0, k = 800.0;
  const Model weak = oscillator(mass, k, 8.0);
  const Modes found = modes(weak, assembled_state(weak));
  REQUIRE(found.modes.size() == 1);
  CHECK(omega(found.modes[0]) == doctest::Approx(20.0).epsilon(1e-12));
  CHECK(found.modes[0].damping_ratio ==
        doctest::Approx(8.0 / (2.0 * std::sqrt(k * mass))).epsilon(1e-12));
  CHECK(2.0 * pi * found.modes[0].damped_frequency ==
        doctest::Approx(20.0 * std::sqrt(1.0 - 0.01)).epsilon(1e-12));
  CHECK(found.stable);
  const Model strong = oscillator(mass, k, 100.0);
  const Modes creeping = modes(strong, assembled_state(strong));
  REQUIRE(creeping.modes.size() == 2);
  CHECK(creeping.modes[0].eigenvalue.real() == doctest::Approx(-10.0).epsilon(1e-12));
  CHECK(creeping.modes[1].eigenvalue.real() == doctest::Approx(-40.0).epsilon(1e-12));
  const Model pushed = oscillator(mass, k, 0.0);
  Model unstable = oscillator(mass, k, 0.0);
  unstable.add(applied_force("negative damper", unstable.find_body("slider"), {1.0, 0.0},
                             [](auto, const auto& b) { return vec(4.0 * b.vx, 0.0 * b.vy); }));
  CHECK(!modes(unstable, assembled_state(unstable)).stable);
  CHECK(modes(pushed, assembled_state(pushed)).stable);
}

TEST_CASE("an element with a state of its own takes part: a Maxwell damper") {
  // m x'' = k_m z, z' = -x' - (k_m/c) z: s (m s^2 + (m k_m/c) s + k_m) = 0 without the spring.
  Model m;
  const auto slider = m.add(Body{.name = "slider", .mass = 0.5, .inertia = 1.0});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  m.add(RelaxingSpring{.name = "maxwell", .body = slider, .stiffness = 140.0, .damping = 9.0});
  State state = assembled_state(m);
  state.z[0] = 0.0;
  const Modes found = modes(m, state);
  REQUIRE(found.modes.size() == 2);
  CHECK(found.modes[0].frequency == 0.0);
  CHECK(omega(found.modes[1]) == doctest::Approx(std::sqrt(140.0 / 0.5)).epsilon(1e-10));
  CHECK(found.modes[1].eigenvalue.real() == doctest::Approx(-140.0 / 9.0 / 2.0).epsilon(1e-10));
}

TEST_CASE("a hanging chain of 20 links comes near the zeros of Bessel's function, as 1/n^2") {
  const double length = 1.0;
  double before = 1.0;
  for (const int links : {10, 20, 40}) {
    const Model m = chain(links, length / links, 1.0 / links);
    const Modes found = modes(m, assembled_state(m));
    REQUIRE(found.modes.size() == static_cast<std::size_t>(links));
    double worst = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double expected =
          0.5 * boost::math::cyl_bessel_j_zero(0.0, k + 1) * std::sqrt(g / length);
      worst = std::max(worst,
                       std::abs(omega(found.modes[static_cast<std::size_t>(k)]) / expected - 1.0));
    }
    CHECK(worst < 0.3 * before);
    before = worst;
  }
  CHECK(before < 3e-3);
}

TEST_CASE("a free body has three rigid motions of frequency zero, two joined by a spring four") {
  Model m;
  const auto a = m.add(Body{.name = "a", .mass = 2.0, .inertia = 0.1});
  const Modes one = modes(m, assembled_state(m));
  REQUIRE(one.modes.size() == 3);
  for (const Mode& mode : one.modes) CHECK(mode.frequency == 0.0);
  CHECK(one.stable);
  const auto b = m.add(Body{.name = "b", .mass = 3.0, .inertia = 0.1, .pose = {{1.0, 0.0}, 0.0}});
  m.add(TranslationalSpring{.name = "spring",
                            .a = a,
                            .b = b,
                            .at_a = {0.0, 0.0},
                            .at_b = {1.0, 0.0},
                            .stiffness = 500.0});
  const Modes two = modes(m, assembled_state(m));
  REQUIRE(two.modes.size() == 6);
  for (std::size_t i = 0; i < 5; ++i) CHECK(two.modes[i].frequency == 0.0);
  CHECK(omega(two.modes[5]) == doctest::Approx(std::sqrt(500.0 / 1.2)).epsilon(1e-12));
}

TEST_CASE("redundant joints change nothing") {
  Model plain = chain(1, 1.0, 2.0);
  Model twice = chain(1, 1.0, 2.0);
  twice.add(
      Revolute{.name = "again", .a = ground, .b = twice.find_body("link 0"), .at = {0.0, 0.0}});
  const Modes a = modes(plain, assembled_state(plain)), b = modes(twice, assembled_state(twice));
  REQUIRE(a.modes.size() == 1);
  REQUIRE(b.modes.size() == 1);
  CHECK(a.modes[0].frequency == doctest::Approx(b.modes[0].frequency).epsilon(1e-13));
}

TEST_CASE("the stiffness of joints under load counts: a pendulum pulled aside") {
  // Constant force F along x and the weight: w^2 = sqrt(F^2 + (m g)^2) s / I about the new rest.
  const double F = 12.0, mass = 2.0, resultant = std::hypot(F, mass * g);
  Model m;
  const double angle = -std::atan2(mass * g, F);
  const auto rod = m.add(Body{.name = "rod",
                              .mass = mass,
                              .inertia = mass / 12.0,
                              .pose = {rotate(angle, {0.5, 0.0}), angle}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = rod, .at = {0.0, 0.0}});
  m.add(Gravity{});
  m.add(AppliedForce{
      .name = "pull", .body = rod, .at = rotate(angle, {0.5, 0.0}), .force = [](double) {
        return Vec2(12.0, 0.0);
      }});
  const Modes found = modes(m, assembled_state(m));
  REQUIRE(found.modes.size() == 1);
  CHECK(omega(found.modes[0]) ==
        doctest::Approx(std::sqrt(resultant * 0.5 / (mass / 3.0))).epsilon(1e-12));
  CHECK(found.linearisation.warning.empty());
}

TEST_CASE("a pendulum on a rotor swings with the order sqrt(R/r): centrifugal terms are exact") {
  const double R = 0.3, r = 0.02, speed = 50.0, inertia = 1e-9;
  Model m;
  const auto rotor =
      m.add(Body{.name = "rotor", .mass = 5.0, .inertia = 0.2, .twist = {{0.0, 0.0}, speed}});
  const auto bob = m.add(Body{.name = "bob",
                              .mass = 0.5,
                              .inertia = inertia,
                              .pose = {{R + r, 0.0}, 0.0},
                              .twist = {{0.0, speed * (R + r)}, speed}});
  m.add(Revolute{.name = "bearing", .a = ground, .b = rotor, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "hinge", .a = rotor, .b = bob, .at = {R, 0.0}});
  m.add(AngleDriver{.name = "motor", .body = rotor, .angle = constant_speed(0.0, speed)});
  const Modes found = modes(m, assembled_state(m));
  REQUIRE(found.modes.size() == 1);
  const double expected = speed * std::sqrt(R * 0.5 * r / (0.5 * r * r + inertia));
  CHECK(omega(found.modes[0]) == doctest::Approx(expected).epsilon(1e-12));
  CHECK(contains(found.linearisation.warning, "'bob' moves"));
}

TEST_CASE("a slider-crank on a spring has the frequency and decay of its small simulated swing") {
  Model m = slider_crank({.angle = 0.9, .driven = false});
  const auto slider = m.find_body("slider");
  const Vec2 at = m.body(slider).pose.position;
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = slider,
                            .at_a = {0.3, 0.0},
                            .at_b = at,
                            .stiffness = 4000.0,
                            .damping = 6.0});
  const State rest = assembled_state(m);
  const Modes found = modes(m, rest);
  REQUIRE(found.modes.size() == 1);
  const std::complex<double> s = found.modes[0].eigenvalue;
  // Started along the mode, the crank's angle is amplitude * Re(exp(s t)) up to amplitude^2.
  const double amplitude = 1e-5;
  const Eigen::VectorXcd& shape = found.modes[0].shape;
  State start = rest;
  start.q += amplitude * (shape / shape[2]).real();
  start.v = amplitude * (s * shape / shape[2]).real();
  const Result run =
      simulate(m, start, {.until = 0.05, .relative_tolerance = 1e-12, .samples = 51});
  REQUIRE(run.summary.ok());
  const Eigen::VectorXd t = run["t_s"], angle = run["crank.angle_rad"];
  double worst = 0.0;
  for (Eigen::Index i = 0; i < t.size(); ++i)
    worst =
        std::max(worst, std::abs((angle[i] - rest.q[2]) / amplitude - std::exp(s * t[i]).real()));
  CHECK(worst < 1e-3);
  CHECK(std::abs(s.imag()) * 0.05 > 3.0);  // more than half a swing was seen
}

TEST_CASE("the linearised equations are the derivatives of the accelerations, at rest and moving") {
  // A free slider-crank with spring, damper and follower force, in full motion: displaced states
  // (projected) must be accelerated as the reduced equations say, by central differences.
  Model m = slider_crank({.angle = 0.9, .omega = 30.0, .driven = false});
  const auto slider = m.find_body("slider");
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = slider,
                            .at_a = {0.3, 0.05},
                            .at_b = m.body(slider).pose.position,
                            .stiffness = 4000.0,
                            .damping = 6.0});
  m.add(applied_torque("motor", m.find_body("crank"),
                       [](auto, const auto& b) { return 0.3 * b.angle - 0.01 * b.omega; }));
  m.add(Gravity{});
  const State rest = assembled_state(m);
  const Linearisation l = linearise(m, rest);
  REQUIRE(l.degrees_of_freedom() == 1);
  CHECK(contains(l.warning, "moves"));
  Dynamics dynamics(m);
  const double h = 1e-6;
  const auto acceleration = [&](double dp, double du) {
    State s = rest;
    s.q += dp * l.basis.col(0);
    s.v += dp * l.basis_rate.col(0) + du * l.basis.col(0);
    REQUIRE(dynamics.project(s));
    return s.a;
  };
  const Eigen::VectorXd weighted = l.mass.cwiseProduct(l.basis.col(0));
  const double by_p = weighted.dot(acceleration(h, 0.0) - acceleration(-h, 0.0)) / (2.0 * h);
  const double by_u = weighted.dot(acceleration(0.0, h) - acceleration(0.0, -h)) / (2.0 * h);
  // N^T M a = p.. + N^T M N'' p, and N^T M N'' = -N'^T M N'.
  const double turning = -l.basis_rate.col(0).cwiseProduct(l.mass).dot(l.basis_rate.col(0));
  CHECK(turning < -1.0);
  CHECK(by_p == doctest::Approx(-l.K_reduced(0, 0) + turning).epsilon(1e-7));
  CHECK(by_u == doctest::Approx(-l.C_reduced(0, 0)).epsilon(1e-7));
}

TEST_CASE("a ball that rests on a floor rings with the stiffness of its contact") {
  const double mass = 0.4, K = 2e7, n = 1.5;
  Model m;
  const double d = std::pow(mass * g / K, 1.0 / n);
  const auto ball =
      m.add(Body{.name = "ball", .mass = mass, .inertia = 1e-4, .pose = {{0.0, -d}, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = ball, .along = {0.0, 1.0}});
  m.add(Wall{.name = "floor", .body = ball, .law = {PowerLaw{K, n}}});
  m.add(Gravity{});
  State state = assembled_state(m);
  state.contacts[0].phase = ContactPhase::compressing;
  const Modes found = modes(m, state);
  REQUIRE(found.modes.size() == 1);
  CHECK(omega(found.modes[0]) == doctest::Approx(std::sqrt(n * mass * g / d / mass)).epsilon(1e-9));
  CHECK(found.linearisation.warning.empty());
}

TEST_CASE("away from equilibrium there is a warning, and too large a model is not linearised") {
  const Model m = chain(1, 1.0, 1.0);
  State state = assembled_state(m);
  state.q[2] += 0.5;
  const Modes found = modes(m, state);
  CHECK_MESSAGE(contains(found.linearisation.warning, "'link 0' is accelerated"),
                found.linearisation.warning);
  const Model long_chain = chain(501, 0.01, 0.01);
  CHECK(contains(message_of([&] { linearise(long_chain, long_chain.start_state()); }),
                 "1503 coordinates and element states; dense matrices are made for at most 1500"));
}
