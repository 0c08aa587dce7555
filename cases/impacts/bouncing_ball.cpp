// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A disc falls on a floor, bounces lower every time and comes to rest.
//
//      (o)  ---          m, radius r
//            | height    g = 9.81 m/s^2 down
//     _______|___        contact law F(d, d') with restitution e
//
// The rigid limit, v_0 = sqrt(2 g height):
//   flights         t_k = 2 v_k / g,   v_k = e v_(k-1)
//   all of them     2 e v_0 / (g (1 - e)): infinitely many in a finite time
// With a law of finite stiffness there is a last flight, when m g / K is no longer small beside the
// penetration. From then on the disc oscillates on the floor until
//   at rest         F_e(d) = m g,   d = (m g / K)^(1/n)
//
// Gravity acts during an impact of duration T too, so the speed after it is e v within g T.
#include <algorithm>
#include <cmath>

#include <yoke/cases/impacts/impact_laws.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/forces/gravity.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

constexpr double g = 9.81;  // [m/s^2]

struct BouncingBall {
  double radius, height;  // [m]
  double mass;            // [kg]
  double restitution;

  explicit BouncingBall(const Parameters& p)
      : radius(p.number("radius")),
        height(p.number("height")),
        mass(p.number("mass")),
        restitution(p.number("restitution")) {}

  double speed() const { return std::sqrt(2.0 * g * height); }  // v_0
  double fall() const { return speed() / g; }
  /// [s] The rigid limit: the fall, all flights and a tenth more; ten flights without loss.
  double until_rest() const {
    if (restitution == 1.0) return 20.0 * fall();
    return 1.1 * fall() * (1.0 + restitution) / (1.0 - restitution);
  }
};

Model bouncing_ball_model(const BouncingBall& c, const WallLaws& laws) {
  Model m;
  const Vec2 start(0.0, c.radius + c.height);
  const BodyId ball = m.add(Body{.name = "ball",
                                 .mass = c.mass,
                                 .inertia = 0.5 * c.mass * c.radius * c.radius,
                                 .pose = {start, 0.0}});
  m.add(Gravity{.acceleration = {0.0, -g}});
  m.add(DiscOnCurve{.name = "floor",
                    .disc = {ball, start, c.radius},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = laws["floor"],
                    .reference_force = 100.0 * c.mass * g});
  return m;
}

/// Flights between impacts, by what they should last.
std::vector<Check> flight_checks(const BouncingBall& c, const std::vector<Impact>& impacts,
                                 const Result& run) {
  if (impacts.empty()) return {};
  double worst = 0.0, longest = 0.0, flights = 0.0, contacts = 0.0;
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    const Impact& now = impacts[i];
    contacts += now.end - now.start;
    if (i + 1 == impacts.size()) break;
    // A dent is left above its bottom and met at the floor: the free fall between the two.
    const double v = now.rebound, low = std::max(0.0, now.left_at);
    const double expected = (v + std::sqrt(std::max(0.0, v * v - 2.0 * g * low))) / g;
    const double flight = impacts[i + 1].start - now.end;
    worst = std::max(worst, std::abs(flight - expected));
    longest = std::max(longest, expected);
    flights += flight;
  }
  const Impact& first = impacts.front();
  std::vector<Check> checks = {
      {.what = "speed of the first impact",
       .value = first.approach,
       .expected = c.speed(),
       .unit = "m/s",
       .tolerance = tolerance_of(run, c.speed()),
       .remark = "closed form"},
      {.what = "flights differ from 2 v/g by up to",
       .value = worst,
       .unit = "s",
       .tolerance = tolerance_of(run, longest),
       .remark = fmt::format("closed form, {} flights", impacts.size() - 1)}};
  const double e = first.rebound / first.approach;
  if (impacts.size() < 4 || impacts.back().rebound > 0.05 * c.speed()) return checks;
  // v_k = e v_(k-1) within g T_k; what is not yet flown of the series ends with the last flight.
  checks.push_back({.what = "all flights together",
                    .value = flights,
                    .expected = 2.0 * e * c.speed() / (g * (1.0 - e)),
                    .unit = "s",
                    .tolerance = 2.0 / (1.0 - e) * (contacts + impacts.back().approach / g),
                    .remark = fmt::format("closed form with the first impact's e = {:.6g}", e)});
  return checks;
}

/// The penetration at rest, if the run got there: within twice the oscillation that is left.
std::vector<Check> rest_check(const BouncingBall& c, const ContactLaw& law, const Result& run) {
  if (law.dissipation.needs_largest_penetration()) return {};  // rests in a dent
  const Eigen::VectorXd d = run["floor.penetration_m"];
  const Eigen::Index last = d.size() - 1;
  const double rest = law.elastic.penetration_at(c.mass * g);
  const double rate2 = law.elastic.response(rest).stiffness / c.mass;  // [1/s^2]
  const double left = std::hypot(run["ball.vy_m_per_s"][last] / std::sqrt(rate2),
                                 run["ball.ay_m_per_s2"][last] / rate2);
  if (!(left < 0.1 * rest)) return {};
  return {{.what = "penetration at rest",
           .value = 1e6 * d[last],
           .expected = 1e6 * rest,
           .unit = "um",
           .tolerance = 1e6 * (2.0 * left + tolerance_of(run, rest)),
           .remark = "F_e(d) = m g"}};
}

std::vector<Check> bouncing_ball_checks(const Parameters& p, const WallLaws& laws,
                                        const Result& run) {
  const BouncingBall c(p);
  std::vector<Check> checks = flight_checks(c, impacts_of(run, "floor"), run);
  for (const Check& check : rest_check(c, laws["floor"], run)) checks.push_back(check);
  checks.push_back(energy_check(run));
  return checks;
}

std::vector<CaseParameter> bouncing_ball_parameters() {
  std::vector<CaseParameter> all = {{.name = "radius",
                                     .quantity = Quantity::length,
                                     .default_text = "20mm",
                                     .low = 0.1_mm,
                                     .high = 1000.0_mm,
                                     .description = "of the disc"},
                                    mass_parameter("mass", "0.1", "of the disc, in kg"),
                                    {.name = "height",
                                     .quantity = Quantity::length,
                                     .default_text = "200mm",
                                     .low = 0.1_mm,
                                     .high = 10000.0_mm,
                                     .description = "of the disc's lowest point at the start"},
                                    {.name = "duration",
                                     .quantity = Quantity::time,
                                     .default_text = "to_rest",
                                     .low = 1e-3,
                                     .high = 1000.0,
                                     .words = {"to_rest"},
                                     .description = "of the run; to_rest: a tenth longer than the "
                                                    "bouncing, by the parameter restitution"}};
  for (CaseParameter& p : impact_parameters("1e8", "0.7")) all.push_back(std::move(p));
  return all;
}

}  // namespace

Case bouncing_ball_case() {
  return {.name = "bouncing_ball",
          .group = "impacts",
          .description = "a disc bounces on a floor until it lies still",
          .parameters = bouncing_ball_parameters(),
          .contact = impact_laws([](const Parameters& p) {
            return std::vector{flat_wall("floor", p.number("radius"))};
          }),
          .default_output = "results/bouncing_ball",
          .model = [](const Parameters& p,
                      const WallLaws& laws) { return bouncing_ball_model(BouncingBall(p), laws); },
          .duration =
              [](const Parameters& p) {
                return p.is_word("duration") ? BouncingBall(p).until_rest() : p.number("duration");
              },
          .law_checks = bouncing_ball_checks};
}

}  // namespace yoke::cases
