// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Periodic orbits and their multipliers against closed forms, and searches that find none.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include <yoke/tests/integrators/studies/oscillators.hpp>
#include <yoke/tests/messages.hpp>
#include <yoke/yoke.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

}  // namespace

TEST_CASE("the orbit of a forced linear oscillator and its multipliers are the closed form") {
  const ForcedOscillator o{.stiffness = 100.0, .damping = 0.8, .force = 3.0, .omega = 7.0};
  const double T = 2.0 * pi / o.omega;
  const PeriodicOrbit orbit = periodic_orbit(o.model(), {.period = T});
  REQUIRE(orbit.found);
  CHECK(orbit.residuals.size() == 2);  // linear: one step
  CHECK(orbit.stability == OrbitStability::stable);
  CHECK(orbit.bifurcation == BifurcationKind::none);
  const std::complex<double> exact =
      std::exp(std::complex<double>(-0.5 * o.damping, std::sqrt(100.0 - 0.16)) * T);
  REQUIRE(orbit.multipliers.size() == 2);
  for (const FloquetMultiplier& m : orbit.multipliers) {
    CHECK(std::abs(m.value.real() - exact.real()) < 1e-9);
    CHECK(std::abs(std::abs(m.value.imag()) - std::abs(exact.imag())) < 1e-9);
    CHECK_FALSE(m.trivial);
  }
  CHECK(orbit.determinant == doctest::Approx(std::exp(-o.damping * T)).epsilon(1e-9));
  // x = Re F exp(i w t) / (k - w^2 + i c w)
  const std::complex<double> response = o.force / std::complex<double>(100.0 - 49.0, 0.8 * 7.0);
  CHECK(std::abs(orbit.start.q[0] - response.real()) < 1e-8);
  CHECK(std::abs(orbit.start.v[0] + o.omega * response.imag()) < 1e-7);
}

TEST_CASE(
    "a swinging pendulum is one of a family of orbits, with the period of the elliptic integral") {
  Model m;
  const BodyId rod = m.add({.name = "rod",
                            .mass = 1.0,
                            .inertia = 1.0 / 12.0,
                            .pose = {{0.5 * std::sin(1.0), -0.5 * std::cos(1.0)}, 1.0}});
  m.add(Gravity{});
  m.add(Revolute{.name = "pivot", .a = ground, .b = rod});
  const PeriodicOrbit orbit = periodic_orbit(m, {.period = 1.7, .autonomous = true});
  REQUIRE(orbit.found);
  const double largest = orbit.run["rod.angle_rad"].cwiseAbs().maxCoeff();
  CHECK(orbit.period == doctest::Approx(4.0 * std::sqrt(2.0 / 3.0 / 9.81) *
                                        std::comp_ellint_1(std::sin(0.5 * largest)))
                            .epsilon(1e-7));
  CHECK(orbit.determinant == doctest::Approx(1.0).epsilon(1e-8));
  CHECK(orbit.stability == OrbitStability::neutral);
  for (const FloquetMultiplier& multiplier : orbit.multipliers) {
    CHECK(multiplier.trivial);  // along the orbit, and across the family
    CHECK(std::abs(multiplier.value - 1.0) < 1e-3);
  }
}

TEST_CASE("a pendulum that turns over comes back after a whole turn") {
  Model m;
  const BodyId rod = m.add({.name = "rod",
                            .mass = 1.0,
                            .inertia = 1.0 / 12.0,
                            .pose = {{0.0, -0.5}, 0.0},
                            .twist = {{5.0, 0.0}, 10.0}});
  m.add(Gravity{});
  m.add(Revolute{.name = "pivot", .a = ground, .b = rod});
  PeriodicOrbitOptions options{.period = 0.7, .autonomous = true};
  const PeriodicOrbit orbit = periodic_orbit(m, options);
  REQUIRE(orbit.found);
  CHECK(orbit.run.final.q[2] - orbit.start.q[2] == doctest::Approx(2.0 * pi).epsilon(1e-9));
  // T = int dtheta / omega, with omega^2 = omega_0^2 - (6 g / L) sin^2(theta / 2) ... / 1
  const double w0 = orbit.start.v[2], k2 = 4.0 * 1.5 * 9.81 / (w0 * w0);
  CHECK(orbit.period ==
        doctest::Approx(4.0 / w0 * std::comp_ellint_1(std::sqrt(k2))).epsilon(1e-7));
  options.whole_turns = false;
  CHECK_FALSE(periodic_orbit(m, options).found);
}

TEST_CASE("van der Pol's oscillator has one orbit, which attracts") {
  const PeriodicOrbit orbit =
      periodic_orbit(van_der_pol(1.0, 1.5), {.period = 6.5, .autonomous = true, .settle = 5.0});
  REQUIRE(orbit.found);
  CHECK(orbit.period == doctest::Approx(6.6632868593231).epsilon(1e-8));
  REQUIRE(orbit.multipliers.size() == 2);
  CHECK(orbit.multipliers[0].trivial);
  CHECK(std::abs(orbit.multipliers[0].value - 1.0) < 1e-7);
  CHECK(orbit.stability == OrbitStability::stable);
  CHECK(orbit.largest_multiplier == doctest::Approx(8.5969e-4).epsilon(1e-3));
}

TEST_CASE("a ball on a vibrating table: the multipliers tend to those of rigid bodies") {
  double last = 0.0;
  for (const double stiffness : {1e6, 1e7}) {
    const VibratingTable t{.acceleration = 0.8, .restitution = 0.8, .stiffness = stiffness};
    const PeriodicOrbit orbit = periodic_orbit(t.model(), {.period = t.period()});
    REQUIRE(orbit.found);
    CHECK(orbit.stability == OrbitStability::stable);
    CHECK(std::abs(orbit.determinant - t.determinant()) < 2.0 * t.contact_share());
    const double off = std::abs(orbit.monodromy.trace() - t.trace());
    CHECK(off < 10.0 * t.contact_share());
    if (last > 0.0) CHECK(off < 0.4 * last);  // like the root of the compliance, 0.316
    last = off;
  }
}

TEST_CASE(
    "a forced oscillator that strikes a stop: orbit and multipliers tend to those of rigid bodies") {
  double last_speed = 0.0, last_trace = 0.0;
  for (const double stiffness : {1e5, 1e7}) {
    const ImpactOscillator o{.stiffness = stiffness};
    const ImpactOscillator::Rigid rigid = o.rigid();
    const PeriodicOrbit orbit = periodic_orbit(o.model(), {.period = o.period()});
    REQUIRE(orbit.found);
    CHECK(orbit.stability == OrbitStability::stable);
    const auto onset = std::ranges::find(orbit.run.events, "onset", &EventRecord::kind);
    REQUIRE(onset != orbit.run.events.end());
    const double speed = std::abs(onset->speed / rigid.speed - 1.0);
    const double trace = std::abs(orbit.monodromy.trace() - rigid.trace);
    CHECK(speed < 5e-3);
    CHECK(trace < 5e-2);
    CHECK(orbit.determinant == doctest::Approx(rigid.determinant).epsilon(3e-3));
    if (last_speed > 0.0) {  // like the root of the compliance: a tenth
      CHECK(speed < 0.13 * last_speed);
      CHECK(trace < 0.13 * last_trace);
    }
    last_speed = speed;
    last_trace = trace;
  }
}

TEST_CASE("a search that finds nothing says how far it came") {
  SUBCASE("no orbit at all: a mass that falls") {
    Model m;
    m.add({.name = "stone", .mass = 1.0, .inertia = 1.0});
    m.add(Gravity{});
    const PeriodicOrbit orbit = periodic_orbit(m, {.period = 1.0});
    CHECK_FALSE(orbit.found);
    CHECK(contains(orbit.reason, "'stone."));
    CHECK(orbit.residual > 0.1);
    CHECK(orbit.residuals.size() >= 1);
    CHECK(orbit.multipliers.size() == 6);
  }
  SUBCASE("an equilibrium is none") {
    Model m;
    const BodyId rod =
        m.add({.name = "rod", .mass = 1.0, .inertia = 1.0 / 12.0, .pose = {{0.0, -0.5}, 0.0}});
    m.add(Gravity{});
    m.add(Revolute{.name = "pivot", .a = ground, .b = rod});
    const PeriodicOrbit orbit = periodic_orbit(m, {.period = 1.0, .autonomous = true});
    CHECK_FALSE(orbit.found);
    CHECK(contains(orbit.reason, "equilibrium"));
  }
  SUBCASE("a run that fails") {
    Model m = ForcedOscillator{}.model();
    m.add(EventFunction{
        .name = "end", .function = [](const Motion& at) { return at.t - 0.1; }, .stop = true});
    const PeriodicOrbit orbit = periodic_orbit(m, {.period = 1.0});
    CHECK_FALSE(orbit.found);
    CHECK(contains(orbit.reason, "the first period could not be run: event 'end'"));
    CHECK(orbit.run.summary.t_end == doctest::Approx(0.1));
  }
}

TEST_CASE("a search with options that make no sense is refused") {
  const Model m = ForcedOscillator{}.model();
  const auto refusal = [&](const PeriodicOrbitOptions& options) {
    return message_of([&] { periodic_orbit(m, options); });
  };
  CHECK(contains(refusal({}), "period = 0 s must be finite and greater than 0 s"));
  CHECK(contains(refusal({.period = 1.0, .settle = -1.0}), "settle = -1 s is outside"));
  CHECK(contains(refusal({.period = 1.0, .tolerance = 1.0}), "tolerance = 1 is outside"));
  CHECK(contains(refusal({.period = 1.0, .largest_iterations = 0}), "largest_iterations = 0"));
}
