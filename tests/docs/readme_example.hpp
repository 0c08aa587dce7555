// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// From the next line on: the program printed in README.md. documentation_test.cpp compares and
// runs.

#include <yoke/yoke.hpp>  // everything; or header by header, <yoke/joints/revolute.hpp>

using namespace yoke;
using namespace yoke::literals;

int main() {
  Model m;  // as it stands at t = 0: crank along x, pin in the middle of the slot, all in metres
  const BodyId crank = m.add({.name = "crank", .mass = 0.105_kg, .inertia = 77_kg_mm2});
  const BodyId slider = m.add({.name = "slider", .mass = 2.353_kg, .inertia = 3496_kg_mm2});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0, 0}});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(0_rad, 720_rpm)});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1, 0}});
  const Slot slot = arc_slot({.center = {105_mm, 0},
                              .radius = 60_mm,
                              .direction = 180_deg,
                              .angle = 120_deg,
                              .half_width = 8_mm});
  const ContactLaw steel{per_mm(4.907e4, 1.10), HuntCrossley{.alpha = 0.32_s_per_m}};
  m.add(PinInSlot{
      .name = "pin", .pin = {crank, {45_mm, 0}, 7.9_mm}, .slot = {slider, slot}, .law = steel});
  const Result run = simulate(m, {.until = 166.7_ms, .relative_tolerance = 1e-8});
  run.write("results/first");  // motion.csv, events.csv, summary.json
  return run.summary.ok() ? 0 : 1;
}
