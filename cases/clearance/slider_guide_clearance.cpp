// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A slider-crank left alone, whose slider is a block between two walls with clearance.
//
//           A                  ====================  left wall, y =  b/2 + c
//          o                        +--------+
//   l1   /   ' - .   l2             | a      |         block a x b = 50 x 25 mm; each corner may
//      /           ' - .  - - - - - | (o) S  | b       touch the wall it is next to
//    O o                            +--------+
//                              ====================  right wall, y = -b/2 - c
//
// Data of P. Flores (2010): l1 153 mm, l2 306 mm; crank and rod 38 g, 7.4e-5 and 5.9e-4 kg m^2;
// slider 76 g, 2.7e-6 kg m^2; c = 1 mm; g = 9.81 m/s^2. At the start all links lie along x, the crank
// turns at 150 rad/s, the rod at -75 rad/s, the slider is in the middle and at rest.
//
// Without clearance  x = l1 cos(phi) + sqrt(l2^2 - l1^2 sin^2(phi)), one degree of freedom. With it
// there are three: between contacts crank and rod are a double pendulum, the slider at its end.
// The slider is within |y| + (a/2) |sin(angle)| + (b/2) (cos(angle) - 1) <= c + penetration.
//
// What should happen. The rod's end drops out of the line of the guide; the slider meets the wall at
// about 2.69 ms and bounces between both. As the pin is in the middle of the block and nothing rubs,
// both corners of a side touch at once and the block does not turn. A small spin at the start, or
// rounding in a long run, ends that: then it rattles on single corners.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <yoke/cases/case.hpp>
#include <yoke/cases/choices/clearance_choice.hpp>
#include <yoke/cases/slider_crank.hpp>
#include <yoke/contact/clearance.hpp>
#include <yoke/core/units.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

constexpr double block_length = 50.0_mm, block_width = 25.0_mm;
constexpr double crank_length = 153.0_mm, rod_length = 306.0_mm;

/// [m] The slider without clearance.
double ideal_position(double crank_angle) {
  const double up = crank_length * std::sin(crank_angle);
  return crank_length * std::cos(crank_angle) + std::sqrt(rod_length * rod_length - up * up);
}

struct SliderGuideClearance {
  double clearance;      // [m] 0: ideal
  double corner_radius;  // [m]
  double spin;           // [rad/s]

  explicit SliderGuideClearance(const Parameters& p)
      : clearance(clearance_of(p)),
        corner_radius(p.number("corner_radius")),
        spin(p.number("spin")) {
    if (clearance == 0.0 && spin != 0.0)
      throw ModelError(fmt::format(
          "slider_guide_clearance: spin = {:g} rad/s must be 0 with an ideal guide", spin));
  }

  /// [m] How far beyond the clearance a corner is, for the block's middle at height y.
  double penetration(double y, double angle, bool front, bool left) const {
    const Vec2 corner((front ? 1.0 : -1.0) * (0.5 * block_length - corner_radius),
                      (left ? 1.0 : -1.0) * (0.5 * block_width - corner_radius));
    const double at = y + rotate(angle, corner).y();
    return (left ? at : -at) + corner_radius - 0.5 * block_width - clearance;
  }
};

/// The clearance as the poses of the slider say it, beside what the contacts report.
Check corner_check(const SliderGuideClearance& c, const Result& run) {
  const Eigen::VectorXd y = run["slider.y_m"], angle = run["slider.angle_rad"];
  double worst = 0.0, deepest = 0.0;
  for (const bool front : {true, false})
    for (const bool left : {true, false}) {
      const Eigen::VectorXd reported = run[fmt::format(
          "guide {} {}.penetration_m", front ? "front" : "back", left ? "left" : "right")];
      for (Eigen::Index i = 0; i < y.size(); ++i) {
        const double is = c.penetration(y[i], angle[i], front, left);
        worst = std::max(worst, std::abs(is - reported[i]));
        deepest = std::max(deepest, is);
      }
    }
  return {.what = "corners of the block and penetrations reported differ by",
          .value = 1e6 * worst,
          .unit = "um",
          .tolerance = 1e6 * 1e-12,  // rounding of poses of a metre
          .remark = fmt::format("from the poses; deepest {:.3g} um", 1e6 * deepest)};
}

/// The limit of small clearance. The slider's middle is off the guide's line by no more than the play,
/// and x follows the height at the rate of the rod's slope, (l1 sin(phi) - y)/(the rod's part along x).
Check limit_check(const SliderGuideClearance& c, const Result& run) {
  const Eigen::VectorXd x = run["slider.x_m"], phi = run["crank.angle_rad"];
  double worst = 0.0, deepest = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    worst = std::max(worst, std::abs(x[i] - ideal_position(phi[i])));
  for (const char* corner : {"front left", "front right", "back left", "back right"})
    deepest = std::max(deepest, run[fmt::format("guide {}.penetration_m", corner)].maxCoeff());
  const double play = c.clearance + deepest, reach = crank_length + play;
  const double slope = reach / std::sqrt(rod_length * rod_length - reach * reach);
  return {.what = "slider off the ideal one by up to",
          .value = 1e6 * worst,
          .unit = "um",
          .tolerance = 1e6 * slope * play,
          .remark = "closed form of the crank's angle; bound: play and slope of the rod"};
}

std::vector<Check> slider_guide_checks(const SliderGuideClearance& c, const Model&,
                                       const Result& run) {
  if (c.clearance > 0.0) return {corner_check(c, run), limit_check(c, run), energy_check(run)};
  const Eigen::VectorXd phi = run["crank.angle_rad"];
  return {deviation_check(
              "position of the slider off by", run, "slider.x_m", "m",
              "closed form of the crank's angle",
              [&](std::size_t i) { return ideal_position(phi[static_cast<Eigen::Index>(i)]); }),
          energy_check(run)};
}

std::vector<Portrait> slider_guide_portraits(const SliderGuideClearance& c, const Model&,
                                             const Result& run) {
  if (c.clearance == 0.0) return {};
  const Eigen::VectorXd x = run["slider.x_m"], y = run["slider.y_m"],
                        angle = run["slider.angle_rad"];
  PortraitLine track{.name = "middle of the slider", .points = {}},
      pose{.name = "slider", .points = {}};
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    track.points.push_back({1e3 * x[i], 1e6 * y[i]});
    pose.points.push_back({angle[i] / 1.0_deg, 1e6 * y[i]});
  }
  PortraitLine upper{.name = "left wall", .points = {}}, lower{.name = "right wall", .points = {}};
  for (const double at : {x.minCoeff(), x.maxCoeff()}) {
    upper.points.push_back({1e3 * at, 1e6 * c.clearance});
    lower.points.push_back({1e3 * at, -1e6 * c.clearance});
  }
  const double tilt = 2.0 * c.clearance / block_length / 1.0_deg, high = 1e6 * c.clearance;
  return {{.name = "track",
           .title = "path of the slider between the walls",
           .x_label = "x [mm]",
           .y_label = "y [µm]",
           .lines = {track, upper, lower}},
          {.name = "rattling",
           .title = "height and angle of the slider",
           .x_label = "angle [deg]",
           .y_label = "y [µm]",
           .lines = {
               pose,
               {.name = "clearance",
                .points = {{-tilt, 0.0}, {0.0, high}, {tilt, 0.0}, {0.0, -high}, {-tilt, 0.0}}}}}};
}

}  // namespace

Case slider_guide_clearance_case() {
  return {
      .name = "slider_guide_clearance",
      .group = "joints with clearance",
      .description = "a slider-crank left alone, its slider a block in a guide with clearance",
      .parameters = {clearance_parameter("1mm", "between block and wall on each side, or ideal"),
                     restitution_parameter("0.9"),
                     {.name = "corner_radius",
                      .quantity = Quantity::length,
                      .default_text = "1mm",
                      .low = 0.01_mm,
                      .high = 10.0_mm,
                      .description = "of the corners of the block"},
                     {.name = "spin",
                      .quantity = Quantity::number,
                      .default_text = "0.2",
                      .low = -100.0,
                      .high = 100.0,
                      .description = "of the slider at the start, in rad/s"},
                     {.name = "duration",
                      .quantity = Quantity::time,
                      .default_text = "100ms",
                      .low = 1e-4,
                      .high = 100.0,
                      .description = "of the run"}},
      .contact = clearance_laws([](const Parameters& p) {
        return std::vector<Wall>{flat_wall_for("guide", p.number("corner_radius"), 20.0_mm)};
      }),
      .default_output = "results/slider_guide_clearance",
      .model =
          [](const Parameters& p, const WallLaws& laws) {
            const SliderGuideClearance c(p);
            std::optional<Clearance> guide;
            if (c.clearance > 0.0)
              guide = GuideClearance{.length = block_length,
                                     .width = block_width,
                                     .gap = c.clearance,
                                     .law = laws["guide"],
                                     .corner_radius = c.corner_radius,
                                     .reference_force = 100.0};
            return free_slider_crank(guide, c.spin);
          },
      .duration = [](const Parameters& p) { return p.number("duration"); },
      .checks =
          [](const Parameters& p, const Model& model, const Result& run) {
            return slider_guide_checks(SliderGuideClearance(p), model, run);
          },
      .portraits =
          [](const Parameters& p, const Model& model, const Result& run) {
            return slider_guide_portraits(SliderGuideClearance(p), model, run);
          }};
}

}  // namespace yoke::cases
