// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Mechanisms that the tests of the analyses share.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <yoke/core/units.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/messages.hpp>

namespace yoke::tests {

using namespace yoke::literals;

struct SliderCrankOptions {
  double crank = 0.05, rod = 0.12;  // [m]
  double angle = 0.0;               // [rad] of the crank at the start
  double omega = 0.0;               // [rad/s] of the crank
  bool driven = true;
};

/// The slider-crank of reference case flores5000rpm, slider on y = 0.
inline Model slider_crank(const SliderCrankOptions& o) {
  Model m;
  const double beta = -std::asin(o.crank * std::sin(o.angle) / o.rod);
  const double beta_rate = -o.crank * std::cos(o.angle) * o.omega / (o.rod * std::cos(beta));
  const Vec2 pin = rotate(o.angle, {o.crank, 0.0}), arm = rotate(beta, {o.rod, 0.0});
  const Vec2 pin_rate = o.omega * perp(pin), arm_rate = beta_rate * perp(arm);
  const auto crank = m.add(Body{.name = "crank",
                                .mass = 0.30,
                                .inertia = 1e-5,
                                .pose = {0.5 * pin, o.angle},
                                .twist = {0.5 * pin_rate, o.omega}});
  const auto rod = m.add(Body{.name = "rod",
                              .mass = 0.21,
                              .inertia = 2.5e-5,
                              .pose = {pin + 0.5 * arm, beta},
                              .twist = {pin_rate + 0.5 * arm_rate, beta_rate}});
  const auto slider = m.add(Body{.name = "slider",
                                 .mass = 0.14,
                                 .inertia = 1e-4,
                                 .pose = {pin + arm, 0.0},
                                 .twist = {pin_rate + arm_rate, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "crank pin", .a = crank, .b = rod, .at = pin});
  m.add(Revolute{.name = "slider pin", .a = rod, .b = slider, .at = pin + arm});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  if (o.driven)
    m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(o.angle, o.omega)});
  return m;
}

/// A uniform link of 1 kg between two points.
inline BodyId add_link(Model& m, const std::string& name, const Vec2& from, const Vec2& to) {
  const Vec2 e = to - from;
  return m.add(Body{.name = name,
                    .mass = 1.0,
                    .inertia = e.squaredNorm() / 12.0,
                    .pose = {0.5 * (from + to), std::atan2(e.y(), e.x())}});
}

/// A four-bar: pivots at the origin and (d, 0), crank a at `angle`, coupler b, rocker c.
inline Model four_bar(double a, double b, double c, double d, double angle, double omega,
                      double branch = 1.0) {
  Model m;
  const Vec2 A(0.0, 0.0), B = rotate(angle, {a, 0.0}), D(d, 0.0);
  const double s = (D - B).norm(), x = (b * b - c * c + s * s) / (2.0 * s);
  const double y = branch * std::sqrt(b * b - x * x);
  const Vec2 e = (D - B) / s, C = B + x * e + y * perp(e);
  const auto crank = add_link(m, "crank", A, B);
  const auto coupler = add_link(m, "coupler", B, C);
  const auto rocker = add_link(m, "rocker", D, C);
  m.add(Revolute{.name = "A", .a = ground, .b = crank, .at = A});
  m.add(Revolute{.name = "B", .a = crank, .b = coupler, .at = B});
  m.add(Revolute{.name = "C", .a = coupler, .b = rocker, .at = C});
  m.add(Revolute{.name = "D", .a = ground, .b = rocker, .at = D});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(angle, omega)});
  return m;
}

/// Two bars of length L from (-b, h) and (b, h) to a node on a guide, each compressible with k: a
/// von Mises truss, pressed down by F [N].
inline Model truss(double b, double h, double k, double F, double start) {
  Model m;
  const auto node = m.add(
      Body{.name = "node", .mass = 0.1, .inertia = 1e-4 * b * b, .pose = {{0.0, start}, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = node, .along = {0.0, 1.0}});
  for (const double side : {-1.0, 1.0})
    m.add(TranslationalSpring{.name = side < 0.0 ? "left" : "right",
                              .a = ground,
                              .b = node,
                              .at_a = {side * b, 0.0},
                              .at_b = {0.0, start},
                              .stiffness = k,
                              .free_length = std::hypot(b, h)});
  m.add(AppliedForce{.name = "load", .body = node, .at = {0.0, start}, .force = [F](double) {
                       return Vec2(0.0, -F);
                     }});
  return m;
}
/// Its load at height y.
inline double truss_load(double b, double h, double k, double y) {
  return 2.0 * k * y * (std::hypot(b, h) / std::hypot(b, y) - 1.0);
}

}  // namespace yoke::tests
