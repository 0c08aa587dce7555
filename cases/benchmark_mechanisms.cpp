// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/benchmark_mechanisms.hpp>

#include <cmath>

#include <yoke/core/units.hpp>
#include <yoke/joints/distance.hpp>
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

/// A uniform rod of 1 m and 1 kg along x.
Body rod(const char* name, double from) {
  return {.name = name, .mass = 1.0, .inertia = 1.0 / 12.0, .pose = {{from + 0.5, 0.0}, 0.0}};
}

struct Link {
  double length, mass, inertia;
};

/// All links along x, the crank turning at `omega`, the slider at rest.
Model slider_crank(const Link& crank, const Link& rod, const Link& slider, double omega) {
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
  const BodyId third = m.add(Body{
      .name = "slider", .mass = slider.mass, .inertia = slider.inertia, .pose = {{end, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = first, .at = origin});
  m.add(Revolute{.name = "crank pin", .a = first, .b = second, .at = {l1, 0.0}});
  m.add(Revolute{.name = "slider pin", .a = second, .b = third, .at = {end, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = third, .along = {1.0, 0.0}});
  return m;
}

}  // namespace

Model point_pendulum() {
  Model m;  // the mass does not turn; its inertia plays no part
  const BodyId mass =
      m.add(Body{.name = "mass", .mass = 1.0, .inertia = 1.0, .pose = {{1.0, 0.0}, 0.0}});
  m.add(Distance{.name = "rod", .a = ground, .b = mass, .at_a = origin, .at_b = {1.0, 0.0}});
  m.add(Gravity{});
  return m;
}

Model rod_pendulum() {
  Model m;
  const BodyId b = m.add(rod("rod", 0.0));
  m.add(Revolute{.name = "pivot", .a = ground, .b = b, .at = origin});
  m.add(Gravity{});
  return m;
}

Model double_pendulum() {
  Model m;
  const BodyId a = m.add(rod("a", 0.0)), b = m.add(rod("b", 1.0));
  m.add(Revolute{.name = "pivot", .a = ground, .b = a, .at = origin});
  m.add(Revolute{.name = "elbow", .a = a, .b = b, .at = {1.0, 0.0}});
  m.add(Gravity{});
  return m;
}

Model free_slider_crank() {
  Model m =
      slider_crank({0.153, 0.038, 7.4e-5}, {0.306, 0.038, 5.9e-4}, {0.0, 0.076, 2.7e-6}, 150.0);
  m.add(Gravity{});
  return m;
}

Model driven_slider_crank() {
  const double omega = 5000.0_rpm;
  Model m = slider_crank({0.05, 0.30, 1e-5}, {0.12, 0.21, 2.5e-5}, {0.0, 0.14, 1e-4}, omega);
  m.add(AngleDriver{
      .name = "motor", .body = m.find_body("crank"), .angle = constant_speed(0.0, omega)});
  return m;
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

Model car_axis() {
  const double L = 1.0, L0 = 0.5, mass = 10.0 * 1e-2 * 1e-2 / 2.0;
  const Vec2 left_start(0.0, L0), right_start(L, L0);
  Model m;
  const BodyId road =
      m.add(Body{.name = "road", .mass = mass, .inertia = mass, .twist = {{0.0, 0.0}, 1.0}});
  const auto wheel = [&](const char* name, const Vec2& at) {
    return m.add(Body{.name = name,
                      .mass = mass,
                      .inertia = mass,
                      .pose = {at, 0.0},
                      .twist = {{-L0 / L, 0.0}, 0.0}});
  };
  const BodyId left = wheel("left", left_start), right = wheel("right", right_start);
  m.add(Revolute{.name = "foot", .a = ground, .b = road, .at = origin});
  // The right end of the axle is lifted by y_b = 0.1 sin(10 t), its left one stays: sin(angle) =
  // y_b
  m.add(AngleDriver{.name = "bump", .body = road, .angle = time_function([](auto t) {
                                                    return asin(0.1 * sin(10.0 * t));
                                                  })});
  const auto spring = [&](const char* name, BodyId body, const Vec2& from, const Vec2& to) {
    m.add(TranslationalSpring{.name = name,
                              .a = road,
                              .b = body,
                              .at_a = from,
                              .at_b = to,
                              .stiffness = 1.0,
                              .free_length = L0});
  };
  spring("left spring", left, origin, left_start);
  spring("right spring", right, {L, 0.0}, right_start);
  // The left mass is held square to the axle, the right one only by the rod.
  m.add(PointOnLine{.name = "guide",
                    .a = left,
                    .at = left_start,
                    .b = road,
                    .through = origin,
                    .along = {0.0, 1.0}});
  m.add(Distance{.name = "rod", .a = left, .b = right, .at_a = left_start, .at_b = right_start});
  m.add(Gravity{.acceleration = {0.0, -1.0}});
  return m;
}

}  // namespace yoke::cases
