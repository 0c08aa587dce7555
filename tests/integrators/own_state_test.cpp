// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <complex>
#include <string>

#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/relaxing_spring.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

Model sprung_mass() {
  Model m;
  const auto b = m.add(Body{.name = "mass",
                            .mass = 1.7,
                            .inertia = 0.2,
                            .pose = {{0.3, 0.0}, 0.0},
                            .twist = {{0.9, 0.0}, 0.0}});
  m.add(RelaxingSpring{.name = "maxwell", .body = b});
  return m;
}

/// Closed form: (v, z)' = [[0, k/m], [-1, -k/c]] (v, z), by its two eigenvalues.
std::pair<double, double> exact(double t, double k, double c, double m, double v0, double z0) {
  using C = std::complex<double>;
  const C root = std::sqrt(C(k * k / (c * c) / 4.0 - k / m));
  const C s1 = -k / (2.0 * c) + root, s2 = -k / (2.0 * c) - root;
  // z = A e^{s1 t} + B e^{s2 t}, z'(0) = -v0 - k/c z0
  const C slope = -v0 - k / c * z0;
  const C A = (slope - s2 * z0) / (s1 - s2), B = C(z0) - A;
  const C z = A * std::exp(s1 * t) + B * std::exp(s2 * t);
  const C z_dot = A * s1 * std::exp(s1 * t) + B * s2 * std::exp(s2 * t);
  return {(-z_dot - k / c * z).real(), z.real()};
}

}  // namespace

TEST_CASE("an element's own state is integrated, reported and closes the energy ledger") {
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "generalised-alpha"}) {
    INFO(formulation);
    const Result run = simulate(
        sprung_mass(),
        {.until = 0.7, .relative_tolerance = 1e-11, .formulation = formulation, .samples = 8});
    REQUIRE(run.summary.ok());
    const auto [v, z] = exact(0.7, 140.0, 9.0, 1.7, 0.9, 0.002);
    CHECK(run["mass.vx_m_per_s"](7) == doctest::Approx(v).epsilon(1e-8));
    CHECK(run["maxwell.extension_m"](7) == doctest::Approx(z).epsilon(1e-8));
    CHECK(run.summary.energy_balance < 1e-8 * run.summary.energy_exchanged);
  }
}

TEST_CASE("a changeable parameter is changed in the state, not in the model") {
  const Model model = sprung_mass();
  State start = model.start_state();
  start.parameters[model.find_parameter("maxwell.stiffness")] = 300.0;
  const Result run = simulate(model, start, {.until = 0.7, .relative_tolerance = 1e-11});
  const auto [v, z] = exact(0.7, 300.0, 9.0, 1.7, 0.9, 0.002);
  CHECK(run["mass.vx_m_per_s"](1000) == doctest::Approx(v).epsilon(1e-8));
  CHECK_THROWS_WITH_AS(model.find_parameter("maxwell.mass"),
                       "unknown parameter 'maxwell.mass': the model has 'maxwell.stiffness'",
                       ModelError);
}
