// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Is it stability that bounds the steps of an explicit method, not accuracy? Seen from two stages at the
// end of a step, without an evaluation (Hairer, Wanner, Solving Ordinary Differential Equations II,
// IV.2): where y differs between them it does so along what the method hardly damps.
#pragma once

#include <cstddef>
#include <vector>

namespace yoke {

class StabilityWatch {
 public:
  /// Of y = (q [dofs], v [dofs], z, ...), as many as there are `weights`: one over the tolerance of each.
  StabilityWatch(std::vector<double> weights, int dofs);
  /// What a step times a rate may be.
  void bound(double stable) { stable_ = stable; }
  void begin_step() { seen_ = found_ = false; }
  /// A stage; `y_dot` stays where it is until the next one.
  void see(double t, const double* y, const double* y_dot);
  /// The step was accepted, with a length of h [s].
  void end_step(double h);
  /// Has that been so in most of the last steps?
  bool bounds_steps() const { return bounded_ >= enough; }

 private:
  static constexpr int enough = 15;

  double rate_between(const double* y, const double* y_dot) const;

  std::vector<double> weights_, y_;
  std::size_t n_;
  const double* y_dot_ = nullptr;
  double t_ = 0.0, stable_ = 0.0;
  double rate_ = 0.0;  // [1/s] by the last two stages at one time
  bool seen_ = false, found_ = false;
  int bounded_ = 0, free_ = 0;  // steps
};

}  // namespace yoke
