// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A coupler on parallel cranks, more of them than it needs: an over-closed mechanism to look at.
#include <cmath>

#include <yoke/cases/case.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

constexpr double radius = 0.3, start_angle = 1.1, start_speed = 4.0;  // of the cranks
constexpr double coupler_mass = 2.0, crank_mass = 0.5;

Model model_of(const Parameters& p) {
  const int cranks = p.whole("cranks");
  const double length = 1.0, angle = start_angle, omega = start_speed;
  const Vec2 up = rotate(angle, {radius, 0.0});
  Model m;
  const BodyId coupler = m.add({.name = "coupler",
                                .mass = coupler_mass,
                                .inertia = coupler_mass / 12.0,
                                .pose = {up + Vec2(0.5 * length, 0.0), 0.0},
                                .twist = {omega * perp(up), 0.0}});
  for (int i = 1; i <= cranks; ++i) {
    // The ends first, the others between them.
    const double x = i == 1 ? 0.0 : i == 2 ? length : length * (i - 2) / (cranks - 1);
    const std::string name = "crank " + std::to_string(i);
    const BodyId crank = m.add({.name = name,
                                .mass = crank_mass,
                                .inertia = crank_mass * radius * radius / 12.0,
                                .pose = {Vec2(x, 0.0) + 0.5 * up, angle},
                                .twist = {0.5 * omega * perp(up), omega}});
    m.add(Revolute{.name = name + " foot", .a = ground, .b = crank, .at = {x, 0.0}});
    m.add(Revolute{.name = name + " tip", .a = coupler, .b = crank, .at = Vec2(x, 0.0) + up});
  }
  m.add(Gravity{});
  return m;
}

/// All cranks turn alike and the coupler does not turn: one energy gives the speed at every angle.
std::vector<Check> parallelogram_checks(const Parameters& p, const Model&, const Result& run) {
  const int cranks = p.whole("cranks");
  const double inertia = radius * radius * (coupler_mass + cranks * crank_mass / 3.0);
  const double weight = 9.81 * radius * (coupler_mass + 0.5 * cranks * crank_mass);
  const auto energy_at = [&](double angle) {
    return 0.5 * inertia * start_speed * start_speed +
           weight * (std::sin(start_angle) - std::sin(angle));
  };
  return {
      energy_check(run),
      deviation_check("kinetic energy off that of the angle", run, "kinetic_J", "J", "closed form",
                      [&, angle = run["crank 1.angle_rad"]](std::size_t i) {
                        return energy_at(angle[static_cast<Eigen::Index>(i)]);
                      }),
      {.what = "equations left out",
       .value = static_cast<double>(run.summary.redundant_equations.size()),
       .expected = cranks - 2.0,
       .remark = "one for each crank beyond two"}};
}

}  // namespace

Case parallelogram_case() {
  return {.name = "parallelogram",
          .group = "linkages",
          .description = "a coupler on three parallel cranks or more: over-closed",
          .parameters = {{.name = "cranks",
                          .quantity = Quantity::number,
                          .default_text = "3",
                          .low = 2.0,
                          .high = 50.0,
                          .whole = true,
                          .description = "parallel cranks; two are enough"}},
          .default_output = "results/parallelogram",
          .model = [](const Parameters& p, const WallLaws&) { return model_of(p); },
          .duration = [](const Parameters&) { return 2.0; },
          .checks = parallelogram_checks,
          .paths = {"coupler"}};
}

}  // namespace yoke::cases
