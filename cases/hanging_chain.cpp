// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A chain of uniform links that hangs from a pivot; one link is the pendulum.
#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>
#include <string>

#include <yoke/cases/case.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

Model model_of(const Parameters& p) {
  const int links = p.whole("links");
  const double l = p.number("length") / links, mass = 1.0 / links,
               angle = p.number("angle") - 0.5 * pi;
  Model m;
  const Vec2 along = rotate(angle, {l, 0.0});
  BodyId last = ground;
  for (int i = 0; i < links; ++i) {
    const std::string n = std::to_string(i + 1);
    const BodyId link = m.add({.name = "link " + n,
                               .mass = mass,
                               .inertia = mass * l * l / 12.0,
                               .pose = {(i + 0.5) * along, angle}});
    m.add(Revolute{.name = "joint " + n, .a = last, .b = link, .at = i * along});
    m.add(TorsionalSpring{
        .name = "damper " + n, .a = last, .b = link, .damping = p.number("damping")});
    last = link;
  }
  m.add(Gravity{});
  return m;
}

/// One link without damping is a pendulum; its period is 4 K(sin(angle / 2)) sqrt(2 l / (3 g)), none
/// if it starts upright.
std::vector<Check> hanging_chain_checks(const Parameters& p, const Model&, const Result& run) {
  std::vector<Check> checks = {energy_check(run)};
  const double l = p.number("length"), angle = p.number("angle");
  const double modulus = std::sin(0.5 * angle);
  if (p.whole("links") != 1 || p.number("damping") != 0.0 || !(std::abs(modulus) < 1.0))
    return checks;
  const std::vector<double> times =
      rising_times(run, "link 1.angle_rad", "link 1.omega_rad_per_s", -0.5 * pi);
  const double period = 4.0 * boost::math::ellint_1(modulus) * std::sqrt(2.0 * l / (3.0 * 9.81));
  for (Check& check : period_check(run, times, period)) checks.push_back(std::move(check));
  return checks;
}

}  // namespace

Case hanging_chain_case() {
  return {.name = "hanging_chain",
          .group = "pendulums and chains",
          .description = "a hanging chain of uniform links, 1 kg together",
          .parameters = {{.name = "links",
                          .quantity = Quantity::number,
                          .default_text = "1",
                          .low = 1.0,
                          .high = 1e6,
                          .whole = true,
                          .description = "of the chain; one is the pendulum"},
                         {.name = "length",
                          .quantity = Quantity::length,
                          .default_text = "1000mm",
                          .low = 1e-3,
                          .high = 100.0,
                          .description = "of the whole chain"},
                         {.name = "angle",
                          .quantity = Quantity::angle,
                          .default_text = "30deg",
                          .low = -pi,
                          .high = pi,
                          .description = "from the vertical at the start"},
                         {.name = "damping",
                          .quantity = Quantity::number,
                          .default_text = "0",
                          .low = 0.0,
                          .high = 1e6,
                          .description = "of every joint, in N m s/rad"}},
          .default_output = "results/hanging_chain",
          .model = [](const Parameters& p, const WallLaws&) { return model_of(p); },
          .duration = [](const Parameters&) { return 5.0; },
          .checks = hanging_chain_checks};
}

}  // namespace yoke::cases
