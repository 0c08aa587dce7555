// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <yoke/tests/docs/friction_example.hpp>
#include <yoke/tests/documentation.hpp>

TEST_CASE("the code in docs/friction.md is compiled here and does what it says") {
  yoke::tests::check_blocks("docs/friction.md", "cpp", 3, {"tests/docs/friction_example.hpp"});

  using namespace yoke;
  using namespace yoke::friction_example;
  const SimulationOptions options{.until = 0.5, .relative_tolerance = 1e-9, .samples = 101};
  const Result driven = simulate(spinning_wheel(rubber()), options);
  REQUIRE(driven.summary.ok());
  CHECK(driven["wheel.vx_m_per_s"].tail(1)[0] > 0.3);  // a third of r w, 1 m/s
  CHECK(driven["floor.friction_force_N"].cwiseAbs().maxCoeff() > 4.0);

  const Result stops = simulate(flywheel(Coulomb{0.2, 0.2}), {.until = 3.0, .samples = 31});
  REQUIRE(stops.summary.ok());
  CHECK(stops.final.q[2] ==
        doctest::Approx(0.5 * 4.0 * 4.0 / (0.2 * 0.01 * 3.0 * 9.81 / 0.02)).epsilon(1e-4));
  CHECK(std::abs(stops.final.v[2]) < 1e-12);

  const ContactLaw own{PowerLaw{1e7, 1.5}, HuntCrossley{0.3}, Arctangent{.mu = 0.5}};
  const Result by_own = simulate(spinning_wheel(own), options);
  REQUIRE(by_own.summary.ok());
  CHECK(by_own.summary.energy_balance < 1e-6 * by_own.summary.energy_exchanged);
  CHECK(by_own["wheel.vx_m_per_s"].tail(1)[0] > 0.3);
}
