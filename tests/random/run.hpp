// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A run of a described mechanism, in the coordinates and units of the original description.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include <yoke/core/result.hpp>
#include <yoke/tests/random/changes.hpp>

namespace yoke::tests::random {

struct RunOptions {
  std::string formulation = "arkode-projection";
  double tolerance = 1e-9;
  long most_steps = 20000;    // then the run is left off: not a fault, but counted
  double perturbation = 0.0;  // of the start, in lengths, radians and per time
};

struct Run {
  std::string refusal;              // what a ModelError said; empty: it ran
  Summary summary;                  // in the units of the model
  double length = 1.0, time = 1.0;  // [m, s] the scales of the error weights
  Eigen::MatrixXd q, v;             // a row a sample, x, y, angle of the bodies of the original
  Eigen::VectorXd t, balance;       // [s, J]
  double energy_scale = 0.0;        // [J] by which energy changes if all errs by one weight unit
  double position_violation = 0.0, velocity_violation = 0.0;  // in lengths or rad, and per time
  State end;

  bool ran() const { return refusal.empty(); }
  bool ok() const { return ran() && summary.ok(); }
};

constexpr int rows_of_a_run = 33;

Run run(const Changed& changed, const RunOptions& options);

/// For each sample the largest difference of positions (in `length`) and angles; with `rates`, of
/// velocities too (in lengths per time, rad per time).
Eigen::VectorXd difference(const Run& a, const Run& b, bool rates);

}  // namespace yoke::tests::random
