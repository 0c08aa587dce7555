// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Whitworth's quick-return mechanism as in a shaper: the pin of a crank drives a slotted lever,
// whose tip moves a ram through a link.
//
//    ram          link       tip
//   [===]-----------------------o         O  pivot of the lever, origin
//   ======  guide at H         / /        M  pivot of the crank, `distance` above O
//                             / /         P  pin of the crank, in the slot of the lever
//                    .-- P (o)
//               crank    / / /            H = lever (1 + cos(beta)) / 2: the tip is as far above
//                    M(+) / /                 the guide in the middle as below it at the ends
//                       / /
//                      O                  sin(beta) = crank / distance
//
// The crank turns at constant speed, counter-clockwise. The lever swings by beta to either side.
// While the pin goes over the top the ram works, moving to the left; it returns while the pin goes
// below M, where it is nearer to O:
//
//   lever angle  theta = atan2(distance + r sin(phi), r cos(phi))
//   stroke       2 lever sin(beta), if the link is flatter than the lever at the ends; else the ram
//                turns back before the lever does, and goes a little farther
//   time ratio   (180 deg + 2 beta) / (180 deg - 2 beta), work to return
//
// What should happen. Twice the time for the stroke as for the return (crank 100 mm, distance
// 200 mm: beta = 30 deg); the force in the slot peaks twice in the return,
// where the ram is made fast and slow again.
#include <cmath>

#include <yoke/cases/case.hpp>
#include <yoke/cases/choices/clearance_choice.hpp>
#include <yoke/cases/uniform_bar.hpp>
#include <yoke/contact/geometry/curve_slot.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

struct QuickReturn {
  double crank, distance, lever, link;  // [m]
  double omega;                         // [rad/s] of the crank
  double clearance;                     // [m] of the pin in the slot, 0: ideal
  double start = 0.5 * pi;              // [rad] crank upright: the middle of the stroke

  explicit QuickReturn(const Parameters& p)
      : crank(p.number("crank")),
        distance(p.number("distance")),
        lever(p.number("lever")),
        link(p.number("link")),
        omega(p.number("speed") * pi / 30.0),
        clearance(clearance_of(p)) {
    const auto refuse = [](const char* name, double is, const char* need, double than) {
      throw ModelError(fmt::format("quick_return: {} = {:g} mm must be {} {:g} mm", name, 1e3 * is,
                                   need, 1e3 * than));
    };
    if (!(crank < 0.99 * distance))
      refuse("crank", crank, "shorter than 0.99 times the distance of the pivots,",
             0.99 * distance);
    if (!(lever > crank + distance))
      refuse("lever", lever, "longer than crank and distance together,", crank + distance);
    if (!(link > lever - height()))
      refuse("link", link, "longer than the tip rises above the guide,", lever - height());
  }

  double swing() const { return std::asin(crank / distance); }  // beta
  double height() const { return 0.5 * lever * (1.0 + std::cos(swing())); }
  /// Whether the ram turns where the lever turns.
  bool turns_with_lever() const {
    const double drop = height() - lever * std::cos(swing());  // of the tip, at the ends
    return drop / std::sqrt(link * link - drop * drop) < 1.0 / std::tan(swing());
  }
  double lever_angle(double phi) const {
    return std::atan2(distance + crank * std::sin(phi), crank * std::cos(phi));
  }
};

constexpr double slot_pin_radius = 10.0_mm;

/// The pin in the slot, which the lever has around its line from the pivot through the pin. The
/// slot is longer than the pin's way by two radii at each end.
void join_pin_and_slot(Model& m, const QuickReturn& c, BodyId crank, const Vec2& pin, BodyId lever,
                       const WallLaws& laws) {
  if (c.clearance == 0.0) {
    m.add(PointOnLine{
        .name = "slot", .a = crank, .at = pin, .b = lever, .through = {0.0, 0.0}, .along = pin});
    return;
  }
  const Vec2 along = pin.normalized();
  const double spare = 2.0 * slot_pin_radius;
  m.add(PinInSlot{.name = "slot",
                  .pin = {crank, pin, slot_pin_radius},
                  .slot = {lever, curve_slot({.centreline = line_segment(
                                                  (c.distance - c.crank - spare) * along,
                                                  (c.distance + c.crank + spare) * along),
                                              .half_width = slot_pin_radius + c.clearance})},
                  .law = laws["slot"]});
}

Model quick_return_model(const QuickReturn& c, const WallLaws& laws) {
  const Vec2 origin(0.0, 0.0), middle(0.0, c.distance),
      pin = middle + rotate(c.start, {c.crank, 0.0});
  const double theta = c.lever_angle(c.start);
  const Vec2 tip = rotate(theta, {c.lever, 0.0});
  const double drop = c.height() - tip.y();
  const Vec2 head(tip.x() - std::sqrt(c.link * c.link - drop * drop), c.height());
  Model m;
  // Upright at the start, crank and lever move their ends along x: the link does not turn.
  const double rate = c.omega * c.crank / (c.distance + c.crank);  // of the lever
  const Vec2 ram_speed = rate * perp(tip);
  const BodyId crank = m.add(uniform_bar({"crank", 1.0, middle, pin, origin, c.omega})),
               lever = m.add(uniform_bar({"lever", 3.0, origin, tip, origin, rate})),
               link = m.add(uniform_bar({"link", 1.0, head, tip, ram_speed, 0.0}));
  const BodyId ram = m.add(Body{
      .name = "ram", .mass = 5.0, .inertia = 0.05, .pose = {head, 0.0}, .twist = {ram_speed, 0.0}});
  m.add(Revolute{.name = "crank pivot", .a = ground, .b = crank, .at = middle});
  m.add(Revolute{.name = "lever pivot", .a = ground, .b = lever, .at = origin});
  join_pin_and_slot(m, c, crank, pin, lever, laws);
  m.add(Revolute{.name = "tip", .a = lever, .b = link, .at = tip});
  m.add(Revolute{.name = "ram pin", .a = link, .b = ram, .at = head});
  m.add(Prismatic{.name = "guide", .a = ground, .b = ram, .along = {1.0, 0.0}});
  m.add(Gravity{});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(c.start, c.omega)});
  return m;
}

/// The lever turns against the ideal one as far as the pin moves across the slot.
std::vector<Check> quick_return_play_checks(const QuickReturn& c, const Result& run) {
  const Eigen::VectorXd t = run["t_s"], lever = run["lever.angle_rad"],
                        reported = run["slot.penetration_m"];
  double worst = 0.0, deepest = 0.0, off = 0.0;
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    const double phi = c.start + c.omega * t[i];
    const Vec2 pin = Vec2(0.0, c.distance) + rotate(phi, {c.crank, 0.0});
    const double across = std::abs(rotate(-lever[i], pin).y());
    worst = std::max(worst, std::abs(across - c.clearance - reported[i]));
    deepest = std::max(deepest, reported[i]);
    off = std::max(off, std::abs(std::remainder(lever[i] - c.lever_angle(phi), 2.0 * pi)));
  }
  return {{.what = "pin in the slot and penetration reported differ by",
           .value = 1e6 * worst,
           .unit = "um",
           .tolerance = 1e6 * 1e-12 * (1.0 + c.distance + c.crank),  // rounding of poses
           .remark = fmt::format("from the poses; deepest {:.3g} um", 1e6 * deepest)},
          {.what = "lever off the ideal one by up to",
           .value = off,
           .expected = 0.0,
           .unit = "rad",
           .tolerance = std::asin((c.clearance + deepest) / (c.distance - c.crank)),
           .remark = "bound: clearance and deepest penetration, pin nearest to the pivot"},
          energy_check(run)};
}

std::vector<Check> quick_return_checks(const QuickReturn& c, const Result& run) {
  if (c.clearance > 0.0) return quick_return_play_checks(c, run);
  const double beta = c.swing();
  std::vector<Check> checks = {
      deviation_check("angle of the lever off by", run, "lever.angle_rad", "rad", "closed form",
                      [&, t = run["t_s"]](std::size_t i) {
                        return c.lever_angle(c.start + c.omega * t[static_cast<Eigen::Index>(i)]);
                      })};
  // The lever works while its angle grows.
  const std::vector<double> right = rising_times(run, "lever.omega_rad_per_s",
                                                 "lever.alpha_rad_per_s2"),
                            left = falling_times(run, "lever.omega_rad_per_s",
                                                 "lever.alpha_rad_per_s2");
  if (left.size() >= 2 && !right.empty()) {
    checks.push_back({.what = "time of work over time of return",
                      .value = (left[1] - right[0]) / (right[0] - left[0]),
                      .expected = (pi + 2.0 * beta) / (pi - 2.0 * beta),
                      .tolerance = 1e-6 + interpolation_error(run, 2.0 * pi / c.omega),
                      .remark = "closed form"});
  }
  if (left.size() >= 2 && c.turns_with_lever()) {
    // The ends of the stroke lie between rows.
    const Eigen::VectorXd x = run["ram.x_m"], t = run["t_s"];
    const double h = t[1] - t[0],
                 between = 0.25 * h * h * run["ram.ax_m_per_s2"].cwiseAbs().maxCoeff();
    checks.push_back({.what = "stroke",
                      .value = 1e3 * (x.maxCoeff() - x.minCoeff()),
                      .expected = 2e3 * c.lever * std::sin(beta),
                      .unit = "mm",
                      .tolerance = 1e3 * (between + tolerance_of(run, c.lever)),
                      .remark = "closed form"});
  }
  checks.push_back(energy_check(run));
  return checks;
}

}  // namespace

Case quick_return_case() {
  return {
      .name = "quick_return",
      .group = "linkages",
      .description = "Whitworth's quick return: a crank's pin in a slotted lever moves a ram",
      .parameters = {{.name = "crank",
                      .quantity = Quantity::length,
                      .default_text = "100mm",
                      .low = 1.0_mm,
                      .high = 10000.0_mm,
                      .description = "pivot to pin, shorter than the distance"},
                     {.name = "distance",
                      .quantity = Quantity::length,
                      .default_text = "200mm",
                      .low = 1.0_mm,
                      .high = 10000.0_mm,
                      .description = "of the pivots of crank and lever"},
                     {.name = "lever",
                      .quantity = Quantity::length,
                      .default_text = "500mm",
                      .low = 1.0_mm,
                      .high = 20000.0_mm,
                      .description = "pivot to tip"},
                     {.name = "link",
                      .quantity = Quantity::length,
                      .default_text = "300mm",
                      .low = 1.0_mm,
                      .high = 20000.0_mm,
                      .description = "tip of the lever to the ram"},
                     {.name = "speed",
                      .quantity = Quantity::number,
                      .default_text = "60",
                      .low = 1e-3,
                      .high = 1e5,
                      .description = "of the crank, in revolutions per minute"},
                     {.name = "turns",
                      .quantity = Quantity::number,
                      .default_text = "2",
                      .low = 0.01,
                      .high = 10000.0,
                      .description = "of the crank"},
                     clearance_parameter("ideal", "of the pin in the slot on each side, or ideal"),
                     restitution_parameter("0.8")},
      .contact = clearance_laws([](const Parameters&) {
        return std::vector<Wall>{flat_wall_for("slot", slot_pin_radius, 20.0_mm)};
      }),
      .default_output = "results/quick_return",
      .model = [](const Parameters& p,
                  const WallLaws& laws) { return quick_return_model(QuickReturn(p), laws); },
      .duration = [](const Parameters& p) { return p.number("turns") * 60.0 / p.number("speed"); },
      .checks = [](const Parameters& p, const Model&,
                   const Result& run) { return quick_return_checks(QuickReturn(p), run); },
      .paths = {"crank", "lever", "link", "ram"}};
}

}  // namespace yoke::cases
