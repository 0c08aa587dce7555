// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Orbits, bifurcations and exponents against the limit of rigid bodies and against what is known of chaos.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/studies/oscillators.hpp>
#include <yoke/yoke.hpp>

using namespace yoke;
using namespace yoke::tests;

namespace {

/// Gamma at which the orbit of the ball on the table has the multiplier -1, by the secant method.
double flip_of_table(double restitution, double stiffness) {
  const auto f = [&](double acceleration) {
    const VibratingTable t{
        .acceleration = acceleration, .restitution = restitution, .stiffness = stiffness};
    const PeriodicOrbit orbit = periodic_orbit(t.model(), {.period = t.period()});
    REQUIRE(orbit.found);
    return 1.0 + orbit.monodromy.trace() + orbit.determinant;
  };
  double x0 = 0.98 * VibratingTable::flip(restitution), x1 = x0 / 0.98;
  double f0 = f(x0), f1 = f(x1);
  for (int i = 0; i < 5 && std::abs(f1) > 1e-9; ++i) {
    const double x2 = x1 - f1 * (x1 - x0) / (f1 - f0);
    x0 = x1, f0 = f1, x1 = x2, f1 = f(x2);
  }
  return x1;
}

}  // namespace

TEST_CASE(
    "a ball on a vibrating table doubles its period where rigid bodies do, as stiffness grows") {
  for (const double restitution : {0.6, 0.8}) {
    double last = 0.0;
    for (const double stiffness : {1e6, 1e7, 1e8}) {
      const double flip = flip_of_table(restitution, stiffness);
      const double off = std::abs(flip - VibratingTable::flip(restitution));
      MESSAGE(fmt::format("r = {}, k = {:g} N/m: flip at Gamma = {:.6f}, {:.1e} off", restitution,
                          stiffness, flip, off));
      CHECK(off < 10.0 * VibratingTable{.stiffness = stiffness}.contact_share());
      if (last > 0.0) CHECK(off < 0.45 * last);  // 0.316 in the limit
      last = off;
    }
    CHECK(last < 2e-3);
  }
}

TEST_CASE(
    "beyond its flip the ball on the table has an unstable orbit, and settles on one of twice the period") {
  const double r = 0.8;
  const VibratingTable t{
      .acceleration = 1.02 * VibratingTable::flip(r), .restitution = r, .stiffness = 1e6};
  const double T = t.period();
  const PeriodicOrbit once = periodic_orbit(t.model(), {.period = T});
  REQUIRE(once.found);
  CHECK(once.stability == OrbitStability::unstable);
  CHECK(once.multipliers.front().value.real() < -1.0);
  State pushed = once.start;
  pushed.v[4] += 1e-3;
  const PeriodicOrbit twice =
      periodic_orbit(t.model(), pushed, {.period = 2.0 * T, .settle = 400.0 * T});
  REQUIRE(twice.found);
  CHECK(twice.stability == OrbitStability::stable);
  const auto at_T =
      simulate(t.model(), twice.start, {.until = twice.start.t + T, .relative_tolerance = 1e-10});
  CHECK((at_T.final.q - twice.start.q).norm() > 1e-5);
}

TEST_CASE("the forced oscillator with a stop tends to that of rigid bodies") {
  for (const double restitution : {0.5, 0.8}) {
    double last = 0.0;
    for (const double stiffness : {1e4, 1e6, 1e8}) {
      const ImpactOscillator o{.restitution = restitution, .stiffness = stiffness};
      const ImpactOscillator::Rigid rigid = o.rigid();
      const PeriodicOrbit orbit = periodic_orbit(o.model(), {.period = o.period()});
      REQUIRE(orbit.found);
      const double off = std::abs(orbit.monodromy.trace() - rigid.trace);
      MESSAGE(fmt::format("r = {}, k = {:g} N/m: trace {:.6f}, rigid {:.6f}", restitution,
                          stiffness, orbit.monodromy.trace(), rigid.trace));
      CHECK(std::abs(orbit.determinant - rigid.determinant) <
            0.05 / std::sqrt(std::sqrt(stiffness)));
      if (last > 0.0) CHECK(off < 0.15 * last);
      last = off;
    }
    CHECK(last < 3e-3);
  }
}

TEST_CASE(
    "a double pendulum: a large swing is chaotic, a small one is not, and both keep volumes") {
  const auto exponents = [](double angle) {
    Model m = double_pendulum();
    State start = assembled_state(m);
    const Vec2 along(std::sin(angle), -std::cos(angle));
    start.q << 0.5 * along, angle - 0.5 * pi, 1.5 * along, angle - 0.5 * pi;
    return lyapunov(m, start, {.until = 400.0, .transient = 20.0, .exponents = 4});
  };
  const Lyapunov large = exponents(0.5 * pi), small = exponents(0.1);
  for (const Lyapunov* l : {&large, &small}) {
    REQUIRE(l->complete);
    MESSAGE(fmt::format("{:.4f} +- {:.4f}, {:.4f}, {:.4f}, {:.4f} 1/s", l->exponents[0],
                        l->uncertainty[0], l->exponents[1], l->exponents[2], l->exponents[3]));
    CHECK(std::abs(l->exponents.sum()) < 1e-6);
    CHECK(std::abs(l->exponents[0] + l->exponents[3]) < 0.02);
    CHECK(std::abs(l->exponents[1]) < 0.05);
  }
  CHECK(large.exponents[0] > 10.0 * large.uncertainty[0]);
  CHECK(small.exponents[0] < 0.05);
}
