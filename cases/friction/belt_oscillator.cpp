// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A mass on a spring, on a belt that carries it along until the spring tears it off: stick-slip.
//
//       |/\/\/\/[ m ]          N = m g, constant
//      _|________|_____        m x'' + k x = -T(N, x' - V)
//        belt, V ->
//
// It oscillates where friction falls with the sliding velocity. With Coulomb's static and kinetic
// friction, while it sticks x' = V; it slips at k x = mu_s N, about x = mu N/k, and sticks again at the
// speed of the belt: period and amplitude, w^2 = k/m, D = (mu_s - mu) N/k,
//   amplitude  about mu N/k: sqrt(D^2 + (V/w)^2)
//   period     2 D/V + (2/w)(pi - atan(D w/V))
#include <cmath>

#include <yoke/cases/friction/friction_laws.hpp>
#include <yoke/cases/impacts/impact_laws.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/translational_spring.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

struct BeltOscillator {
  static constexpr double g = 9.81;  // [m/s^2]
  double mass, spring, belt;         // [kg, N/m, m/s]

  explicit BeltOscillator(const Parameters& p)
      : mass(p.number("mass")), spring(p.number("spring")), belt(p.number("belt_speed")) {}

  double normal_force() const { return mass * g; }
};

Model belt_oscillator_model(const BeltOscillator& c, const WallLaws& laws) {
  constexpr double size = 0.1, free_length = 0.5;  // [m] as drawn
  Model m;
  const ContactLaw& law = laws["belt"];
  const double depth = law.elastic.penetration_at(c.normal_force());
  const double low = -depth, middle = 0.5 * size - depth, high = size - depth;
  const BodyId block = m.add(Body{
      .name = "block",
      .mass = c.mass,
      .inertia = c.mass * size * size / 6.0,
      .pose = {{0.0, middle}, 0.0},
      .outline = {{-0.5 * size, low}, {0.5 * size, low}, {0.5 * size, high}, {-0.5 * size, high}}});
  m.add(AngleDriver{.name = "upright", .body = block, .angle = constant(0.0)});
  m.add(Gravity{.acceleration = {0.0, -BeltOscillator::g}});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = block,
                            .at_a = {-free_length, middle},
                            .at_b = {0.0, middle},
                            .stiffness = c.spring,
                            .free_length = free_length});
  m.add(DiscOnCurve{.name = "belt",
                    .disc = {block, {0.0, low}, 0.0},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = law,
                    .surface_speed = c.belt,
                    .reference_force = c.normal_force()});
  return m;
}

std::vector<Check> belt_oscillator_checks(const Parameters& p, const WallLaws& laws,
                                          const Result& run) {
  const BeltOscillator c(p);
  std::vector<Check> checks = line_checks(run, laws["belt"].friction,
                                          {.mass = c.mass,
                                           .normal_force = c.normal_force(),
                                           .stiffness = c.spring,
                                           .belt = c.belt,
                                           .reference_force = c.normal_force()},
                                          "block.x_m", "block.vx_m_per_s");
  checks.push_back(energy_check(run));
  return checks;
}

}  // namespace

Case belt_oscillator_case() {
  std::vector<CaseParameter> parameters = {mass_parameter("mass", "1", "of the block, in kg"),
                                           {.name = "spring",
                                            .quantity = Quantity::number,
                                            .default_text = "100",
                                            .low = 1e-2,
                                            .high = 1e6,
                                            .description = "stiffness, in N/m"},
                                           {.name = "belt_speed",
                                            .quantity = Quantity::number,
                                            .default_text = "0.1",
                                            .low = -10.0,
                                            .high = 10.0,
                                            .description = "in m/s, > 0 to the right"},
                                           {.name = "duration",
                                            .quantity = Quantity::time,
                                            .default_text = "5s",
                                            .low = 1e-3,
                                            .high = 1000.0,
                                            .description = "of the run"}};
  for (CaseParameter& p : friction_parameters("0.25", "0.4")) parameters.push_back(std::move(p));
  return {
      .name = "belt_oscillator",
      .group = "friction",
      .description = "a mass on a spring on a moving belt: stick-slip",
      .parameters = std::move(parameters),
      .contact =
          friction_laws([](const Parameters&) { return std::vector{flat_wall("belt", 0.1)}; },
                        [](const Parameters& p) {
                          const BeltOscillator c(p);
                          return Pressed{c.mass, c.normal_force()};
                        }),
      .default_output = "results/belt_oscillator",
      .model = [](const Parameters& p,
                  const WallLaws& laws) { return belt_oscillator_model(BeltOscillator(p), laws); },
      .duration = [](const Parameters& p) { return p.number("duration"); },
      .checks_hold_with_friction = true,
      .law_checks = belt_oscillator_checks};
}

}  // namespace yoke::cases
