// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The saddle matrix of the constraints in a metric W of the coordinates,
//
//   [ 1   A^T ]      A = D^-1 G W^-1/2, D such that every row of A has the length 1
//   [ A  -mu  ]
//
// With W = metric_of_masses() its solutions are the nearest admissible motions, with
// W = metric_of_lengths() it knows nothing of masses. mu > 0 keeps it regular where equations are
// dependent.
#pragma once

#include <memory>
#include <vector>

#include <yoke/core/equations/linear/sparse.hpp>
#include <yoke/core/equations/system.hpp>

namespace yoke {

class ScaledSaddle {
 public:
  /// `weights` [dofs] > 0. Coordinates marked in `held` [dofs] and equations marked in `ignored`
  /// [rows] are left out. Empty: none.
  ScaledSaddle(const System& system, std::vector<double> weights, std::vector<char> held = {},
               std::vector<char> ignored = {});

  /// With the blocks of G computed last. False: singular or not finite.
  bool factorise(double mu);
  void solve(double* x) { lu_->solve(x); }  ///< [dofs + rows], in place
  bool holds(int dof) const { return held_[static_cast<std::size_t>(dof)] != 0; }
  bool ignores(int row) const { return ignored_[static_cast<std::size_t>(row)] != 0; }
  /// 1/D of a row after factorise(); 0 for one that depends on no coordinate.
  double row_scale(int row) const { return row_scale_[static_cast<std::size_t>(row)]; }
  double root_weight(int dof) const { return root_[static_cast<std::size_t>(dof)]; }  ///< W^1/2

 private:
  struct Stamp {
    int entry, row, dof, lower, upper;
  };
  const System& system_;
  std::vector<double> root_;
  std::vector<char> held_, ignored_;
  SparseMatrix matrix_;
  std::vector<Stamp> stamps_;
  std::vector<int> diagonal_;
  std::vector<double> row_scale_;
  std::unique_ptr<SparseLU> lu_;
};

/// [dofs] masses and inertias; for a body without one of them next to nothing of those of its own
/// assembly, which others do not change.
std::vector<double> metric_of_masses(const System& system);
/// [dofs] 1 for x and y, the square of the body's arm for its angle: how far from its centre its
/// joints are at the model's start pose. Rank and its loss are measured in this metric: it depends
/// on neither masses, units nor the frame. Evaluates the constraints at the start pose.
std::vector<double> metric_of_lengths(System& system);

}  // namespace yoke
