// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The smallest change of positions or velocities that satisfies the constraints, also where these
// are dependent or the pose is far away: Levenberg and Marquardt's damped steps
//
//   [ W   G^T ] [ d ]   [  0   ]      rows of G normalised to 1 in the metric of W, mu > 0: never
//   [ G  -mu  ] [ . ] = [ -Phi ]      singular
//
// For set-up; not a hot path.
#pragma once

#include <vector>

#include <yoke/core/equations/scaled_saddle.hpp>

namespace yoke {

class LeastChange {
 public:
  /// `weights` [dofs] > 0; coordinates marked in `held` [dofs] do not change, equations marked in
  /// `ignored` [rows] need not be satisfied. Empty: none.
  LeastChange(System& system, std::vector<double> weights, std::vector<char> held = {},
              std::vector<char> ignored = {});

  /// Moves q to a pose on the constraints, near where it was. False: the residual stays; q is then
  /// where it is smallest nearby, see worst_row(), residual() and norm().
  bool solve_positions(double t, double* q);
  /// Changes v as little as possible so that G v + Phi_t = 0 at (t, q). False: impossible.
  bool solve_velocities(double t, const double* q, double* v);
  /// Removes from d [dofs] what the constraints at the pose evaluated last forbid.
  void make_admissible(double* d);

  int worst_row() const { return worst_row_; }
  /// Residual of every row at the end, [m, rad] or per s.
  const std::vector<double>& residual() const { return residual_; }
  double norm() const { return norm_; }  ///< of the positions, in length scales or rad

 private:
  void evaluate(double t, const double* q);
  double merit() const;
  bool factorise_lightly();
  void step(const double* residual);  // into x_
  double largest_residual();
  double size(int row) const;

  System& system_;
  ScaledSaddle saddle_;
  std::vector<double> residual_, x_, zero_;
  int worst_row_ = 0;
  double norm_ = 0.0;
};

}  // namespace yoke
