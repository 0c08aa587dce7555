// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// From the next line on: the file of docs/tutorial/ideal.md, as a reader has it at the end of the page.

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
#include <cmath>
#include <yoke/cases/case.hpp>
#include <yoke/yoke.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

constexpr double distance = 200.0_mm, radius = 100.0_mm, length = 450.0_mm;
constexpr double speed = 60.0_rpm, start_up = 0.25_s;

Model slotted_lever_model() {
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
  m.add(PointOnLine{
      .name = "slot", .a = crank, .at = pin, .b = lever, .through = pivot, .along = {0.0, 1.0}});
  return m;
}

// The angle of the lever, from upright, while the crank is at angle a.
double expected_angle(double a) {
  return std::atan2(distance + radius * std::cos(a), -radius * std::sin(a)) - 90.0_deg;
}

}  // namespace

Case slotted_lever_case() {
  return {.name = "slotted_lever",
          .group = "tutorial",
          .description = "the pin of a crank in the slot of a lever",
          .default_output = "results/slotted_lever",
          .model = [](const Parameters&, const WallLaws&) { return slotted_lever_model(); },
          .duration = [](const Parameters&) { return start_up + 2.0_s; },
          .checks =
              [](const Parameters&, const Model&, const Result& run) {
                const Eigen::VectorXd a = run["crank.angle_rad"];
                const auto expected = [&](std::size_t row) {
                  return expected_angle(a[static_cast<Eigen::Index>(row)]);
                };
                return std::vector{
                    deviation_check("angle of the lever off by", run, "lever.angle_rad", "rad",
                                    "closed form", expected),
                    energy_check(run)};
              },
          .paths = {"crank", "lever"}};
}

}  // namespace yoke::cases
