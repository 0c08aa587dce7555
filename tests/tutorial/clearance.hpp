// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// From the next line on: the file of docs/tutorial/clearance.md, as a reader has it at the end of the page.

// A slotted lever, as in a shaper: the pin of a crank slides in the slot of a lever.
//
//           o tip, 5 kg            O  pivot of the lever, the origin
//          / /                     M  pivot of the crank, 200 mm above O
//         / /                      P  pin of the crank, 100 mm from M, in the slot
//     P (o)
//      / / `-. M(+)                The crank turns at 60 rpm, counter-clockwise, and gets
//     / /                          there from rest within a quarter of a second.
//    / /
//   O
//
// To be expected: seen from O, the pin is in the direction atan2(200 + 100 cos a, -100 sin a), with a the
// angle of the crank from upright; that is where the lever points. It swings by asin(100/200) = 30 deg to
// either side, and takes twice as long to the left, while the pin is above, as back to the right.
#include <algorithm>
#include <cmath>
#include <yoke/cases/case.hpp>
#include <yoke/cases/choices/clearance_choice.hpp>
#include <yoke/yoke.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

constexpr double distance = 200.0_mm, radius = 100.0_mm, length = 450.0_mm;
constexpr double speed = 60.0_rpm, start_up = 0.25_s;
constexpr double pin_radius = 10.0_mm;

Model slotted_lever_model(double clearance, const ContactLaw& law) {
  const Vec2 pivot(0.0, 0.0), middle(0.0, distance);
  const Vec2 pin(0.0, distance + radius), tip(0.0, length);

  Model m;
  const Body bar{.name = "lever", .mass = 3.0_kg, .inertia = 0.051_kg_m2, .pose = {0.5 * tip, 0.0}};
  const BodyId lever = m.add(with_point_mass(bar, 5.0_kg, tip));
  const BodyId crank = m.add({.name = "crank",
                              .mass = 1.0_kg,
                              .inertia = 833.0_kg_mm2,
                              .pose = {0.5 * (middle + pin), 0.0}});
  m.add(Gravity{});
  m.add(Revolute{.name = "lever pivot", .a = ground, .b = lever, .at = pivot});
  m.add(Revolute{.name = "crank pivot", .a = ground, .b = crank, .at = middle});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = smooth_ramp(0.0, speed, start_up)});
  const Vec2 bottom(0.0, 70.0_mm), top(0.0, 330.0_mm);  // ends of the slot's centreline
  m.add(PinInSlot{.name = "slot",
                  .pin = {crank, pin, pin_radius},
                  .slot = {lever, curve_slot({.centreline = line_segment(bottom, top),
                                              .half_width = pin_radius + clearance})},
                  .law = law});
  return m;
}

// The angle of the lever, from upright, while the crank is at angle a.
double expected_angle(double a) {
  return std::atan2(distance + radius * std::cos(a), -radius * std::sin(a)) - 90.0_deg;
}

// The walls that a law is to be made for: here one, the flat sides of the slot, 20 mm thick.
std::vector<Wall> slot_walls(const Parameters&) {
  return {flat_wall_for("slot", pin_radius, 20.0_mm)};
}

// Steel on steel: Johnson's law of cylinders with the damping of Flores and others.
ContactLaw steel_law(const Parameters&, const Wall& wall) {
  return {johnson(wall.pair, wall.length), Flores{.e = 0.8}};
}

// Off the ideal lever by no more than the clearance allows where the pin is nearest to the pivot.
std::vector<Check> lever_checks(const Parameters& p, const Model&, const Result& run) {
  const Eigen::VectorXd a = run["crank.angle_rad"], lever = run["lever.angle_rad"];
  double worst = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    worst = std::max(worst, std::abs(lever[i] - expected_angle(a[i])));
  const double deepest = run["slot.penetration_m"].maxCoeff();
  return {{.what = "lever off the ideal one by up to",
           .value = worst,
           .unit = "rad",
           .tolerance = std::asin((p.number("clearance") + deepest) / (distance - radius)),
           .remark = "clearance and deepest penetration, pin nearest to the pivot"},
          energy_check(run)};
}

}  // namespace

Case slotted_lever_case() {
  return {.name = "slotted_lever",
          .group = "tutorial",
          .description = "the pin of a crank in the slot of a lever",
          .parameters = {{.name = "clearance",
                          .quantity = Quantity::length,
                          .default_text = "0.2mm",
                          .low = 0.001_mm,
                          .high = 2.0_mm,
                          .description = "of the pin in the slot, on each side"}},
          .contact = {.walls = slot_walls, .laws = {{"steel", "Johnson and Flores", steel_law}}},
          .default_output = "results/slotted_lever",
          .model =
              [](const Parameters& p, const WallLaws& laws) {
                return slotted_lever_model(p.number("clearance"), laws["slot"]);
              },
          .duration = [](const Parameters&) { return start_up + 2.0_s; },
          .checks = lever_checks,
          .paths = {"crank", "lever"}};
}

}  // namespace yoke::cases
