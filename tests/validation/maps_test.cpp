// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Diagrams against analytic parameters: where a driven oscillator grazes its stop, where the period of a
// bouncing ball doubles, and what the doubled one is by the exact map.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <yoke/cases/impacts/forced_impacts.hpp>
#include <yoke/cases/maps/section_choice.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;

/// A diagram of a case over one of its numbers.
Bifurcation diagram_of(const char* name, const MapRequest& request, const std::string& parameter,
                       const std::vector<double>& values, Continuation continuation) {
  const Case& c = find_case(name);
  const ModelOfParameter model = [&](double value) {
    return sectioned_model(c, request, {fmt::format("{}={:.17g}", parameter, value)});
  };
  return bifurcation(
      model, values,
      {.map = map_options(c, request, model(values.front())), .continuation = continuation});
}

/// The same for a length.
Bifurcation diagram_over_amplitude(const MapRequest& request, const std::vector<double>& values) {
  const Case& c = find_case("table_ball");
  const ModelOfParameter model = [&](double value) {
    return sectioned_model(c, request, {fmt::format("amplitude={:.17g}m", value)});
  };
  return bifurcation(model, values, {.map = map_options(c, request, model(values.front()))});
}

TEST_CASE("impact oscillator: the diagram leaves the linear motion at the analytic grazing force") {
  const ImpactOscillator c{.mass = 1.0,
                           .spring = 1.0,
                           .damping = 0.2,
                           .force = 1.0,
                           .frequency = 0.3,
                           .gap = 0.1,
                           .restitution = 0.8};
  const double grazing = c.grazing_force();
  // Nearer by halves, so that no step to the next value overshoots the stop.
  std::vector<double> values;
  for (const double part : {-4e-5, -2e-5, -1e-5, 1e-5, 2e-5})
    values.push_back(grazing * (1.0 + part));
  const double size = values.front() * c.amplitude();
  const MapRequest request{
      .settings = {"stiffness=1e10",  // a soft stop lets it graze a little before it jumps
                   fmt::format("start={:.17g}m", size * std::cos(c.lag())),
                   fmt::format("start_speed={:.17g}", size * c.omega() * std::sin(c.lag()))},
      .at = "every:frequency",
      .columns = {"mass.x_m"},
      .discard = 100,
      .points = 4,
      .relative_tolerance = 1e-9};
  const Bifurcation map =
      diagram_of("impact_oscillator", request, "force", values, Continuation::forward);
  REQUIRE(map.points.rows() == 4 * values.size());
  for (std::size_t i = 0; i < map.points.rows(); ++i) {
    const double force = map.points.value(i, 0);
    const double linear = force * c.amplitude() * std::cos(c.lag());
    const bool leaves = std::abs(map.points.value(i, 4) - linear) > 0.1 * std::abs(linear);
    CHECK_MESSAGE(leaves == (force > grazing), force);
  }
}

TEST_CASE("impact oscillator: falling, it keeps its impacts below grazing") {
  const MapRequest request{.at = "every:frequency",
                           .columns = {"mass.x_m"},
                           .discard = 100,
                           .points = 4,
                           .relative_tolerance = 1e-8};
  const Bifurcation map = diagram_of("impact_oscillator", request, "force",
                                     {0.20, 0.21, 0.22, 0.24, 0.25, 0.27}, Continuation::both);
  const auto x = [&](double value, bool backward) {
    for (std::size_t i = 0; i < map.points.rows(); ++i)
      if (map.points.value(i, 0) == value && (map.points.value(i, 1) == 1.0) == backward)
        return map.points.value(i, 4);
    return 0.0;
  };
  CHECK(x(0.20, true) == doctest::Approx(x(0.20, false)).epsilon(1e-4));
  CHECK(x(0.27, true) == doctest::Approx(x(0.27, false)).epsilon(1e-4));
  CHECK(x(0.25, true) < 3.0 * x(0.25, false));  // both negative
}

TEST_CASE("table ball: the diagram doubles within half a percent of the analytic amplitude") {
  TableBall c{.amplitude = 0.0, .frequency = 10.0, .restitution = 0.8};
  const double flip = c.flip_amplitude(1);
  std::vector<double> values;
  for (const double part : {0.98, 0.99, 0.995, 1.005, 1.01, 1.02}) values.push_back(part * flip);
  const MapRequest request{.settings = {"stiffness=1e12"},
                           .at = "event:top.release",
                           .columns = {"ball.vy_m_per_s"},
                           .discard = 500,
                           .points = 12,
                           .duration = 80.0,
                           .relative_tolerance = 1e-8};
  const Bifurcation map = diagram_over_amplitude(request, values);
  REQUIRE(map.rows.size() == values.size());
  for (const BifurcationRow& row : map.rows) {
    CAPTURE(row.value);
    CHECK(row.period == (row.value < flip ? 1 : 2));
  }
  // What it is doubled to: the two speeds of the exact map.
  c.amplitude = values.back();
  TableBall::Impact at = *c.orbit(1);
  at.rebound *= 1.001;
  for (int i = 0; i < 2000; ++i) at = c.next(at);
  const double one = at.rebound, two = c.next(at).rebound;
  const std::size_t last = map.points.rows() - 1;
  const double low = std::min(map.points.value(last, 4), map.points.value(last - 1, 4)),
               high = std::max(map.points.value(last, 4), map.points.value(last - 1, 4));
  CHECK(low == doctest::Approx(std::min(one, two)).epsilon(2e-3));
  CHECK(high == doctest::Approx(std::max(one, two)).epsilon(2e-3));
  MESSAGE(fmt::format("two speeds {:.6g} and {:.6g} m/s, by the exact map {:.6g} and {:.6g}", low,
                      high, std::min(one, two), std::max(one, two)));
}

/// Of the exact map after many impacts, each amplitude beginning where the one before has ended.
std::vector<std::size_t> periods_of_exact_map(const std::vector<double>& amplitudes) {
  TableBall c{.amplitude = amplitudes.front(), .frequency = 10.0, .restitution = 0.8};
  TableBall::Impact at = *c.orbit(1);
  std::vector<std::size_t> periods;
  for (const double amplitude : amplitudes) {
    c.amplitude = amplitude;
    Table points;
    points.add_column("rebound", "");
    for (int i = 0; i < 1500; ++i) {
      at = c.next(at);
      at.t = std::fmod(at.t, 1.0 / c.frequency);
      if (i >= 1436) points.append()[0] = at.rebound;
    }
    periods.push_back(period_of(points, {3e-4}));
  }
  return periods;
}

TEST_CASE(
    "table ball: with the amplitude its period doubles as that of the exact map, into chaos") {
  const MapRequest request{.settings = {"stiffness=1e12"},
                           .at = "event:top.release",
                           .columns = {"ball.vy_m_per_s"},
                           .discard = 400,
                           .points = 64,
                           .duration = 100.0,
                           .relative_tolerance = 1e-8};
  const std::vector<double> values{2.4e-3,  2.6e-3,  2.8e-3, 2.9e-3,
                                   2.97e-3, 3.06e-3, 3.1e-3, 3.12e-3};
  const Bifurcation map = diagram_over_amplitude(request, values);
  REQUIRE(map.rows.size() == values.size());
  std::vector<std::size_t> periods;
  for (const BifurcationRow& row : map.rows) periods.push_back(row.period);
  CHECK(periods == periods_of_exact_map(values));
  CHECK(periods == std::vector<std::size_t>{1, 1, 2, 2, 2, 4, 8, 0});
}

}  // namespace
