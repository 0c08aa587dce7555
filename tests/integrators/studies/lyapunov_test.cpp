// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Lyapunov exponents where they are known.
#include <doctest/doctest.h>

#include <cmath>

#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/studies/oscillators.hpp>
#include <yoke/tests/messages.hpp>
#include <yoke/yoke.hpp>

using namespace yoke;
using namespace yoke::tests;

TEST_CASE("exponents of a damped linear oscillator are the real parts of its eigenvalues") {
  // Overdamped: -2 and -8.
  const ForcedOscillator o{.stiffness = 16.0, .damping = 10.0};
  const Lyapunov l = lyapunov(o.model(), {.until = 10.0, .transient = 4.0, .exponents = 0});
  REQUIRE(l.complete);
  REQUIRE(l.exponents.size() == 2);
  CHECK(l.exponents[0] == doctest::Approx(-2.0).epsilon(1e-6));
  CHECK(l.exponents[1] == doctest::Approx(-8.0).epsilon(1e-6));
  CHECK(l.mean_trace == doctest::Approx(-10.0).epsilon(1e-9));
  CHECK(l.uncertainty.maxCoeff() < 1e-5);
  CHECK(l.history.rows() > 100);
  CHECK(l.history["exponent_1_1_per_s"].tail(1)[0] == l.exponents[0]);
}

TEST_CASE(
    "an exponent is zero along an autonomous orbit, and the other is that of its multiplier") {
  const Lyapunov l =
      lyapunov(van_der_pol(1.0, 1.5), {.until = 120.0, .transient = 20.0, .exponents = 2});
  REQUIRE(l.complete);
  CHECK(std::abs(l.exponents[0]) < 0.01);
  CHECK(l.exponents[1] == doctest::Approx(std::log(8.5969e-4) / 6.66328686).epsilon(0.02));
  CHECK(l.exponents.sum() == doctest::Approx(l.mean_trace).epsilon(1e-6));
}

TEST_CASE("a double pendulum from the horizontal is chaotic, and keeps volumes") {
  const Lyapunov l =
      lyapunov(double_pendulum(), {.until = 20.0,
                                   .transient = 2.0,
                                   .exponents = 4,
                                   .run = {.relative_tolerance = 1e-8, .samples = 0}});
  REQUIRE(l.complete);
  CHECK(l.exponents[0] > 0.5);
  CHECK(std::abs(l.exponents.sum()) < 1e-6);
  CHECK(std::abs(l.mean_trace) < 1e-12);
  CHECK(l.exponents[0] + l.exponents[3] == doctest::Approx(0.0).epsilon(0.05));
  CHECK(l.uncertainty[0] > 0.0);
}

TEST_CASE("exponents pass impacts: those of a stable orbit are of its multipliers") {
  const VibratingTable t{.acceleration = 0.8, .restitution = 0.8, .stiffness = 1e5};
  const PeriodicOrbit orbit = periodic_orbit(t.model(), {.period = t.period()});
  REQUIRE(orbit.found);
  const double T = t.period();
  const Lyapunov l =
      lyapunov(t.model(), orbit.start,
               {.until = 40.0 * T, .transient = 10.0 * T, .interval = T, .exponents = 2});
  REQUIRE(l.complete);
  CHECK(l.jumps >= 60);
  CHECK(l.exponents.sum() == doctest::Approx(std::log(orbit.determinant) / T).epsilon(0.01));
}

TEST_CASE("exponents with options that make no sense are refused") {
  const Model m = ForcedOscillator{}.model();
  const auto refusal = [&](const LyapunovOptions& options) {
    return message_of([&] { lyapunov(m, options); });
  };
  CHECK(contains(refusal({}), "until = 0 s is outside the accepted range"));
  CHECK(contains(refusal({.until = 1.0, .transient = 1.0}), "transient = 1 s is outside"));
  CHECK(contains(refusal({.until = 1.0, .interval = 2.0}), "interval = 2 s is outside"));
  CHECK(contains(refusal({.until = 1.0, .exponents = -1}), "exponents = -1"));
  CHECK(contains(refusal({.until = 1.0, .exponents = 3}), "must be at most 2"));
}
