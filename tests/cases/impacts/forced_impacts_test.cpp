// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Sections of the two cases of forced impacts against closed forms: grazing, periodic impacts, the map of a
// bouncing ball and its period doubling.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include <yoke/cases/impacts/forced_impacts.hpp>
#include <yoke/cases/maps/section_choice.hpp>
#include <yoke/tests/cases/impacts/impact_case.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using yoke::tests::contains;
using yoke::tests::impact_run;
using yoke::tests::message_of;

/// Points of a section of a case, `columns` of them.
Poincare section_points(const char* name, const MapRequest& request) {
  const Case& c = find_case(name);
  const SectionedModel at = sectioned_model(c, request, {});
  return poincare(at.model, at.start, at.section, map_options(c, request, at));
}

constexpr double default_w = 2.0 * pi * 0.3;

ImpactOscillator default_oscillator(double force) {
  return {.mass = 1.0,
          .spring = 1.0,
          .damping = 0.2,
          .force = force,
          .frequency = 0.3,
          .gap = 0.1,
          .restitution = 0.8};
}

/// On the steady state that knows no stop.
long impacts_from_steady_state(double force) {
  const ImpactOscillator c = default_oscillator(force);
  const double x = c.amplitude() * std::cos(c.lag()),
               v = c.amplitude() * c.omega() * std::sin(c.lag());
  const Poincare map = section_points(
      "impact_oscillator",
      {.settings = {fmt::format("force={:.17g}", force), fmt::format("start={:.17g}m", x),
                    fmt::format("start_speed={:.17g}", v)},
       .at = "event:stop.onset",
       .discard = 0,
       .points = 2,
       .duration = 3.5 / c.frequency});
  return static_cast<long>(map.points.rows());
}

MapRequest orbit_of_oscillator(const char* stiffness) {
  return {.settings = {std::string("stiffness=") + stiffness},
          .at = "event:stop.onset",
          .columns = {"mass.x_m"},
          .discard = 40,
          .points = 4,
          .duration = 300.0,
          .relative_tolerance = 1e-9};
}

/// Starts a ball in the flight that ends at the orbit's impact.
std::vector<std::string> on_orbit(const TableBall& c, const char* stiffness) {
  const TableBall::Impact impact = *c.orbit(1);
  const double flown = 1.0 / c.frequency - impact.t, g = 9.81;
  const double height = c.table(impact.t) + (impact.rebound - 0.5 * g * flown) * flown;
  return {fmt::format("amplitude={:.17g}m", c.amplitude), fmt::format("height={:.17g}m", height),
          fmt::format("speed={:.17g}", impact.rebound - g * flown),
          std::string("stiffness=") + stiffness};
}

MapRequest releases_of_ball(std::vector<std::string> settings, std::size_t discard,
                            std::size_t points) {
  return {.settings = std::move(settings),
          .at = "event:top.release",
          .columns = {"ball.vy_m_per_s"},
          .discard = discard,
          .points = points,
          .duration = 0.12 * static_cast<double>(discard + points) + 1.0,
          .relative_tolerance = 1e-8};
}

TEST_CASE("impact oscillator: without impacts it is the linear oscillator; the checks say so") {
  const auto run = impact_run("impact_oscillator", {"gap=400mm", "periods=8"});
  CHECK(contains(run.checks.front().what, "position off by"));
  CHECK(contains(message_of([] {
                   const Case& c = find_case("impact_oscillator");
                   make_model(c, Parameters(c.parameters, {"damping=3"}));
                 }),
                 "damping = 3 must be less than the critical 2 N s/m"));
}

TEST_CASE("impact oscillator: it grazes at its analytic force, to 1e-7 of it") {
  const double grazing = default_oscillator(1.0).grazing_force();
  CHECK(impacts_from_steady_state(grazing * (1.0 - 1e-7)) == 0);
  CHECK(impacts_from_steady_state(grazing * (1.0 + 1e-7)) >= 1);
}

TEST_CASE("impact oscillator: a hard stop's periodic impacts tend to the rigid closed form") {
  const std::vector<ImpactOrbit> orbits = default_oscillator(0.3).impact_orbits(1);
  REQUIRE(orbits.size() == 1);
  double before = 0.0, phase_before = 0.0;
  for (const char* stiffness : {"1e8", "1e10", "1e12"}) {
    const Poincare map = section_points("impact_oscillator", orbit_of_oscillator(stiffness));
    REQUIRE(map.complete);
    CHECK(map.period == 1);
    const Eigen::VectorXd speed = map.points["speed_m_per_s"], t = map.points["t_s"];
    const double error = orbits[0].approach - speed[3];
    const double phase = std::remainder(default_w * t[3] - orbits[0].phase, 2.0 * pi);
    CHECK(error > 0.0);
    // The contact lasts as K^(-2/5).
    if (before > 0.0) {
      CHECK(before / error == doctest::Approx(std::pow(100.0, 0.4)).epsilon(0.02));
      CHECK(phase_before / phase == doctest::Approx(std::pow(100.0, 0.4)).epsilon(0.02));
    }
    before = error;
    phase_before = phase;
  }
  CHECK(before < 1e-4);        // [m/s] of 0.8046
  CHECK(phase_before < 2e-4);  // [rad]
}

TEST_CASE("table ball: from impact to impact it follows the exact map, also where it is chaotic") {
  const TableBall c{.amplitude = 3.12e-3, .frequency = 10.0, .restitution = 0.8};
  const Poincare map = section_points("table_ball", releases_of_ball(on_orbit(c, "1e12"), 30, 60));
  REQUIRE(map.complete);
  CHECK(map.period == 0);
  for (std::size_t i = 0; i + 1 < 60; ++i) {
    const TableBall::Impact next =
        c.next({.t = map.points.value(i, 0), .rebound = map.points.value(i, 1)});
    CHECK(std::abs(map.points.value(i + 1, 0) - next.t) < 5e-5);
    CHECK(std::abs(map.points.value(i + 1, 1) - next.rebound) < 1e-3);
  }
}

TEST_CASE(
    "table ball: one impact a period where the closed form has its orbit, two behind its flip") {
  TableBall c{.amplitude = 1.5e-3, .frequency = 10.0, .restitution = 0.8};
  CHECK(c.first_amplitude(1) == doctest::Approx(0.8673944e-3).epsilon(1e-6));
  CHECK(c.flip_amplitude(1) == doctest::Approx(2.6609237e-3).epsilon(1e-6));
  const Poincare one = section_points("table_ball", releases_of_ball(on_orbit(c, "1e12"), 40, 8));
  CHECK(one.period == 1);
  CHECK(one.points.value(7, 1) == doctest::Approx(c.orbit(1)->rebound).epsilon(3e-4));
  CHECK(std::abs(std::remainder(one.points.value(7, 0) - c.orbit(1)->t, 0.1)) < 2e-5);

  c.amplitude = 1.03 * c.flip_amplitude(1);
  const Poincare two = section_points("table_ball", releases_of_ball(on_orbit(c, "1e12"), 120, 8));
  CHECK(two.period == 2);
  c.amplitude = 0.97 * c.flip_amplitude(1);
  CHECK(section_points("table_ball", releases_of_ball(on_orbit(c, "1e12"), 120, 8)).period == 1);
  c.amplitude = 0.99 * c.first_amplitude(1);
  CHECK(!c.orbit(1));
}

TEST_CASE("table ball: the exact map doubles its period where its closed form says") {
  TableBall c{.amplitude = 0.0, .frequency = 10.0, .restitution = 0.8};
  for (const bool high : {false, true}) {
    const double flip = high ? c.high_flip_amplitude(1) : c.flip_amplitude(1);
    for (const double part : {0.999, 1.001}) {
      c.amplitude = part * flip;
      TableBall::Impact at = *c.orbit(1);
      at.rebound += 1e-7;
      double first = 0.0, last = 0.0;
      for (int i = 0; i < 400; ++i) {
        at = high ? c.next_high(at) : c.next(at);
        (i == 100 ? first : last) = std::abs(at.rebound - c.orbit(1)->rebound);
      }
      CHECK((last > first) == (part > 1.0));
    }
  }
}

}  // namespace
