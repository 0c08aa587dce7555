// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A ball bounces on a table that vibrates.
//
//      (o)            m, g = 9.81 m/s^2 down
//     _____           table  y = a sin(w t), moved by a driver
//      | |            contact law, restitution e
//
// The rigid limit, an impact at t with the ball leaving at v (absolute), is a map of the plane:
//   v t' flight:  a sin(w t) + v T - g T^2/2 = a sin(w (t + T)),   t' = t + T
//   v' = -e (v - g T) + (1 + e) a w cos(w t')
// For bounces high beside the amplitude it is a relative of Henon's: t' = t + 2 v/g, v' = e v + (1 + e) a w cos(w t').
// Both have an orbit with one impact in n periods, v = n pi g/w, cos(w t) = n pi g (1 - e)/((1 + e) a w^2), from
// the amplitude on at which that cosine is 1; it loses its stability by period doubling (TableBall).
#include <algorithm>
#include <cmath>

#include <yoke/cases/impacts/forced_impacts.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/prismatic.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

constexpr double g = 9.81;              // [m/s^2]
constexpr double ball_radius = 5.0_mm;  // of the ball
constexpr double table_mass = 1.0;      // [kg] whatever it is: the driver moves it

TableBall table_ball_of(const Parameters& p) {
  return {.amplitude = p.number("amplitude"),
          .frequency = p.number("frequency"),
          .restitution = p.number("restitution")};
}

Model table_ball_model(const Parameters& p, const WallLaws& laws) {
  const TableBall c = table_ball_of(p);
  const double mass = p.number("mass");
  Model m;
  const Vec2 start(0.0, ball_radius + p.number("height"));
  const BodyId table = m.add(Body{.name = "table", .mass = table_mass, .inertia = 1e-3});
  const BodyId ball = m.add(Body{.name = "ball",
                                 .mass = mass,
                                 .inertia = 0.4 * mass * ball_radius * ball_radius,
                                 .pose = {start, 0.0},
                                 .twist = {{0.0, p.number("speed")}, 0.0}});
  m.add(Gravity{.acceleration = {0.0, -g}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = table, .along = {0.0, 1.0}});
  m.add(DisplacementDriver{.name = "shaker",
                           .body = table,
                           .along = {0.0, 1.0},
                           .displacement = time_function([a = c.amplitude, w = c.omega()](auto t) {
                             return a * sin(w * t);
                           })});
  m.add(DiscOnCurve{.name = "top",
                    .disc = {ball, start, ball_radius},
                    .body = table,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = laws["top"],
                    .reference_force = 100.0 * mass * g});
  return m;
}

/// Every flight against the exact end of a parabola above a sine.
std::vector<Check> table_ball_checks(const Parameters& p, const Model&, const Result& run) {
  TableBall c = table_ball_of(p);
  const std::vector<Impact> impacts = impacts_of(run, "top");
  double worst = 0.0, longest = 0.0;
  std::size_t flights = 0;
  for (std::size_t i = 1; i < impacts.size(); ++i) {
    const Impact& before = impacts[i - 1];
    if (before.left_at != 0.0 && std::abs(before.left_at) > 1e-9) continue;
    const double v = before.rebound + c.table_speed(before.end);
    // A flight of a few steps of the search is no test of it.
    if (!(impacts[i].start - before.end > 0.02 / c.frequency)) continue;
    const double t = c.next({.t = before.end, .rebound = v}).t;
    worst = std::max(worst, std::abs(t - impacts[i].start));
    longest = std::max(longest, t - before.end);
    ++flights;
  }
  std::vector<Check> checks;
  if (flights > 0)
    checks.push_back({.what = "flights end off by",
                      .value = worst,
                      .unit = "s",
                      .tolerance = tolerance_of(run, longest),
                      .remark = fmt::format("closed form, {} flights", flights)});
  checks.push_back(energy_check(run));
  return checks;
}

std::vector<CaseParameter> table_ball_parameters() {
  std::vector<CaseParameter> all = {{.name = "amplitude",
                                     .quantity = Quantity::length,
                                     .default_text = "1.5mm",
                                     .low = 0.0,
                                     .high = 1000.0_mm,
                                     .description = "a of the table's motion"},
                                    {.name = "frequency",
                                     .default_text = "10",
                                     .low = 0.01,
                                     .high = 1e4,
                                     .description = "of the table, in Hz"},
                                    mass_parameter("mass", "0.01", "of the ball, in kg"),
                                    {.name = "height",
                                     .quantity = Quantity::length,
                                     .default_text = "7.5mm",
                                     .low = 0.0,
                                     .high = 10000.0_mm,
                                     .description = "of the ball above the table at the start"},
                                    {.name = "speed",
                                     .default_text = "-0.34",
                                     .low = -100.0,
                                     .high = 100.0,
                                     .description = "of the ball at the start, upwards, in m/s"},
                                    {.name = "periods",
                                     .default_text = "20",
                                     .low = 0.1,
                                     .high = 100000.0,
                                     .description = "of the table, that the run lasts"}};
  for (CaseParameter& p : impact_parameters("1e8", "0.8")) all.push_back(std::move(p));
  return all;
}

}  // namespace

Case table_ball_case() {
  return {
      .name = "table_ball",
      .group = "impacts",
      .description = "a ball bounces on a vibrating table: locked, doubled, chaotic",
      .parameters = table_ball_parameters(),
      .contact =
          impact_laws([](const Parameters&) { return std::vector{flat_wall("top", ball_radius)}; }),
      .default_output = "results/table_ball",
      .model = table_ball_model,
      .duration = [](const Parameters& p) { return p.number("periods") / p.number("frequency"); },
      .checks = table_ball_checks};
}

}  // namespace yoke::cases
