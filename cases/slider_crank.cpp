// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The case is the ideal slider-crank, driven at constant speed; the others are benchmarks.
#include <yoke/cases/slider_crank.hpp>

#include <cmath>

#include <yoke/cases/case.hpp>
#include <yoke/contact/laws/friction/coulomb.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

const Vec2 origin{0.0, 0.0};

struct Link {
  double length, mass, inertia;
};

struct JointChoices {
  std::optional<Clearance> pin{}, guide{};
  std::optional<PinFriction> pin_friction{};
  std::optional<GuideFriction> guide_friction{};
};

/// All links along x, the crank turning at `omega`, the slider at rest.
Model slider_crank(const Link& crank, const Link& rod, const Link& slider, double omega,
                   const JointChoices& joints = {}, double spin = 0.0) {
  Model m;
  const double l1 = crank.length, l2 = rod.length, end = l1 + l2;
  const BodyId first = m.add(Body{.name = "crank",
                                  .mass = crank.mass,
                                  .inertia = crank.inertia,
                                  .pose = {{0.5 * l1, 0.0}, 0.0},
                                  .twist = {{0.0, 0.5 * omega * l1}, omega}});
  const BodyId second = m.add(Body{.name = "rod",
                                   .mass = rod.mass,
                                   .inertia = rod.inertia,
                                   .pose = {{l1 + 0.5 * l2, 0.0}, 0.0},
                                   .twist = {{0.0, 0.5 * omega * l1}, -omega * l1 / l2}});
  const BodyId third = m.add(Body{.name = "slider",
                                  .mass = slider.mass,
                                  .inertia = slider.inertia,
                                  .pose = {{end, 0.0}, 0.0},
                                  .twist = {{0.0, 0.0}, spin}});
  const std::optional<PinFriction>& rubs = joints.pin_friction;
  m.add(Revolute{.name = "pivot", .a = ground, .b = first, .at = origin, .friction = rubs});
  m.add(Revolute{.name = "crank pin", .a = first, .b = second, .at = {l1, 0.0}, .friction = rubs});
  m.add(Revolute{.name = "slider pin",
                 .a = second,
                 .b = third,
                 .at = {end, 0.0},
                 .clearance = joints.pin,
                 .friction = rubs});
  m.add(Prismatic{.name = "guide",
                  .a = ground,
                  .b = third,
                  .along = {1.0, 0.0},
                  .clearance = joints.guide,
                  .friction = joints.guide_friction});
  return m;
}

Model driven(double crank, double rod, double omega, const JointChoices& joints) {
  Model m =
      slider_crank({crank, 0.30, 1e-5}, {rod, 0.21, 2.5e-5}, {0.0, 0.14, 1e-4}, omega, joints);
  m.add(AngleDriver{.name = "motor", .body = m.find_body("crank"), .speed = omega});
  return m;
}

Model model_of(const Parameters& p) {
  const double r = p.number("crank"), l = p.number("rod"), omega = p.number("speed") * pi / 30.0;
  if (!(l > r))
    throw ModelError(fmt::format(
        "slider_crank: rod = {:g} mm must be longer than the crank, {:g} mm", 1e3 * l, 1e3 * r));
  JointChoices joints;
  if (const double mu = p.number("friction"); mu > 0.0) {
    joints.pin_friction = PinFriction{.law = Coulomb{mu, mu}, .radius = p.number("pin_radius")};
    joints.guide_friction = GuideFriction{.law = Coulomb{mu, mu}, .length = p.number("block")};
  }
  return driven(r, l, omega, joints);
}

std::vector<Check> slider_crank_checks(const Parameters& p, const Model&, const Result& run) {
  const double r = p.number("crank"), l = p.number("rod"), omega = p.number("speed") * pi / 30.0;
  return {energy_check(run),
          deviation_check("position of the slider off by", run, "slider.x_m", "m", "closed form",
                          [&, t = run["t_s"]](std::size_t i) {
                            const double phi = omega * t[static_cast<Eigen::Index>(i)];
                            const double up = r * std::sin(phi);
                            return r * std::cos(phi) + std::sqrt(l * l - up * up);
                          })};
}

}  // namespace

Model free_slider_crank(const std::optional<Clearance>& guide, double spin) {
  Model m = slider_crank({0.153, 0.038, 7.4e-5}, {0.306, 0.038, 5.9e-4}, {0.0, 0.076, 2.7e-6},
                         150.0, {.guide = guide}, spin);
  m.add(Gravity{});
  return m;
}

Model driven_slider_crank(double crank, double rod, double omega,
                          const std::optional<Clearance>& slider_pin) {
  return driven(crank, rod, omega, {.pin = slider_pin});
}

Model sprung_slider_crank() {
  const double a = 0.5, q = pi / 2.0, p = std::asin(-a);
  const Vec2 pin(std::cos(p), 0.0), tip(0.0, a), half = rotate(p, {0.5, 0.0});
  Model m;
  const BodyId crank =
      m.add(Body{.name = "crank", .mass = 1.0, .inertia = 1.0, .pose = {origin, q}});
  const BodyId rod_ = m.add(Body{.name = "rod", .mass = 1.0, .inertia = 2.0, .pose = {pin, p}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = origin});
  m.add(Revolute{.name = "crank pin", .a = crank, .b = rod_, .at = tip});
  m.add(PointOnLine{
      .name = "slot", .a = rod_, .at = pin, .b = ground, .through = origin, .along = {1.0, 0.0}});
  m.add(TranslationalSpring{.name = "spring",
                            .a = crank,
                            .b = rod_,
                            .at_a = 0.5 * tip,
                            .at_b = pin - half,
                            .stiffness = 1.0,
                            .damping = 1.0,
                            .free_length = 1.0});
  // Its work is F d(x + cos p): it acts as far beyond the slider as the crank's pin is before it.
  m.add(AppliedForce{.name = "push", .body = rod_, .at = pin + 2.0 * half, .force = [](double) {
                       return Vec2(1.0, 0.0);
                     }});
  return m;
}

Case slider_crank_case() {
  return {.name = "slider_crank",
          .group = "linkages",
          .description = "an ideal slider-crank, driven at constant speed",
          .parameters = {{.name = "crank",
                          .quantity = Quantity::length,
                          .default_text = "50mm",
                          .low = 1e-3,
                          .high = 1.0,
                          .description = "length of the crank"},
                         {.name = "rod",
                          .quantity = Quantity::length,
                          .default_text = "120mm",
                          .low = 1e-3,
                          .high = 10.0,
                          .description = "length of the connecting rod, longer than the crank"},
                         {.name = "speed",
                          .quantity = Quantity::number,
                          .default_text = "5000",
                          .low = 1e-3,
                          .high = 1e5,
                          .description = "of the crank, in revolutions per minute"},
                         {.name = "friction",
                          .quantity = Quantity::number,
                          .default_text = "0",
                          .low = 0.0,
                          .high = 1.0,
                          .description = "coefficient of Coulomb friction in all four joints"},
                         {.name = "pin_radius",
                          .quantity = Quantity::length,
                          .default_text = "10mm",
                          .low = 1e-4,
                          .high = 0.1,
                          .description = "of the pins, for their friction"},
                         {.name = "block",
                          .quantity = Quantity::length,
                          .default_text = "40mm",
                          .low = 1e-3,
                          .high = 1.0,
                          .description = "length of the slider in its guide, for its friction"}},
          .default_output = "results/slider_crank",
          .model = [](const Parameters& p, const WallLaws&) { return model_of(p); },
          .duration = [](const Parameters& p) { return 120.0 / p.number("speed"); },
          .checks = slider_crank_checks,
          .paths = {"rod"}};
}

}  // namespace yoke::cases
