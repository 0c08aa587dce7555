// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Mechanisms that several tests run.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/units.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::tests {

using namespace yoke::literals;

/// Those of high order.
inline const std::string both_formulations[] = {"arkode-projection", "ida-ggl", "cvode-projection",
                                                "ida-baumgarte"};
/// With the one of order 2, where nothing is asked that only order 5 can give.
inline const std::vector<std::string> every_formulation = [] {
  std::vector<std::string> names;
  for (const FormulationNote& f : formulations()) names.emplace_back(f.name);
  return names;
}();

/// Two uniform rods of 1 m and 1 kg in a row, horizontal, at rest, g = 9.81; at `origin`, the whole
/// thing having been turned `turns` times before the start.
inline Model double_pendulum(const Vec2& origin = Vec2::Zero(), int turns = 0) {
  Model m;
  const double angle = 2.0 * pi * turns;
  const auto a = m.add(Body{
      .name = "a", .mass = 1.0, .inertia = 1.0 / 12.0, .pose = {origin + Vec2(0.5, 0.0), angle}});
  const auto b = m.add(Body{
      .name = "b", .mass = 1.0, .inertia = 1.0 / 12.0, .pose = {origin + Vec2(1.5, 0.0), angle}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = a, .at = origin});
  m.add(Revolute{.name = "elbow", .a = a, .b = b, .at = origin + Vec2(1.0, 0.0)});
  m.add(Gravity{.name = "gravity", .acceleration = {0.0, -9.81}});
  return m;
}

struct YokeOptions {
  double crank_length = 45.0_mm;
  double start_angle = -31.0_deg;  // [rad] whole turns may be added
  double alpha = 0.32;             // [s/m]
  Vec2 origin{0.0, 0.0};
  double inner = 4.914e4, outer = 4.907e4;  // [N/mm^n] of the walls
  double n = 1.10;
};

/// The paper's scotch-yoke with Johnson's column of Table 11 (outer and inner walls, caps).
inline Model scotch_yoke(const YokeOptions& o, const DissipativeLaw& dissipation) {
  const double r = o.crank_length, R = 60.0_mm, omega = 24.0 * pi, phi = o.start_angle;
  const double root = std::sqrt(R * R - std::pow(r * std::sin(phi), 2));
  const double X = r * std::cos(phi) + root;
  const double speed = -r * std::sin(phi) * (1.0 + r * std::cos(phi) / root) * omega;
  Model m;
  const auto crank = m.add(Body{.name = "crank",
                                .mass = 0.105_kg,
                                .inertia = 30.40_kg_mm2,
                                .pose = {o.origin, phi},
                                .twist = {{0.0, 0.0}, omega}});
  const auto slider = m.add(Body{.name = "slider",
                                 .mass = 2.353_kg,
                                 .inertia = 3495.6_kg_mm2,
                                 .pose = {o.origin + Vec2(X, 0.0), 0.0},
                                 .twist = {{speed, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = o.origin});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(phi, omega)});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  const auto law = [&](double K, double n) { return ContactLaw{per_mm(K, n), dissipation}; };
  m.add(PinInSlot{.name = "slot",
                  .pin = {crank, o.origin + rotate(phi, Vec2(r, 0.0)), 7.9_mm},
                  .slot = {slider, arc_slot({.center = o.origin + Vec2(X, 0.0),
                                             .radius = R,
                                             .direction = pi,
                                             .angle = 120.0_deg,
                                             .half_width = 8.0_mm})},
                  .law = {law(o.inner, o.n), law(o.outer, o.n), law(3.147e5, 1.28)}});
  return m;
}
inline Model scotch_yoke(const YokeOptions& o = {}) {
  return scotch_yoke(o, HuntCrossley{o.alpha});
}
inline constexpr double yoke_period = 2.0 * pi / (24.0 * pi);  // [s]

}  // namespace yoke::tests
