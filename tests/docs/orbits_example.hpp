// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in docs/orbits.md.
#pragma once

#include <cmath>

#include <yoke/yoke.hpp>

namespace orbits_example {

using namespace yoke;
using namespace yoke::literals;

// A rod that stands on its end, which is shaken up and down: it does not fall if that is fast enough.
Model standing_rod(double amplitude, double frequency) {
  Model m;
  const BodyId shoe = m.add({.name = "shoe", .mass = 0.1_kg, .inertia = 1e-5_kg_m2});
  const BodyId rod = m.add(
      {.name = "rod", .mass = 0.2_kg, .inertia = 1.5e-3_kg_m2, .pose = {{0.0, 150.0_mm}, 0.0}});
  m.add(Gravity{});
  m.add(Prismatic{.name = "guide", .a = ground, .b = shoe, .along = {0.0, 1.0}});
  m.add(Revolute{.name = "pin", .a = shoe, .b = rod});
  m.add(DisplacementDriver{.name = "shaker",
                           .body = shoe,
                           .along = {0.0, 1.0},
                           .displacement = time_function([=](auto t) {
                             using std::sin;
                             return amplitude * sin(2.0 * pi * frequency * t);
                           })});
  return m;
}

PeriodicOrbit upright(double amplitude) {
  const double frequency = 50.0;
  return periodic_orbit(standing_rod(amplitude, frequency), {.period = 1.0 / frequency});
}

// 0 if it is not told from none.
double rate_of_chaos(const Model& machine) {
  const Lyapunov l = lyapunov(machine, {.until = 20.0, .transient = 2.0});
  return l.complete && l.exponents[0] > 3.0 * l.uncertainty[0] ? l.exponents[0] : 0.0;
}

}  // namespace orbits_example
