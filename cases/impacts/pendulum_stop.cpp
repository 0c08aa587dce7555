// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A pendulum beats against a stop (Kobrinskii, Dynamics of Mechanisms with Elastic Connections and
// Impact Systems, 1969).
//
//          o          pivot, origin            theta  from the vertical, > 0 to the right
//         /|\         L   to the centre of the bob
//      ||/ | \        the stop is a flat wall along the pendulum at theta = stop:
//      (o) |  \       d = -L sin(theta - stop)   penetration
//      ||     (o)
//     stop   start
//
// w^2 = m g L / (I + m L^2). Between impacts theta'^2 = 4 w^2 (k^2 - sin^2(theta/2)), so with
// sin(psi) = sin(theta/2)/k and the elliptic integral F(k, psi), K = F(k, pi/2):
//   first impact   (K - F(k, psi_stop)) / w              k = sin(start/2)
//   flights        2 (K - F(k, psi_stop)) / w            k^2 = sin^2(stop/2) + (theta'/(2 w))^2
// with theta' behind the impact. Without loss that is the period of the motion.
#include <algorithm>
#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>

#include <yoke/cases/impacts/impact_laws.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

struct PendulumStop {
  static constexpr double gravity = 9.81;  // [m/s^2]
  double length, radius;                   // [m]
  double mass;                             // [kg]
  double start, stop;                      // [rad]

  explicit PendulumStop(const Parameters& p)
      : length(p.number("length")),
        radius(p.number("radius")),
        mass(p.number("mass")),
        start(p.number("start")),
        stop(p.number("stop")) {
    const auto deg = [](double angle) { return angle * 180.0 / pi; };
    if (!(start > stop && start < stop + 170.0_deg))
      throw ModelError(fmt::format(
          "pendulum_stop: start = {:g} deg must be greater than stop = {:g} deg and less than "
          "{:g} deg: the stop is a whole line",
          deg(start), deg(stop), deg(stop) + 170.0));
    if (!(radius < length))
      throw ModelError(
          fmt::format("pendulum_stop: radius = {:g} mm must be less than length = {:g} mm",
                      1e3 * radius, 1e3 * length));
    // The pendulum that starts above the pivot's level swings as far to the other side.
    if (!(stop > -start))
      throw ModelError(
          fmt::format("pendulum_stop: stop = {:g} deg must be above {:g} deg, where the pendulum "
                      "turns by itself",
                      deg(stop), -deg(start)));
  }

  double inertia() const { return 0.5 * mass * radius * radius; }
  double rate() const {  // w
    return std::sqrt(mass * gravity * length / (inertia() + mass * length * length));
  }
  /// [s] from `angle` to the turning point of a swing of modulus k.
  double quarter(double k, double angle) const {
    const double sine = std::clamp(std::sin(0.5 * angle) / k, -1.0, 1.0);
    return (boost::math::ellint_1(k) - boost::math::ellint_1(k, std::asin(sine))) / rate();
  }
  /// [s] from the release of one impact to the next onset.
  double flight(const Impact& impact) const {
    const double angle = stop - std::asin(impact.left_at / length);
    const double omega = impact.rebound / (length * std::cos(angle - stop));
    const double k = std::hypot(std::sin(0.5 * angle), omega / (2.0 * rate()));
    return quarter(k, angle) + quarter(k, stop);
  }
};

Model pendulum_stop_model(const PendulumStop& c, const WallLaws& laws) {
  Model m;
  const auto hanging = [&](double angle) {
    return Vec2(c.length * std::sin(angle), -c.length * std::cos(angle));
  };
  const BodyId bob = m.add(Body{.name = "pendulum",
                                .mass = c.mass,
                                .inertia = c.inertia(),
                                .pose = {hanging(c.start), c.start}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = bob, .at = {0.0, 0.0}});
  m.add(Gravity{.acceleration = {0.0, -PendulumStop::gravity}});
  const Vec2 along(std::sin(c.stop), -std::cos(c.stop));
  m.add(DiscOnCurve{.name = "stop",
                    .disc = {bob, hanging(c.start), c.radius},
                    .body = ground,
                    .curve = straight_line(hanging(c.stop) - c.radius * perp(along), along),
                    .law = laws["stop"],
                    .reference_force = 100.0 * c.mass * PendulumStop::gravity});
  return m;
}

std::vector<Check> pendulum_stop_checks(const Parameters& p, const Model&, const Result& run) {
  const PendulumStop c(p);
  const std::vector<Impact> impacts = impacts_of(run, "stop");
  std::vector<Check> checks;
  if (!impacts.empty()) {
    const double first = c.quarter(std::sin(0.5 * c.start), c.stop);
    checks.push_back({.what = "time of the first impact",
                      .value = impacts.front().start,
                      .expected = first,
                      .unit = "s",
                      .tolerance = tolerance_of(run, first),
                      .remark = "elliptic integral"});
  }
  double worst = 0.0, longest = 0.0;
  for (std::size_t i = 1; i < impacts.size(); ++i) {
    const double expected = c.flight(impacts[i - 1]);
    worst = std::max(worst, std::abs(impacts[i].start - impacts[i - 1].end - expected));
    longest = std::max(longest, expected);
  }
  if (longest > 0.0)
    checks.push_back({.what = "flights differ from the elliptic integral by up to",
                      .value = worst,
                      .unit = "s",
                      .tolerance = tolerance_of(run, longest),
                      .remark = fmt::format("{} flights", impacts.size() - 1)});
  checks.push_back(energy_check(run));
  return checks;
}

std::vector<CaseParameter> pendulum_stop_parameters() {
  std::vector<CaseParameter> all = {
      {.name = "length",
       .quantity = Quantity::length,
       .default_text = "250mm",
       .low = 1.0_mm,
       .high = 100000.0_mm,
       .description = "pivot to the centre of the bob"},
      {.name = "radius",
       .quantity = Quantity::length,
       .default_text = "20mm",
       .low = 0.1_mm,
       .high = 10000.0_mm,
       .description = "of the bob, a disc"},
      mass_parameter("mass", "0.5", "of the bob, in kg; the rod has none"),
      {.name = "start",
       .quantity = Quantity::angle,
       .default_text = "60deg",
       .low = -89.0_deg,
       .high = 179.0_deg,
       .description = "from the vertical, at rest"},
      {.name = "stop",
       .quantity = Quantity::angle,
       .default_text = "-10deg",
       .low = -170.0_deg,
       .high = 89.0_deg,
       .description = "where the bob touches the stop"},
      {.name = "duration",
       .quantity = Quantity::time,
       .default_text = "5s",
       .low = 1e-3,
       .high = 1000.0,
       .description = "of the run"}};
  for (CaseParameter& p : impact_parameters("1e8", "0.75")) all.push_back(std::move(p));
  return all;
}

}  // namespace

Case pendulum_stop_case() {
  return {.name = "pendulum_stop",
          .group = "impacts",
          .description = "a pendulum beats against a stop",
          .parameters = pendulum_stop_parameters(),
          .contact = impact_laws([](const Parameters& p) {
            return std::vector{flat_wall("stop", p.number("radius"))};
          }),
          .default_output = "results/pendulum_stop",
          .model = [](const Parameters& p,
                      const WallLaws& laws) { return pendulum_stop_model(PendulumStop(p), laws); },
          .duration = [](const Parameters& p) { return p.number("duration"); },
          .checks = pendulum_stop_checks};
}

}  // namespace yoke::cases
