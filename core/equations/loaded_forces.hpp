// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Accelerations where forces depend on the reactions they make (ForceElement::loaded_by), as friction
// of joints does. With x = (a, lambda), K the saddle matrix and b what does not depend on x:
//
//   K x = b + (Q(lambda), 0)
//   (K - (dQ/dlambda, 0)) x' = b + (Q - dQ/dlambda lambda, 0)      Newton's iteration from x to x'
//
// The matrix stays as sparse as K, so a chain with friction in every joint costs as much per joint as a
// short one; where K is solved by blocks in the range space, so is this (linear/range_space.hpp), and KLU solves it
// where that is not good enough. The iteration starts from the reactions without these forces, whatever was before:
// equal states give equal bits. Friction is linear in the load, or linear between corners, and the load is
// smooth but for corners: two to four rounds are usual.
//
// There may be no solution (friction that wedges, P. Painleve, C. R. Acad. Sci. Paris 1895, 121, 112-115),
// or several; with little friction there is one.
#pragma once

#include <optional>
#include <vector>

#include <yoke/core/equations/linear/range_space.hpp>
#include <yoke/core/equations/linear/saddle_solver.hpp>
#include <yoke/core/equations/system.hpp>

namespace yoke {

class LoadedForces {
 public:
  /// `saddle` solves with K. Rows of the system that are left out now must stay so.
  LoadedForces(System& system, SaddleSolver& saddle);

  /// x [dofs + rows] is the solution of K x = b by the present factors, and is made that with the forces. At the
  /// motion set last. False: there is none, and the system knows whose fault it is. Allocates nothing, but where
  /// KLU is needed for the first time or for new pivots.
  bool solve(const double* b, double* x);
  void reset();
  /// Of the matrix with dQ/dlambda, by blocks or by KLU.
  FactorCounters counters() const;

 private:
  /// K - dQ/dlambda for KLU.
  struct Whole {
    Whole(const SparseMatrix& saddle, const std::vector<LoadEntry>& entries, int dofs);
    std::vector<int> slots;  // of the entries of K, then of dQ/dlambda
    SparseMatrix matrix;
    SparseLU lu;
  };

  void find_entries();
  bool add_forces(const double* lambda);
  bool solve_linear();
  bool solve_by_klu();
  double size_of(int row, double multiplier) const;
  double error(const double* lambda) const;
  bool fail(const double* lambda);

  System& system_;
  SaddleSolver& saddle_;
  std::vector<LoadEntry> entries_;  // of dQ/dlambda, force by force
  std::vector<double> slope_;       // [entries]
  bool have_room_;                  // for them in the range space
  std::optional<Whole> whole_;      // made when it is needed
  std::vector<double> x_, right_, Q_;
  long by_blocks_ = 0;
};

}  // namespace yoke
