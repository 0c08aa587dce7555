// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A slider-crank at constant speed; the piston's position has a closed form.
#include <cmath>
#include <cstdio>
#include <yoke/core/units.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

using namespace yoke;
using namespace yoke::literals;

int main() {
  const double r = 30_mm, l = 100_mm, speed = 600_rpm;
  const Vec2 origin{0.0, 0.0}, crank_pin{r, 0.0}, piston_pin{r + l, 0.0};
  Model m;
  const BodyId crank = m.add({.name = "crank", .mass = 200_g, .inertia = 90_kg_mm2});
  const BodyId rod = m.add({.name = "rod",
                            .mass = 80_g,
                            .inertia = 70_kg_mm2,
                            .pose = {.position = 0.5 * (crank_pin + piston_pin)}});
  const BodyId piston = m.add(
      {.name = "piston", .mass = 120_g, .inertia = 30_kg_mm2, .pose = {.position = piston_pin}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = origin});
  m.add(Revolute{.name = "crank_pin", .a = crank, .b = rod, .at = crank_pin});
  m.add(Revolute{.name = "piston_pin", .a = rod, .b = piston, .at = piston_pin});
  m.add(Prismatic{.name = "bore", .a = ground, .b = piston, .along = {1.0, 0.0}});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(0.0, speed)});

  const Result run = simulate(m, {.until = 120_ms, .relative_tolerance = 1e-10});
  const double phi = speed * run.final.t, y = r * std::sin(phi);
  const double x = r * std::cos(phi) + std::sqrt(l * l - y * y);
  const double error = run["piston.x_m"].tail(1)[0] - x;
  std::printf("%s: piston at %.6f mm, closed form %.6f mm\n", run.summary.reason.c_str(),
              1e3 * (x + error), 1e3 * x);
  return run.summary.ok() && std::abs(error) < 1e-12 ? 0 : 1;
}
