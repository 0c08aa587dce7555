// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A uniform rod that leans on a wall and stands on a floor, both rough: it holds, or slides down.
//
//   wall |            m: the part of the limit N mu that friction needs at both ends
//        |\           N1 = W/(1 + m^2) at the floor, N2 = m N1 at the wall,  m = sec(a) - tan(a)
//        | \ L        Coulomb: it holds for m <= mu_static, that is a >= 90 deg - 2 atan(mu_static)
//        |__\a__
//          floor      below, a rigid rod slides at both ends with mu (sliding_rod())
//
// The rod starts at rest, with its ends as deep in floor and wall as these forces press them.
#include <array>
#include <boost/numeric/odeint/integrate/integrate.hpp>
#include <cmath>

#include <yoke/cases/friction/friction_laws.hpp>
#include <yoke/cases/impacts/impact_laws.hpp>
#include <yoke/cases/uniform_bar.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/forces/gravity.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

struct LeaningRod {
  static constexpr double g = 9.81;           // [m/s^2]
  double length, mass, angle, mu, mu_static;  // [m, kg, rad, 1, 1]

  explicit LeaningRod(const Parameters& p)
      : length(p.number("length")),
        mass(p.number("mass")),
        angle(p.number("angle")),
        mu(p.number("mu")),
        mu_static(p.number("mu_static")) {}

  double weight() const { return mass * g; }
  double needed() const { return 1.0 / std::cos(angle) - std::tan(angle); }  // m
  bool holds() const { return needed() <= mu_static; }
};

struct RodForces {
  double floor, wall;   // [N] normal forces
  double acceleration;  // [rad/s^2] of the angle
};

/// A rigid rod that slides down at both ends. Centre (cos a, sin a) L/2; N1 and N2 from its two
/// accelerations, which are linear in that of the angle, and that from the moments about the centre.
RodForces sliding_rod(const LeaningRod& r, double mu, double angle, double rate) {
  const double h = 0.5 * r.length, c = std::cos(angle), s = std::sin(angle);
  const auto forces = [&](double a) {
    const double x = h * (-s * a - c * rate * rate), y = h * (c * a - s * rate * rate);
    const double floor = (r.mass * (y - mu * x) + r.weight()) / (1.0 + mu * mu);
    return RodForces{floor, r.mass * x + mu * floor, a};
  };
  const auto excess = [&](double a) {  // of moment; the rod turns by -a
    const RodForces f = forces(a);
    return h * (f.floor * (c - mu * s) - f.wall * (s + mu * c)) +
           r.mass * r.length * r.length / 12.0 * a;
  };
  const double zero = excess(0.0), slope = excess(1.0) - zero;
  return forces(-zero / slope);
}

RodForces start_forces(const LeaningRod& r) {
  if (!r.holds()) return sliding_rod(r, r.mu, r.angle, 0.0);
  const double m = r.needed(), floor = r.weight() / (1.0 + m * m);
  return {floor, m * floor, 0.0};
}

Model leaning_rod_model(const LeaningRod& r, const WallLaws& laws) {
  Model m;
  const RodForces f = start_forces(r);
  const Vec2 along = r.length * Vec2(-std::cos(r.angle), std::sin(r.angle));
  const Vec2 foot(-along.x() - laws["wall"].elastic.penetration_at(f.wall),
                  -laws["floor"].elastic.penetration_at(f.floor));
  const Vec2 head = foot + along;
  const BodyId rod = m.add(uniform_bar({.name = "rod", .mass = r.mass, .from = foot, .to = head}));
  m.add(Gravity{.acceleration = {0.0, -LeaningRod::g}});
  m.add(DiscOnCurve{.name = "floor",
                    .disc = {rod, foot, 0.0},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = laws["floor"],
                    .reference_force = r.weight()});
  m.add(DiscOnCurve{.name = "wall",
                    .disc = {rod, head, 0.0},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {0.0, -1.0}),
                    .law = laws["wall"],
                    .reference_force = r.weight()});
  return m;
}

/// [rad] The largest distance of the rod's angle from that of the rigid rod, until that one would leave the
/// wall or lie flat.
double off_from_rigid(const LeaningRod& r, const Result& run) {
  const Eigen::VectorXd t = run["t_s"], angle = run["rod.angle_rad"];
  std::array<double, 2> y{r.angle, 0.0};
  const auto rate = [&](const std::array<double, 2>& at, std::array<double, 2>& slope, double) {
    slope = {at[1], sliding_rod(r, r.mu, at[0], at[1]).acceleration};
  };
  double off = 0.0;
  for (Eigen::Index i = 0; i + 1 < t.size(); ++i) {
    if (y[0] < 0.05 || sliding_rod(r, r.mu, y[0], y[1]).wall < 0.1 * r.weight()) break;
    off = std::max(off, std::abs(pi - angle[i] - y[0]));
    boost::numeric::odeint::integrate(rate, y, t[i], t[i + 1], 1e-3 * (t[i + 1] - t[i]));
  }
  return off;
}

std::vector<Check> leaning_rod_checks(const Parameters& p, const WallLaws& laws,
                                      const Result& run) {
  const LeaningRod r(p);
  std::vector<Check> checks;
  const RodForces f = start_forces(r);
  const double depth =
      laws["floor"].elastic.penetration_at(f.floor) + laws["wall"].elastic.penetration_at(f.wall);
  if (laws["floor"].friction.holds() && laws["wall"].friction.holds()) {
    if (r.holds()) {
      const Eigen::VectorXd angle = run["rod.angle_rad"];
      checks.push_back({.what = "it turns by up to",
                        .value = (angle.array() - angle[0]).abs().maxCoeff(),
                        .unit = "rad",
                        .tolerance = tolerance_of(run, std::sqrt(depth / r.length)),
                        .remark = "it holds"});
    } else {
      checks.push_back({.what = "angle differs from a rigid rod's by up to",
                        .value = off_from_rigid(r, run),
                        .unit = "rad",
                        .tolerance = 50.0 * depth / r.length + tolerance_of(run, 1.0),
                        .remark = "sliding at both ends"});
    }
  }
  checks.push_back(energy_check(run, r.weight() * depth));
  return checks;
}

}  // namespace

Case leaning_rod_case() {
  std::vector<CaseParameter> parameters = {{.name = "angle",
                                            .quantity = Quantity::angle,
                                            .default_text = "55deg",
                                            .low = 10.0_deg,
                                            .high = 89.0_deg,
                                            .description = "between rod and floor"},
                                           {.name = "length",
                                            .quantity = Quantity::length,
                                            .default_text = "1m",
                                            .low = 1.0_mm,
                                            .high = 100.0,
                                            .description = "of the rod"},
                                           mass_parameter("mass", "1", "of the rod, in kg"),
                                           {.name = "duration",
                                            .quantity = Quantity::time,
                                            .default_text = "0.5s",
                                            .low = 1e-3,
                                            .high = 1000.0,
                                            .description = "of the run"}};
  for (CaseParameter& p : friction_parameters("0.3", "0.3")) parameters.push_back(std::move(p));
  return {.name = "leaning_rod",
          .group = "friction",
          .description = "a rod that leans on a rough wall: it holds or slides down",
          .parameters = std::move(parameters),
          .contact = friction_laws(
              [](const Parameters&) {
                return std::vector{flat_wall("floor", 0.1), flat_wall("wall", 0.1)};
              },
              [](const Parameters& p) {
                const LeaningRod r(p);
                return Pressed{r.mass, r.weight()};
              }),
          .default_output = "results/leaning_rod",
          .model = [](const Parameters& p,
                      const WallLaws& laws) { return leaning_rod_model(LeaningRod(p), laws); },
          .duration = [](const Parameters& p) { return p.number("duration"); },
          .checks_hold_with_friction = true,
          .law_checks = leaning_rod_checks};
}

}  // namespace yoke::cases
