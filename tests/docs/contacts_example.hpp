// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code of docs/contacts.md.
#pragma once

#include <cmath>
#include <vector>

// clang-format off
#include <yoke/yoke.hpp>
// clang-format on

namespace yoke::contacts_example {

using namespace yoke::literals;

// A cam with a flat at its end, traced by points; a lever's slot as a path; a wavy track.
Curve cam_through(const std::vector<Vec2>& points) {
  return curve_through(points, {.closed = true});
}

Curve lever_slot() {
  return polyline({{0.0, 0.0}, {60.0_mm, 0.0}, {90.0_mm, 40.0_mm}}, {.fillet = 25.0_mm});
}

Curve wave() {
  return curve_of([](double u) { return Vec2(u, 5.0_mm * std::sin(40.0 * u)); }, 0.0, 0.2);
}

// A pin in a slot that is closed by a round end at its start and open at the other.
Model latch(const ContactLaw& law) {
  Model m;
  const BodyId lever =
      m.add({.name = "lever", .mass = 0.4, .inertia = 6e-4, .pose = {{45.0_mm, 10.0_mm}, 0.0}});
  const BodyId pin =
      m.add({.name = "pin", .mass = 0.05, .inertia = 1e-6, .pose = {{20.0_mm, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = lever, .at = {0.0, -20.0_mm}});
  m.add(PinInSlot{.name = "slot",
                  .pin = {pin, {20.0_mm, 0.0}, 3.9_mm},
                  .slot = {lever, curve_slot({.centreline = lever_slot(),
                                              .half_width = 4.0_mm,
                                              .end = SlotEnd::open,
                                              .edge_radius = 0.5_mm})},
                  .law = law});
  m.add(Gravity{});
  return m;
}

// A law that takes the radius of each wall.
auto by_radius(double pin_radius) {
  return [pin_radius](const SlotWall& wall) {
    const double flat = 1e-3;  // [1/m]: on a plane Johnson's law has no bound
    const bool straight = std::abs(wall.curvature) < flat;
    const RoundPair pair = pair_of(pin_radius, straight ? flat : wall.curvature);
    return ContactLaw{johnson(pair, 10.0_mm), HuntCrossley{0.3}};
  };
}

// A roller on an oval cam: its stiffness follows the radius of the cam, or is that of its mean radius.
DiscOnCurve roller_on_cam(BodyId roller, BodyId cam, const Vec2& at, Radii radii) {
  const Curve oval =
      curve_of([](double t) { return Vec2(40.0_mm * std::cos(t), 25.0_mm * std::sin(t)); }, 0.0,
               2.0 * pi, {.closed = true});
  return {.name = "cam",
          .disc = {roller, at, 8.0_mm},
          .body = cam,
          .curve = oval,
          .side = CurveSide::right,
          .law = {by_radius(8.0_mm), radii}};
}

// A ball between a floor and a belt, and beside another ball.
void add_contacts(Model& m, BodyId ball, BodyId other, const ContactLaw& law) {
  const Vec2 at{0.0, 10.0_mm}, beside{25.0_mm, 10.0_mm};
  m.add(DiscOnCurve{.name = "floor",
                    .disc = {ball, at, 10.0_mm},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = law});
  m.add(DiscOnCurve{.name = "step",
                    .disc = {other, beside, 10.0_mm},
                    .body = ground,
                    .curve = polyline({{-1.0, 0.0}, {50.0_mm, 0.0}, {50.0_mm, -20.0_mm}}),
                    .law = law});
  m.add(DiscOnDisc{
      .name = "balls", .disc = {ball, at, 10.0_mm}, .other = {other, beside, 10.0_mm}, .law = law});
}

// A slider-crank whose rod turns on the slider's pin with or without clearance.
Model slider_crank(std::optional<Clearance> clearance) {
  Model m;
  const BodyId crank =
      m.add({.name = "crank", .mass = 0.3, .inertia = 1e-5, .pose = {{25.0_mm, 0.0}, 0.0}});
  const BodyId rod =
      m.add({.name = "rod", .mass = 0.2, .inertia = 3e-5, .pose = {{110.0_mm, 0.0}, 0.0}});
  const BodyId slider =
      m.add({.name = "slider", .mass = 0.1, .inertia = 1e-5, .pose = {{170.0_mm, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "crank pin", .a = crank, .b = rod, .at = {50.0_mm, 0.0}});
  m.add(Revolute{
      .name = "slider pin", .a = rod, .b = slider, .at = {170.0_mm, 0.0}, .clearance = clearance});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = smooth_ramp(0.0, 30.0, 0.1)});
  return m;
}

Model ideal() { return slider_crank({}); }

Model real(const ContactLaw& law) {
  return slider_crank(BearingClearance{.journal_radius = 10.0_mm, .radial = 0.1_mm, .law = law});
}

}  // namespace yoke::contacts_example
