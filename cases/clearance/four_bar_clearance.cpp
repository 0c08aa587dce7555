// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A crank-rocker with clearance in one bearing or in three.
//
//                 coupler      B           O, D  pivots, O the origin, D at (ground, 0)
//            A .--------------o            A     crank pin       clearance with bearings=three
//             o              /             B     coupler pin     clearance with one and three
//      crank /              / rocker       D     rocker pivot    clearance with bearings=three
//           o              o               O     crank pivot, ideal: the motor is there
//          O     ground     D
//
// The crank turns at constant speed; gravity acts along -y; links are uniform rods of steel, 1 kg/m.
// Without clearance, s = |D - A|:
//   B  where the circles about A (coupler) and D (rocker) meet, on the left of the way from A to D:
//      angle of the coupler = angle of D - A  +  acos((l^2 + s^2 - q^2)/(2 l s))
// With clearances the rocker's end stays as far from A as the coupler is long, within the plays p (each
// the clearance and the deepest penetration):  | |B - A| - l | <= p_B (+ p_A).
//
// What should happen. Journals follow their bores and change sides where the forces do, twice a turn
// or more; there they fly, land and bounce. Three clearances give fewer hard impacts each, but more
// of them.
#include <algorithm>
#include <cmath>
#include <optional>

#include <yoke/cases/choices/clearance_choice.hpp>
#include <yoke/cases/clearance/bearings.hpp>
#include <yoke/cases/uniform_bar.hpp>
#include <yoke/contact/clearance.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

constexpr double pin_radius = 5.0_mm;

struct FourBarClearance {
  double crank, coupler, rocker, base;  // [m]
  double omega;                         // [rad/s]
  double clearance;                     // [m] 0: ideal
  bool three;                           // bearings with clearance, or one
  double start = 0.5 * pi;              // [rad] of the crank

  explicit FourBarClearance(const Parameters& p)
      : crank(p.number("crank")),
        coupler(p.number("coupler")),
        rocker(p.number("rocker")),
        base(p.number("ground")),
        omega(p.number("speed") * pi / 30.0),
        clearance(clearance_of(p)),
        three(p.word("bearings") == "three") {
    // The triangle A B D must not be stretched or folded, with room for the clearances.
    const double room = 0.01 * coupler + 4.0 * clearance;
    if (!(crank + base + room < coupler + rocker))
      throw ModelError(fmt::format(
          "four_bar_clearance: coupler + rocker = {:g} mm must be greater than {:g} mm (crank + "
          "ground + 1 % of the coupler + 4 clearances), or the crank cannot turn",
          1e3 * (coupler + rocker), 1e3 * (crank + base + room)));
    if (!(std::abs(base - crank) - room > std::abs(coupler - rocker)))
      throw ModelError(fmt::format(
          "four_bar_clearance: |coupler - rocker| = {:g} mm must be less than {:g} mm (|ground - "
          "crank| - 1 % of the coupler - 4 clearances), or the crank cannot turn",
          1e3 * std::abs(coupler - rocker), 1e3 * (std::abs(base - crank) - room)));
  }

  Vec2 crank_pin(double phi) const { return rotate(phi, {crank, 0.0}); }
  double coupler_angle(double phi) const {
    const Vec2 way = Vec2(base, 0.0) - crank_pin(phi);
    const double s = way.norm();
    return std::atan2(way.y(), way.x()) +
           std::acos((coupler * coupler + s * s - rocker * rocker) / (2.0 * coupler * s));
  }
  Vec2 coupler_pin(double phi) const {
    return crank_pin(phi) + rotate(coupler_angle(phi), {coupler, 0.0});
  }
  double rocker_angle(double phi) const {
    const Vec2 arm = coupler_pin(phi) - Vec2(base, 0.0);
    return std::atan2(arm.y(), arm.x());
  }
  std::vector<Bearing> bearings() const {
    const Bearing at_b{"coupler pin", "coupler", "rocker", coupler_pin(start), clearance};
    if (!three) return {at_b};
    return {{"crank pin", "crank", "coupler", crank_pin(start), clearance},
            at_b,
            {"rocker pivot", "", "rocker", {base, 0.0}, clearance}};
  }
};

Model four_bar_model(const FourBarClearance& c, const WallLaws& laws) {
  const Vec2 A = c.crank_pin(c.start), B = c.coupler_pin(c.start), D(c.base, 0.0);
  // Velocities of the ideal mechanism: l psi' and q chi' from v_A + psi' perp(B - A) = chi' perp(B - D).
  const Vec2 v_A = c.omega * perp(A), rod = B - A, arm = B - D;
  const double chi = v_A.dot(rod) / perp(arm).dot(rod), psi = -v_A.dot(arm) / perp(rod).dot(arm);
  Model m;
  const auto bar = [&](const char* name, const Vec2& from, const Vec2& to, const Vec2& v,
                       double rate) {
    const double mass = 1.0 * (to - from).norm();  // 1 kg/m
    return m.add(uniform_bar({name, mass, from, to, v, rate}));
  };
  const BodyId crank = bar("crank", {0.0, 0.0}, A, {0.0, 0.0}, c.omega),
               coupler = bar("coupler", A, B, v_A, psi),
               rocker = bar("rocker", D, B, {0.0, 0.0}, chi);
  std::optional<Clearance> one, three;
  if (c.clearance > 0.0)
    one = BearingClearance{.journal_radius = pin_radius,
                           .radial = c.clearance,
                           .law = laws["bore"],
                           .reference_force = 10.0};
  if (c.three) three = one;
  m.add(Revolute{.name = "crank pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "crank pin", .a = crank, .b = coupler, .at = A, .clearance = three});
  m.add(Revolute{.name = "coupler pin", .a = coupler, .b = rocker, .at = B, .clearance = one});
  m.add(Revolute{.name = "rocker pivot", .a = ground, .b = rocker, .at = D, .clearance = three});
  m.add(Gravity{});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(c.start, c.omega)});
  return m;
}

std::vector<Check> four_bar_checks(const FourBarClearance& c, const Model& model,
                                   const Result& run) {
  const Eigen::VectorXd phi = run["crank.angle_rad"];
  const auto angle = [&](std::size_t i) { return phi[static_cast<Eigen::Index>(i)]; };
  if (c.clearance == 0.0)
    return {deviation_check("angle of the rocker off by", run, "rocker.angle_rad", "rad",
                            "closed form", [&](std::size_t i) { return c.rocker_angle(angle(i)); }),
            energy_check(run)};
  std::vector<Check> checks;
  double play = 0.0, beyond = 0.0;
  for (const Bearing& bearing : c.bearings()) {
    if (bearing.a != "") play += play_of(run, bearing);
    checks.push_back(journal_check(model, run, bearing));
  }
  const std::vector<Vec2> end = point_path(model, run, "rocker", c.coupler_pin(c.start));
  for (std::size_t i = 0; i < end.size(); ++i)
    beyond = std::max(beyond, std::abs((end[i] - c.crank_pin(angle(i))).norm() - c.coupler) - play);
  checks.push_back({.what = "rocker's end farther from the coupler's circle than the plays, by",
                    .value = 1e6 * beyond,
                    .unit = "um",
                    .tolerance = 1e-6,
                    .remark = fmt::format("closed form; plays {:.1f} um", 1e6 * play)});
  checks.push_back(energy_check(run));
  return checks;
}

CaseParameter link(const char* name, const char* length, const char* description) {
  return {.name = name,
          .quantity = Quantity::length,
          .default_text = length,
          .low = 5.0_mm,
          .high = 5000.0_mm,
          .description = description};
}

}  // namespace

Case four_bar_clearance_case() {
  return {
      .name = "four_bar_clearance",
      .group = "joints with clearance",
      .description = "a crank-rocker with clearance in one bearing, in three, or in none",
      .parameters = {clearance_parameter("0.1mm",
                                         "radius of each bore minus that of its journal, or ideal"),
                     {.name = "bearings",
                      .default_text = "three",
                      .words = {"one", "three"},
                      .description =
                          "with clearance: the coupler pin, or also crank pin and rocker "
                          "pivot"},
                     restitution_parameter("0.8"),
                     link("crank", "50mm", "length of the crank"),
                     link("coupler", "120mm", "length of the coupler"),
                     link("rocker", "90mm", "length of the rocker"),
                     link("ground", "110mm", "distance of the pivots"),
                     {.name = "speed",
                      .quantity = Quantity::number,
                      .default_text = "600",
                      .low = 10.0,
                      .high = 1e5,
                      .description = "of the crank, in revolutions per minute"},
                     {.name = "turns",
                      .quantity = Quantity::number,
                      .default_text = "2",
                      .low = 0.01,
                      .high = 1000.0,
                      .description = "of the crank"}},
      .contact = clearance_laws([](const Parameters& p) {
        return std::vector<Wall>{{.name = "bore",
                                  .pair = {.pin_radius = pin_radius,
                                           .wall_radius = pin_radius + clearance_of(p),
                                           .conformity = Conformity::internal},
                                  .length = 10.0_mm}};
      }),
      .default_output = "results/four_bar_clearance",
      .model = [](const Parameters& p,
                  const WallLaws& laws) { return four_bar_model(FourBarClearance(p), laws); },
      .duration = [](const Parameters& p) { return p.number("turns") * 60.0 / p.number("speed"); },
      .checks = [](const Parameters& p, const Model& model,
                   const Result& run) { return four_bar_checks(FourBarClearance(p), model, run); },
      .portraits =
          [](const Parameters& p, const Model& model, const Result& run) {
            const FourBarClearance c(p);
            if (c.clearance == 0.0) return std::vector<Portrait>{};
            return std::vector<Portrait>{orbit_portrait(model, run, c.bearings())};
          },
      .paths = {"coupler", "rocker"}};
}

}  // namespace yoke::cases
