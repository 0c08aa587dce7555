// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The one place that solves
//
//   [ M  G^T ] [ a      ]   [ Q     ]
//   [ G  0   ] [ lambda ] = [ gamma ]
//
// KLU on this matrix is the solver of record; elimination in the range space is faster and used where it
// is as accurate, by its own account.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <yoke/core/equations/linear/linear_solver.hpp>
#include <yoke/core/equations/linear/saddle_layout.hpp>
#include <yoke/core/equations/linear/sparse.hpp>

namespace yoke {

class RangeSpace;

class SaddleSolver {
 public:
  /// What `layout` points to must outlive it.
  SaddleSolver(SaddleLayout layout, LinearSolver choice);
  ~SaddleSolver();

  /// With the blocks `G`, without the rows marked in `dropped` [rows]. False: singular, or a number is
  /// not finite.
  bool factorise(const double* G, std::span<const char> dropped);
  /// In place, b [dofs + rows]. Call after a successful factorise(); the blocks may have changed since.
  void solve(double* b);
  /// The same for Q = 0 and accelerations alone, up to about 1e-10 of the largest: a correction, after which is
  /// seen what is left to correct.
  void solve_nearly(double* b);
  /// The saddle matrix with these blocks; its pattern never changes.
  const SparseMatrix& matrix(const double* G, std::span<const char> dropped);
  /// Forgets pivots: equal inputs give equal bits from here.
  void reset();
  /// Are the equations far from dependent, by the last factorise()?
  bool well_conditioned() const;
  const FactorCounters& counters() const { return counters_; }
  /// What is used as long as it is accurate.
  LinearSolver in_use() const;
  /// What eliminates in the range space, or null.
  RangeSpace* range() { return range_.get(); }
  /// Are the present factors its?
  bool by_range() const { return by_range_; }

 private:
  struct Stamp {
    int entry;  // in the blocks of G
    int lower;  // slot of G
    int upper;  // slot of G^T
  };
  void build_matrix();
  void choose(LinearSolver choice);
  bool factorise_by_klu(const double* G, std::span<const char> dropped);
  bool leave_range();
  SparseLU& klu();

  SaddleLayout layout_;
  std::unique_ptr<RangeSpace> range_;
  bool range_is_klu_ = false;
  bool by_range_ = false;  // are the present factors its?
  SparseMatrix matrix_;    // and what follows: made when it is needed
  std::vector<Stamp> stamps_;
  std::vector<int> switch_diagonal_;  // slots of the rows that count at times
  std::optional<SparseLU> lu_;
  std::vector<double> G_;      // blocks that the range space gave back
  std::vector<char> dropped_;  // the same
  FactorCounters counters_;
};

}  // namespace yoke
