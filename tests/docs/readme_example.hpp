// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// From the next line on: the program printed in README.md. documentation_test.cpp compares and
// runs.

#include <yoke/yoke.hpp>  // or header by header: <yoke/joints/revolute.hpp>
using namespace yoke;
using namespace yoke::literals;

int main() {
  Model m;  // in global coordinates, as the mechanism stands at t = 0
  const BodyId crank = m.add({.name = "crank", .mass = 0.105_kg, .inertia = 77_kg_mm2});
  const BodyId slider = m.add({.name = "slider", .mass = 2.353_kg, .inertia = 3496_kg_mm2});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0, 0}});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(0_rad, 720_rpm)});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1, 0}});
  // Centre and radius of the arc, its direction and angle, half-width of the slot.
  const Slot slot = arc_slot({{105_mm, 0}, 60_mm, 180_deg, 120_deg, 8_mm});
  const Pin pin{.body = crank, .at = {45_mm, 0}, .radius = 7.9_mm};
  const ContactLaw steel{per_mm(4.907e4, 1.10), HuntCrossley{.alpha = 0.32_s_per_m}};
  m.add(PinInSlot{.name = "pin", .pin = pin, .slot = {slider, slot}, .law = steel});
  const Result run = simulate(m, {.until = 166.7_ms, .relative_tolerance = 1e-8});
  run.write("results/first");  // motion.csv, reactions.csv, ..., summary.json
  return run.summary.ok() ? 0 : 1;
}
