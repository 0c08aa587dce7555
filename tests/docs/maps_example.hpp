// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code in docs/maps.md; maps_test.cpp compares the two.
#pragma once

#include <cmath>
#include <yoke/integrators/studies/maps/basins.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/prismatic.hpp>

namespace maps_example {

using namespace yoke;

// A driven oscillator with a hardening spring, x'' + 0.1 x' + x + x^3 = 0.5 cos(w t), [N], [m], [kg].
SectionedModel hardening(double w, double x = 0.0, double v = 0.0) {
  SectionedModel made;
  const BodyId mass = made.model.add({.name = "mass",
                                      .mass = 1.0,
                                      .inertia = 1.0,
                                      .pose = {{x, 0.0}, 0.0},
                                      .twist = {{v, 0.0}, 0.0}});
  made.model.add(Prismatic{.name = "guide", .a = ground, .b = mass});
  made.model.add(applied_force("spring", mass, {x, 0.0}, [w](auto t, const auto& b) {
    return vec(0.5 * cos(w * t) - 0.1 * b.vx - b.x - b.x * b.x * b.x, 0.0 * b.x);
  }));
  made.section = Section::every(2.0 * pi / w);
  made.model.add(made.section);
  made.start = made.model.start_state();
  return made;
}

// The points of one run.
Poincare points(double w) {
  const SectionedModel at = hardening(w);
  return poincare(at.model, at.start, at.section, {.discard = 60, .points = 10});
}

// Over the frequency, up and down: it jumps at different places.
Bifurcation diagram() {
  BifurcationOptions options{
      .map = {.columns = {"mass.x_m", "mass.vx_m_per_s"}, .discard = 60, .points = 4},
      .continuation = Continuation::both,
      .jobs = 2};
  return bifurcation([](double w) { return hardening(w); }, {1.2, 1.4, 1.7, 2.6}, options);
}

// Where it has two steady states: which starts lead to which.
Basins where_starts_lead() {
  BasinOptions options{
      .map = {.columns = {"mass.x_m", "mass.vx_m_per_s"}, .discard = 80, .points = 4}};
  options.study.jobs = 2;
  const StudyPoints grid =
      grid_points({linear_axis("x", -2.0, 2.0, 4, "m"), linear_axis("v", -2.0, 2.0, 4, "m/s")});
  return basins([](const StudyPoint& p) { return hardening(1.7, p["x"], p["v"]); }, grid, options);
}

}  // namespace maps_example
