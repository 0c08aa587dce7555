// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A block on an incline: it holds, creeps or slides.
//
//            ___
//           | m |  -> x       N = m g cos(a), constant
//        ___|___|____         m x'' = m g sin(a) - T(N, x')
//       a ) incline           Coulomb: holds for tan(a) <= mu_static, else x = g (sin a - mu cos a) t^2/2
//
// The block does not tip: its angle is held, as a wide block's is. It touches at one point, with no
// radius, in the middle of its base.
#include <cmath>

#include <yoke/cases/friction/friction_laws.hpp>
#include <yoke/cases/impacts/impact_laws.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

struct BlockOnIncline {
  static constexpr double g = 9.81;  // [m/s^2]
  double mass, angle, speed;         // [kg, rad, m/s]

  explicit BlockOnIncline(const Parameters& p)
      : mass(p.number("mass")), angle(p.number("angle")), speed(p.number("speed")) {}

  double normal_force() const { return mass * g * std::cos(angle); }
};

// The axes are those of the incline, and gravity leans.
Model block_on_incline_model(const BlockOnIncline& c, const WallLaws& laws) {
  constexpr double length = 0.2, height = 0.12;  // [m] as drawn
  Model m;
  const ContactLaw& law = laws["incline"];
  const double depth = law.elastic.penetration_at(c.normal_force());
  const double low = -depth, high = height - depth;
  const BodyId block = m.add(Body{
      .name = "block",
      .mass = c.mass,
      .inertia = c.mass * (length * length + height * height) / 12.0,
      .pose = {{0.0, 0.5 * height - depth}, 0.0},
      .twist = {{c.speed, 0.0}, 0.0},
      .outline = {
          {-0.5 * length, low}, {0.5 * length, low}, {0.5 * length, high}, {-0.5 * length, high}}});
  m.add(AngleDriver{.name = "upright", .body = block, .angle = constant(0.0)});
  m.add(Gravity{.acceleration = {BlockOnIncline::g * std::sin(c.angle),
                                 -BlockOnIncline::g * std::cos(c.angle)}});
  m.add(DiscOnCurve{.name = "incline",
                    .disc = {block, {0.0, low}, 0.0},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = law,
                    .reference_force = c.normal_force()});
  return m;
}

std::vector<Check> block_on_incline_checks(const Parameters& p, const WallLaws& laws,
                                           const Result& run) {
  const BlockOnIncline c(p);
  const double N = c.normal_force();
  std::vector<Check> checks = line_checks(run, laws["incline"].friction,
                                          {.mass = c.mass,
                                           .normal_force = N,
                                           .load = c.mass * BlockOnIncline::g * std::sin(c.angle),
                                           .v = c.speed,
                                           .reference_force = N},
                                          "block.x_m", "block.vx_m_per_s");
  checks.push_back(energy_check(run));
  return checks;
}

}  // namespace

Case block_on_incline_case() {
  std::vector<CaseParameter> parameters = {
      {.name = "angle",
       .quantity = Quantity::angle,
       .default_text = "20deg",
       .low = 0.0,
       .high = 80.0_deg,
       .description = "of the incline"},
      {.name = "speed",
       .quantity = Quantity::number,
       .default_text = "0",
       .low = -20.0,
       .high = 20.0,
       .description = "at the start, down the incline, in m/s"},
      mass_parameter("mass", "2", "of the block, in kg"),
      {.name = "duration",
       .quantity = Quantity::time,
       .default_text = "2s",
       .low = 1e-3,
       .high = 1000.0,
       .description = "of the run"}};
  for (CaseParameter& p : friction_parameters("0.3", "0.4")) parameters.push_back(std::move(p));
  return {
      .name = "block_on_incline",
      .group = "friction",
      .description = "a block on an incline that holds, creeps or slides",
      .parameters = std::move(parameters),
      .contact =
          friction_laws([](const Parameters&) { return std::vector{flat_wall("incline", 0.1)}; },
                        [](const Parameters& p) {
                          const BlockOnIncline c(p);
                          return Pressed{c.mass, c.normal_force()};
                        }),
      .default_output = "results/block_on_incline",
      .model = [](const Parameters& p,
                  const WallLaws& laws) { return block_on_incline_model(BlockOnIncline(p), laws); },
      .duration = [](const Parameters& p) { return p.number("duration"); },
      .checks_hold_with_friction = true,
      .law_checks = block_on_incline_checks};
}

}  // namespace yoke::cases
