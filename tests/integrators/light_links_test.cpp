// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A slider that hands its energy to light links and takes it back: no singular position, whatever
// the ratio of the masses and however the model is turned.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

namespace {

using namespace yoke;

/// Crank 0.1 m, rod 0.3 m, slider of 1 kg at 0.5 m/s, links of 1 kg / ratio, all turned by `turn`.
Model free_slider_crank(double ratio, double turn = 0.0) {
  constexpr double angle = 1.2, r = 0.1, l = 0.3, speed = 0.5;
  const Vec2 tip = rotate(angle, {r, 0.0});
  const Vec2 end(tip.x() + std::sqrt(l * l - tip.y() * tip.y()), 0.0);
  const double lean = std::asin(tip.y() / l);
  const double omega = -speed / (tip.y() + tip.x() * std::tan(lean));
  const double omega_rod = -tip.x() * omega / (l * std::cos(lean));
  const Vec2 middle = 0.5 * (tip + end), v_tip = omega * perp(tip);
  const auto turned = [turn](const Vec2& p) { return rotate(turn, p); };
  Model m;
  const auto add = [&](const char* name, double mass, double inertia, const Vec2& at, double lie,
                       const Vec2& velocity, double rate) {
    return m.add({.name = name,
                  .mass = mass,
                  .inertia = inertia,
                  .pose = {turned(at), lie + turn},
                  .twist = {turned(velocity), rate}});
  };
  const double link = 1.0 / ratio;
  const BodyId crank =
      add("crank", link, link * r * r / 12.0, 0.5 * tip, angle, 0.5 * v_tip, omega);
  const BodyId rod = add("rod", link, link * l * l / 12.0, middle, -lean,
                         v_tip + omega_rod * perp(Vec2(middle - tip)), omega_rod);
  const BodyId slider = add("slider", 1.0, 0.01, end, 0.0, {speed, 0.0}, 0.0);
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "pin", .a = crank, .b = rod, .at = turned(tip)});
  m.add(Revolute{.name = "wrist", .a = rod, .b = slider, .at = turned(end)});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = turned({1.0, 0.0})});
  return m;
}

double energy_error(const Result& run) {
  const Eigen::VectorXd kinetic = run["kinetic_J"];
  return (kinetic.array() / kinetic[0] - 1.0).abs().maxCoeff();
}

}  // namespace

TEST_CASE("a dead centre with light links is no singular position, in any formulation") {
  for (const FormulationNote& formulation : formulations()) {
    const bool low = formulation.order <= 2;
    for (const double ratio : {1.0, 1e3, 1e4, 1e5, 1e6}) {
      INFO(formulation.name, ", mass ratio ", ratio);
      const Result run =
          simulate(free_slider_crank(ratio), {.until = 1.0,
                                              .relative_tolerance = low ? 1e-7 : 1e-9,
                                              .formulation = std::string(formulation.name)});
      INFO(run.summary.reason);
      REQUIRE(run.summary.ok());
      CHECK(run.summary.singular_positions.empty());
      CHECK(energy_error(run) < 1e-5);
      CHECK(run["slider.vx_m_per_s"].minCoeff() < -0.49);  // it has been sent back
    }
  }
}

TEST_CASE(
    "the energy over a dead centre follows the tolerance, and turning the model changes nothing") {
  for (const double ratio : {1e4, 1e6}) {
    INFO("mass ratio ", ratio);
    const Result loose =
        simulate(free_slider_crank(ratio), {.until = 0.3, .relative_tolerance = 1e-7});
    const Result run =
        simulate(free_slider_crank(ratio), {.until = 0.3, .relative_tolerance = 1e-10});
    const Result turned =
        simulate(free_slider_crank(ratio, 0.7), {.until = 0.3, .relative_tolerance = 1e-10});
    REQUIRE(loose.summary.ok());
    REQUIRE(run.summary.ok());
    REQUIRE(turned.summary.ok());
    CHECK(energy_error(run) < 1e-8);
    CHECK(energy_error(run) < 0.1 * energy_error(loose));
    const Eigen::VectorXd x = run["slider.x_m"], along = turned["slider.x_m"] * std::cos(0.7) +
                                                         turned["slider.y_m"] * std::sin(0.7);
    CHECK((x - along).cwiseAbs().maxCoeff() < 1e-7);
  }
}
