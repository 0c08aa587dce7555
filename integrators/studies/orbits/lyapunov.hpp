// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Lyapunov exponents: the mean rates at which motions beside a run part from it, by the variational
// equations through events (variation.hpp), made orthonormal again at intervals (Benettin). A positive one
// is chaos; an autonomous motion that does not end at rest has one that is zero; the sum of all is the mean
// rate at which volumes grow, zero of a conservative mechanism.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include <yoke/integrators/simulate.hpp>

namespace yoke {

/// How they are measured.
struct LyapunovOptions {
  double until = 0.0;      // [s] end of the run
  double transient = 0.0;  // [s] of the run that does not count: variations turn to what grows most
  /// [s] between orthonormalisations, at ends of steps; 0: a thousandth of the run.
  double interval = 0.0;
  int exponents = 1;  // the largest; 0: all, 2 f + nz
  /// Of the run; `until` is the one above. An exponent wants less accuracy than an orbit.
  SimulationOptions run{.relative_tolerance = 1e-9, .samples = 0};
};

/// Exponents, and how far they can be trusted.
struct Lyapunov {
  bool complete = false;      // the run came to its end
  std::string reason;         // a sentence; what there is up to there is given
  Eigen::VectorXd exponents;  // [k] [1/s], falling
  /// [k] [1/s] Standard error of the mean of ten stretches of the run; nan from fewer than ten intervals.
  Eigen::VectorXd uncertainty;
  /// Mean over the time since the transient, a row an interval: t_s, exponent_1_per_s, ...
  Table history;
  /// [1/s] Mean trace of the linear equations: what all exponents add up to, where events change neither
  /// velocities nor states, and no force depends on what contacts remember.
  double mean_trace = 0.0;
  int degrees_of_freedom = 0;      // f
  long jumps = 0;                  // events that variations passed
  Result run;                      // along which they were measured
  std::vector<std::string> notes;  // what was assumed, a sentence each
};

/// Along the run from `start`. Throws ModelError for options out of range and as flow_derivative().
Lyapunov lyapunov(const Model& model, const State& start, const LyapunovOptions& options);
/// From the model's own start.
Lyapunov lyapunov(const Model& model, const LyapunovOptions& options);

}  // namespace yoke
