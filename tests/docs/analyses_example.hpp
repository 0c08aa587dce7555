// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in docs/analyses.md.
#pragma once

#include <yoke/yoke.hpp>

namespace analyses_example {

using namespace yoke;

Eigen::VectorXd slider_acceleration(const Model& driven) {
  const Result run = kinematics(driven, {.until = 0.012, .samples = 25});
  for (const SingularPosition& p : run.summary.singular_positions)
    fmt::print("nearly singular at {} s: {}\n", p.t, p.equation);
  return run["slider.ax_m_per_s2"];
}

double largest_torque(const Model& driven) {
  const Result run = inverse_dynamics(driven, {.until = 0.012, .samples = 25});
  return run["motor.moment_N_m"].cwiseAbs().maxCoeff();
}

Eigen::VectorXd torque_needed(const Model& model, const Result& motion) {
  return inverse_dynamics(model, motion.samples, {{.body = "crank"}})["crank.angle.drive_N_m"];
}

double lowest_frequency(const Model& model) {
  const Equilibrium rest = equilibrium(model);
  if (!rest.found || !rest.stable) return 0.0;
  return modes(model, rest.state).modes.front().frequency;
}

double pivot_force(const Model& model, const Result& run, double t) {
  const Recovery then = recover(model, run.samples, t);
  return std::hypot(then["pivot.fx_N"], then["pivot.fy_N"]);
}

std::vector<double> buckling_loads(const Model& model, double load) {
  const EquilibriumPath path = equilibrium_path(model, {.from = 0.0, .to = 1.0});
  if (!path.complete) fmt::print("{}\n", path.reason);
  std::vector<double> loads;
  for (const CriticalPoint& point : path.critical)
    if (point.kind == PathPoint::limit) loads.push_back(point.value * load);
  return loads;
}

}  // namespace analyses_example
