// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Painleve's rod: a rod pushed along a rough floor like chalk on a board, its tip ahead of it.
//
//            /         l = L/2, uniform: I = m l^2/3; c = cos a, s = sin a
//           /  L       a unit of normal force, with its friction mu, moves the tip off the floor by
//    v <- _/)a_____      p/m = (1 + 3 c^2 - 3 mu s c)/m
//          floor       p <= 0 for mu >= (1 + 3 c^2)/(3 s c), at least 4/3: as a rigid body it has no motion
//
// (P. Painleve, C. R. Acad. Sci. Paris 1895, 121, 112-115.) With an elastic contact it has one: the force
// grows until the tip stops ("dynamic jamming"), and the rod vaults over it. The run says so.
#include <algorithm>
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

struct PainleveRod {
  static constexpr double g = 9.81;       // [m/s^2]
  double length, mass, angle, speed, mu;  // [m, kg, rad, m/s, 1]

  explicit PainleveRod(const Parameters& p)
      : length(p.number("length")),
        mass(p.number("mass")),
        angle(p.number("angle")),
        speed(p.number("speed")),
        mu(p.number("mu")) {}

  double weight() const { return mass * g; }
  /// (1 + 3 c^2)/(3 s c)
  double critical_friction() const {
    const double c = std::cos(angle), s = std::sin(angle);
    return (1.0 + 3.0 * c * c) / (3.0 * s * c);
  }
  bool wedges() const { return speed > 0.0 && mu >= critical_friction(); }
};

Model painleve_rod_model(const PainleveRod& r, const WallLaws& laws) {
  Model m;
  const Vec2 tip{0.0, 0.0}, end = r.length * Vec2(std::cos(r.angle), std::sin(r.angle));
  const BodyId rod = m.add(uniform_bar(
      {.name = "rod", .mass = r.mass, .from = tip, .to = end, .speed = {-r.speed, 0.0}}));
  m.add(Gravity{.acceleration = {0.0, -PainleveRod::g}});
  m.add(DiscOnCurve{.name = "tip",
                    .disc = {rod, tip, 0.0},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = laws["floor"],
                    .reference_force = r.weight()});
  return m;
}

std::vector<Check> painleve_rod_checks(const Parameters& p, const WallLaws& laws,
                                       const Result& run) {
  const PainleveRod r(p);
  std::vector<Check> checks;
  if (laws["floor"].friction.holds()) {
    const bool said = std::ranges::any_of(run.summary.notes, [](const std::string& note) {
      return note.find("Painleve's paradox") != std::string::npos;
    });
    checks.push_back(
        {.what = "Painleve's paradox reported",
         .value = said ? 1.0 : 0.0,
         .expected = r.wedges() ? 1.0 : 0.0,
         .remark = fmt::format("mu = {:g}, and rigid bodies have no motion beyond {:.5g}", r.mu,
                               r.critical_friction())});
  }
  checks.push_back(energy_check(run));
  return checks;
}

}  // namespace

Case painleve_rod_case() {
  std::vector<CaseParameter> parameters = {
      {.name = "angle",
       .quantity = Quantity::angle,
       .default_text = "60deg",
       .low = 10.0_deg,
       .high = 85.0_deg,
       .description = "between rod and floor at the start"},
      {.name = "speed",
       .quantity = Quantity::number,
       .default_text = "1",
       .low = -20.0,
       .high = 20.0,
       .description = "of the rod at the start, > 0 tip ahead, in m/s"},
      {.name = "length",
       .quantity = Quantity::length,
       .default_text = "0.2m",
       .low = 1.0_mm,
       .high = 100.0,
       .description = "of the rod"},
      mass_parameter("mass", "0.1", "of the rod, in kg"),
      {.name = "duration",
       .quantity = Quantity::time,
       .default_text = "0.05s",
       .low = 1e-4,
       .high = 1000.0,
       .description = "of the run"}};
  for (CaseParameter& p : friction_parameters("1.5", "1.5")) parameters.push_back(std::move(p));
  return {.name = "painleve_rod",
          .group = "friction",
          .description = "Painleve's rod: pushed along a rough floor, it jams",
          .parameters = std::move(parameters),
          .contact =
              friction_laws([](const Parameters&) { return std::vector{flat_wall("floor", 0.1)}; },
                            [](const Parameters& p) {
                              const PainleveRod r(p);
                              return Pressed{r.mass, r.weight()};
                            }),
          .default_output = "results/painleve_rod",
          .model = [](const Parameters& p,
                      const WallLaws& laws) { return painleve_rod_model(PainleveRod(p), laws); },
          .duration = [](const Parameters& p) { return p.number("duration"); },
          .checks_hold_with_friction = true,
          .law_checks = painleve_rod_checks};
}

}  // namespace yoke::cases
