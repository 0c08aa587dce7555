// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A slider-crank at 5000 rpm whose rod turns on the slider's pin with clearance.
//
//           A                       O  pivot of the crank, origin
//          o                        A  crank pin, ideal
//   crank /   ' - .   rod           E  bore at the end of the rod, radius R_J + c
//        /          ' - .  E        S  journal of the slider, radius R_J = 10 mm
//    O  o - - - - - - - -(o)==      slider guided along x, y = 0
//                         S         |S - E| <= c + deepest penetration
//
// Data of P. Flores and others (Kinematics and Dynamics of Multibody Systems with Imperfect Joints,
// 2008): crank 50 mm, 0.30 kg; rod 120 mm, 0.21 kg, 2.5e-5 kg m^2; slider 0.14 kg; c = 0.5 mm;
// e = 0.9; steel; constant 5000 rpm; no gravity. The start is that of the ideal mechanism, the
// journal in the middle of its bore.
//
// Without clearance  x = r cos(phi) + sqrt(l^2 - r^2 sin^2(phi)). With it the slider's distance from
// A lies between l - p and l + p, p = c + deepest penetration, so x lies between that formula with
// l - p and with l + p.
//
// What should happen. Free flight at first; then impacts against the bore, shorter and shorter
// flights, and the journal follows the wall. It changes sides about where the ideal slider's
// acceleration changes sign, with hard impacts.
#include <algorithm>
#include <cmath>

#include <yoke/cases/choices/clearance_choice.hpp>
#include <yoke/cases/clearance/bearings.hpp>
#include <yoke/cases/slider_crank.hpp>
#include <yoke/contact/clearance.hpp>
#include <yoke/core/units.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

constexpr double journal_radius = 10.0_mm;

struct SliderCrankClearance {
  double crank, rod;  // [m]
  double omega;       // [rad/s]
  double clearance;   // [m] 0: ideal
  double turns;       // of the crank
  double section;     // [rad] crank angle of the section
  Bearing bearing{};

  explicit SliderCrankClearance(const Parameters& p)
      : crank(p.number("crank")),
        rod(p.number("rod")),
        omega(p.number("speed") * pi / 30.0),
        clearance(clearance_of(p)),
        turns(p.number("turns")),
        section(p.number("section")),
        bearing{"slider pin", "rod", "slider", {crank + rod, 0.0}, clearance} {
    if (!(rod >= 1.05 * crank + 2.0 * clearance))
      throw ModelError(fmt::format(
          "slider_crank_clearance: rod = {:g} mm must be at least 1.05 times the crank and twice the "
          "clearance longer, {:g} mm",
          1e3 * rod, 1e3 * (1.05 * crank + 2.0 * clearance)));
  }

  /// [m] Of the slider, for a rod of this length.
  double slider_x(double phi, double length) const {
    const double up = crank * std::sin(phi);
    return crank * std::cos(phi) + std::sqrt(length * length - up * up);
  }
  /// [m/s] without clearance.
  double slider_v(double phi) const {
    const double s = std::sin(phi), c = std::cos(phi);
    return -crank * omega * (s + crank * s * c / std::sqrt(rod * rod - crank * crank * s * s));
  }
};

std::vector<Check> slider_crank_clearance_checks(const SliderCrankClearance& c, const Model& model,
                                                 const Result& run) {
  const Eigen::VectorXd t = run["t_s"], x = run["slider.x_m"];
  if (c.clearance == 0.0)
    return {deviation_check("position of the slider off by", run, "slider.x_m", "m", "closed form",
                            [&](std::size_t i) {
                              return c.slider_x(c.omega * t[static_cast<Eigen::Index>(i)], c.rod);
                            }),
            energy_check(run)};
  const double play = play_of(run, c.bearing);
  double beyond = 0.0;
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    const double phi = c.omega * t[i];
    beyond = std::max(
        {beyond, x[i] - c.slider_x(phi, c.rod + play), c.slider_x(phi, c.rod - play) - x[i]});
  }
  return {{.what = "slider farther from the ideal mechanism than the play, by",
           .value = 1e6 * beyond,
           .unit = "um",
           .tolerance = 1e-6,
           .remark = fmt::format("closed form; play {:.1f} um", 1e6 * play)},
          journal_check(model, run, c.bearing),
          energy_check(run)};
}

/// The slider once a turn, at the crank angle of the section: how far ahead of the ideal one it is,
/// and how much faster.
Portrait slider_section(const SliderCrankClearance& c, const Result& run) {
  const Eigen::VectorXd t = run["t_s"], x = run["slider.x_m"], v = run["slider.vx_m_per_s"];
  PortraitLine line{.name = "once a turn", .points = {}, .dots = true};
  const double turn = 2.0 * pi / c.omega;
  Eigen::Index i = 0;
  for (double at = c.section / c.omega; at <= t[t.size() - 1]; at += turn) {
    while (i + 2 < t.size() && t[i + 1] < at) ++i;
    const double h = t[i + 1] - t[i], s = (at - t[i]) / h, r = 1.0 - s;
    const double there = x[i] * r * r * (1.0 + 2.0 * s) + x[i + 1] * s * s * (1.0 + 2.0 * r) +
                         h * s * r * (v[i] * r - v[i + 1] * s);
    line.points.push_back({1e6 * (there - c.slider_x(c.section, c.rod)),
                           v[i] * r + v[i + 1] * s - c.slider_v(c.section)});
  }
  return {.name = "section",
          .title = fmt::format("slider once a turn, at a crank angle of {:.4g} deg",
                               c.section / 1.0_deg),
          .x_label = "ahead of the ideal slider [µm]",
          .y_label = "faster than it [m/s]",
          .lines = {line}};
}

std::vector<Portrait> slider_crank_portraits(const SliderCrankClearance& c, const Model& model,
                                             const Result& run) {
  if (c.clearance == 0.0) return {};
  std::vector<Portrait> all = {orbit_portrait(model, run, {c.bearing})};
  if (c.turns >= 2.0) all.push_back(slider_section(c, run));
  return all;
}

std::vector<CaseParameter> slider_crank_clearance_parameters() {
  return {clearance_parameter("0.5mm", "radius of the bore minus that of the journal, or ideal"),
          restitution_parameter("0.9"),
          {.name = "crank",
           .quantity = Quantity::length,
           .default_text = "50mm",
           .low = 1.0_mm,
           .high = 1000.0_mm,
           .description = "length of the crank"},
          {.name = "rod",
           .quantity = Quantity::length,
           .default_text = "120mm",
           .low = 1.0_mm,
           .high = 10000.0_mm,
           .description = "length of the connecting rod"},
          {.name = "speed",
           .quantity = Quantity::number,
           .default_text = "5000",
           .low = 1.0,
           .high = 1e5,
           .description = "of the crank, in revolutions per minute"},
          {.name = "turns",
           .quantity = Quantity::number,
           .default_text = "10",
           .low = 0.01,
           .high = 1000.0,
           .description = "of the crank"},
          {.name = "section",
           .quantity = Quantity::angle,
           .default_text = "90deg",
           .low = 0.0,
           .high = 360.0_deg,
           .description = "crank angle at which the section is taken"}};
}

}  // namespace

Case slider_crank_clearance_case() {
  return {
      .name = "slider_crank_clearance",
      .group = "joints with clearance",
      .description = "a slider-crank at 5000 rpm, its slider's pin with clearance or ideal",
      .parameters = slider_crank_clearance_parameters(),
      .contact = clearance_laws([](const Parameters& p) {
        return std::vector<Wall>{{.name = "bore",
                                  .pair = {.pin_radius = journal_radius,
                                           .wall_radius = journal_radius + clearance_of(p),
                                           .conformity = Conformity::internal},
                                  .length = 20.0_mm}};
      }),
      .default_output = "results/slider_crank_clearance",
      .model =
          [](const Parameters& p, const WallLaws& laws) {
            const SliderCrankClearance c(p);
            std::optional<Clearance> pin;
            if (c.clearance > 0.0)
              pin = BearingClearance{.journal_radius = journal_radius,
                                     .radial = c.clearance,
                                     .law = laws["bore"],
                                     .reference_force = 100.0};
            return driven_slider_crank(c.crank, c.rod, c.omega, pin);
          },
      .duration = [](const Parameters& p) { return p.number("turns") * 60.0 / p.number("speed"); },
      .checks =
          [](const Parameters& p, const Model& model, const Result& run) {
            return slider_crank_clearance_checks(SliderCrankClearance(p), model, run);
          },
      .portraits =
          [](const Parameters& p, const Model& model, const Result& run) {
            return slider_crank_portraits(SliderCrankClearance(p), model, run);
          }};
}

}  // namespace yoke::cases
