// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A disc thrown along a floor without spin: it skids until friction has brought it to roll.
//
//      (o) -> v            N = m g, constant;  I = kappa m r^2, 1/2 for a uniform disc
//    ______|_____          s = v + w R slip, R = r - d: the point of contact is d within the disc
//                          m v' = -T(N, s),  I w' = -T R,  so  M s' = -T with 1/M = 1/m + R^2/I
//
//   v + (s_0 - s) M/m = v_0 at all times, so it rolls at v_0 - s_0 M/m: 2/3 v_0 of a thrown uniform disc
//   Coulomb: it skids for s_0 M/(mu m g), v_0/(3 mu g) of that disc
#include <cmath>

#include <yoke/cases/friction/friction_laws.hpp>
#include <yoke/cases/impacts/impact_laws.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/forces/gravity.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

struct RollingDisc {
  static constexpr double g = 9.81;         // [m/s^2]
  double mass, radius, kappa, speed, spin;  // [kg, m, 1, m/s, rad/s]

  explicit RollingDisc(const Parameters& p)
      : mass(p.number("mass")),
        radius(p.number("radius")),
        kappa(p.number("inertia")),
        speed(p.number("speed")),
        spin(p.number("spin")) {}

  double normal_force() const { return mass * g; }
  double inertia() const { return kappa * mass * radius * radius; }
  double depth(const ContactLaw& law) const { return law.elastic.penetration_at(normal_force()); }
  double slip(double arm) const { return speed + spin * arm; }
  /// M [kg]
  double slip_mass(double arm) const { return 1.0 / (1.0 / mass + arm * arm / inertia()); }
};

Model rolling_disc_model(const RollingDisc& c, const WallLaws& laws) {
  Model m;
  const ContactLaw& law = laws["floor"];
  const Vec2 centre(0.0, c.radius - c.depth(law));
  const BodyId disc = m.add(Body{.name = "disc",
                                 .mass = c.mass,
                                 .inertia = c.inertia(),
                                 .pose = {centre, 0.0},
                                 .twist = {{c.speed, 0.0}, c.spin}});
  m.add(Gravity{.acceleration = {0.0, -RollingDisc::g}});
  m.add(DiscOnCurve{.name = "floor",
                    .disc = {disc, centre, c.radius},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = law,
                    .reference_force = c.normal_force()});
  return m;
}

std::vector<Check> rolling_disc_checks(const Parameters& p, const WallLaws& laws,
                                       const Result& run) {
  const RollingDisc c(p);
  const ContactLaw& law = laws["floor"];
  const double arm = c.radius - c.depth(law), M = c.slip_mass(arm), slip = c.slip(arm);
  const Eigen::VectorXd v = run["disc.vx_m_per_s"], s = run["floor.tangential_velocity_m_per_s"];
  double off = 0.0;
  for (Eigen::Index i = 0; i < v.size(); ++i)
    off = std::max(off, std::abs(v[i] + (slip - s[i]) * M / c.mass - c.speed));
  const double size = std::abs(c.speed) + std::abs(slip);
  std::vector<Check> checks = {{.what = "velocity differs from what the slip says by up to",
                                .value = off,
                                .unit = "m/s",
                                .tolerance = tolerance_of(run, size),
                                .remark = "moment of momentum about the floor"}};
  // The slip as the velocity of a mass M on the floor.
  const std::vector<double> ends = {run["t_s"][0], run["t_s"][s.size() - 1]};
  const std::vector<LinePoint> points = move_on_line(
      law.friction,
      {.mass = M, .normal_force = c.normal_force(), .v = slip, .reference_force = c.normal_force()},
      ends);
  checks.push_back({.what = "slip at the end",
                    .value = s[s.size() - 1],
                    .expected = points.back().v,
                    .unit = "m/s",
                    .tolerance = tolerance_of(run, size),
                    .remark = "equation of one coordinate, another integrator"});
  checks.push_back(energy_check(run));
  return checks;
}

}  // namespace

Case rolling_disc_case() {
  std::vector<CaseParameter> parameters = {
      {.name = "radius",
       .quantity = Quantity::length,
       .default_text = "50mm",
       .low = 1.0_mm,
       .high = 10000.0_mm,
       .description = "of the disc"},
      mass_parameter("mass", "1", "of the disc, in kg"),
      {.name = "inertia",
       .quantity = Quantity::number,
       .default_text = "0.5",
       .low = 0.01,
       .high = 1.0,
       .description = "kappa of I = kappa m r^2; 0.5 is a uniform disc, 1 a hoop"},
      {.name = "speed",
       .quantity = Quantity::number,
       .default_text = "1",
       .low = -20.0,
       .high = 20.0,
       .description = "at the start, in m/s"},
      {.name = "spin",
       .quantity = Quantity::number,
       .default_text = "0",
       .low = -1000.0,
       .high = 1000.0,
       .description = "at the start, in rad/s, > 0 counter-clockwise: backwards"},
      {.name = "duration",
       .quantity = Quantity::time,
       .default_text = "0.3s",
       .low = 1e-3,
       .high = 1000.0,
       .description = "of the run"}};
  for (CaseParameter& p : friction_parameters("0.2", "0.25")) parameters.push_back(std::move(p));
  return {
      .name = "rolling_disc",
      .group = "friction",
      .description = "a disc that skids along a floor until it rolls",
      .parameters = std::move(parameters),
      .contact = friction_laws(
          [](const Parameters& p) { return std::vector{flat_wall("floor", p.number("radius"))}; },
          [](const Parameters& p) {
            const RollingDisc c(p);
            return Pressed{c.mass, c.normal_force()};
          }),
      .default_output = "results/rolling_disc",
      .model = [](const Parameters& p,
                  const WallLaws& laws) { return rolling_disc_model(RollingDisc(p), laws); },
      .duration = [](const Parameters& p) { return p.number("duration"); },
      .checks_hold_with_friction = true,
      .law_checks = rolling_disc_checks};
}

}  // namespace yoke::cases
