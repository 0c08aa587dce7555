// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A slender steel bar with round ends is dropped at an angle on a hard floor (the experiment of
// Stoianovici and Hurmuzlu, J. Appl. Mech. 63, 1996, with a bar that does not bend).
//
//              .-(o)     m, uniform: I = m (2 a)^2/12 about the middle
//          .-'           a  from the middle to the centre of each end, radius r
//      .-'  alpha        alpha  from the horizontal
//    (o) _ _ _ _ _       no friction: the middle moves up and down only
//    ~~~~~~~~~~~~~~~
//
// The lower end meets the floor with v = sqrt(2 g height). Rigid, with restitution e:
//   effective mass     m / (1 + 3 cos^2(alpha)),   as a^2 m / I = 3
//   the end            v -> e v upwards
//   the middle         v -> v (1 + e)/(1 + 3 cos^2(alpha)) - v  upwards, negative for a flat bar
//   the bar turns by    3 cos(alpha) (1 + e) v / (a (1 + 3 cos^2(alpha))), the lower end upwards
// The flatter the bar, the sooner the other end follows: at 0 both meet the floor at once, and the
// bar comes back with e v.
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

struct SlenderBar {
  double length, radius, height;  // [m] length = 2 a
  double angle;                   // [rad]
  double density = 7850.0;        // [kg/m^3] steel
  static constexpr double gravity = 9.81;

  explicit SlenderBar(const Parameters& p)
      : length(p.number("length")),
        radius(p.number("radius")),
        height(p.number("height")),
        angle(p.number("angle")) {
    if (!(length >= 4.0 * radius))
      throw ModelError(
          fmt::format("slender_bar: length = {:g} mm must be at least {:g} mm, four "
                      "times the radius: the bar is slender",
                      1e3 * length, 4e3 * radius));
  }

  double mass() const { return density * pi * radius * radius * length; }
  double inertia() const { return mass() * length * length / 12.0; }
  double speed() const { return std::sqrt(2.0 * gravity * height); }
  double share() const {  // m_effective / m
    const double c = std::cos(angle);
    return 1.0 / (1.0 + 3.0 * c * c);
  }
};

Model slender_bar_model(const SlenderBar& c, const WallLaws& laws) {
  const Vec2 half = rotate(c.angle, {0.5 * c.length, 0.0});
  const Vec2 middle(0.0, half.y() + c.radius + c.height);
  Model m;
  const BodyId bar = m.add(
      Body{.name = "bar", .mass = c.mass(), .inertia = c.inertia(), .pose = {middle, c.angle}});
  m.add(Gravity{.acceleration = {0.0, -SlenderBar::gravity}});
  for (const double side : {-1.0, 1.0})
    m.add(DiscOnCurve{.name = side < 0.0 ? "lower end" : "upper end",
                      .disc = {bar, middle + side * half, c.radius},
                      .body = ground,
                      .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                      .law = laws["floor"],
                      .reference_force = 100.0 * c.mass() * SlenderBar::gravity});
  return m;
}

/// Velocity of the middle and angular velocity at the end of the first impact, from the first row
/// of the flight behind it.
struct BarFlight {
  bool found = false;
  double velocity = 0.0, omega = 0.0;
};
BarFlight bar_flight(const Result& run, double from) {
  double until = run.summary.t_end;
  for (const EventRecord& e : run.events)
    if (e.kind == "onset" && e.t > from) until = std::min(until, e.t);
  const Eigen::VectorXd t = run["t_s"];
  for (Eigen::Index i = 0; i < t.size(); ++i)
    if (t[i] >= from && t[i] < until)
      return {true, run["bar.vy_m_per_s"][i] + SlenderBar::gravity * (t[i] - from),
              run["bar.omega_rad_per_s"][i]};
  return {};
}

/// The first impact, beside that of a rigid bar with the restitution that was found. During its
/// duration T gravity acts, and the bar turns by up to omega T.
std::vector<Check> first_impact_checks(const SlenderBar& c, const Result& run) {
  const std::vector<Impact> lower = impacts_of(run, "lower end"),
                            upper = impacts_of(run, "upper end");
  if (lower.empty()) return {};
  const Impact& first = lower.front();
  const double v = c.speed();
  std::vector<Check> checks = {{.what = "speed of the first impact",
                                .value = first.approach,
                                .expected = v,
                                .unit = "m/s",
                                .tolerance = tolerance_of(run, v),
                                .remark = "closed form"}};
  const BarFlight after = bar_flight(run, first.end);
  if (!after.found) return checks;
  const double e = first.rebound / first.approach, T = first.end - first.start;
  const bool both = !upper.empty() && upper.front().start < first.end;
  if (both && c.angle != 0.0) return checks;  // no closed form for two contacts that overlap
  const double apparent = both ? e : (1.0 + e) * c.share() - 1.0;
  const double omega = both ? 0.0 : -6.0 * std::cos(c.angle) * (1.0 + e) * c.share() * v / c.length;
  const double shift = (SlenderBar::gravity + 3.0 * std::abs(omega) * v) * T;
  checks.push_back({.what = "apparent restitution, of the middle",
                    .value = after.velocity / v,
                    .expected = apparent,
                    .tolerance = shift / v + tolerance_of(run, 1.0),
                    .remark = fmt::format("rigid bar, e = {:.5g} of the end", e)});
  checks.push_back({.what = "angular velocity behind it",
                    .value = after.omega,
                    .expected = omega,
                    .unit = "rad/s",
                    .tolerance = 6.0 * shift / c.length + tolerance_of(run, v / c.length),
                    .remark = "rigid bar"});
  return checks;
}

std::vector<Check> slender_bar_checks(const Parameters& p, const Model&, const Result& run) {
  std::vector<Check> checks = first_impact_checks(SlenderBar(p), run);
  checks.push_back(energy_check(run));
  return checks;
}

std::vector<CaseParameter> slender_bar_parameters() {
  std::vector<CaseParameter> all = {
      {.name = "length",
       .quantity = Quantity::length,
       .default_text = "200mm",
       .low = 1.0_mm,
       .high = 10000.0_mm,
       .description = "2 a, between the centres of the round ends"},
      {.name = "radius",
       .quantity = Quantity::length,
       .default_text = "6.5mm",
       .low = 0.1_mm,
       .high = 500.0_mm,
       .description = "of the bar and its ends, at most a quarter of the length"},
      {.name = "angle",
       .quantity = Quantity::angle,
       .default_text = "30deg",
       .low = 0.0,
       .high = 90.0_deg,
       .description = "of the bar from the horizontal"},
      {.name = "height",
       .quantity = Quantity::length,
       .default_text = "50mm",
       .low = 0.1_mm,
       .high = 10000.0_mm,
       .description = "of the lower end above the floor"},
      {.name = "duration",
       .quantity = Quantity::time,
       .default_text = "0.6s",
       .low = 1e-3,
       .high = 100.0,
       .description = "of the run"}};
  for (CaseParameter& p : impact_parameters("1e9", "0.8")) all.push_back(std::move(p));
  return all;
}

}  // namespace

Case slender_bar_case() {
  return {.name = "slender_bar",
          .group = "impacts",
          .description = "a slender steel bar dropped at an angle on a hard floor",
          .parameters = slender_bar_parameters(),
          .contact = impact_laws([](const Parameters& p) {
            return std::vector{flat_wall("floor", p.number("radius"))};
          }),
          .default_output = "results/slender_bar",
          .model = [](const Parameters& p,
                      const WallLaws& laws) { return slender_bar_model(SlenderBar(p), laws); },
          .duration = [](const Parameters& p) { return p.number("duration"); },
          .checks = slender_bar_checks};
}

}  // namespace yoke::cases
