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
// short one. The iteration starts from the reactions without these forces, whatever was before: equal
// states give equal bits. Friction is linear in the load, or linear between corners, and the load is
// smooth but for corners: two to four rounds are usual.
//
// There may be no solution (friction that wedges, P. Painleve, C. R. Acad. Sci. Paris 1895, 121, 112-115),
// or several; with little friction there is one.
#pragma once

#include <vector>

#include <yoke/core/equations/linear/sparse.hpp>
#include <yoke/core/equations/system.hpp>

namespace yoke {

class LoadedForces {
 public:
  /// `saddle`: the pattern of K. Rows of the system that are left out now must stay so.
  LoadedForces(System& system, const SparseMatrix& saddle);

  /// x [dofs + rows] is the solution of K x = b, and is made that with the forces. At the motion set last.
  /// False: there is none, and the system knows whose fault it is. Allocates nothing.
  bool solve(const SparseMatrix& saddle, const double* b, double* x);
  void reset() { lu_.reset(); }
  const FactorCounters& counters() const { return lu_.counters(); }

 private:
  static SparseMatrix pattern(const System& system, const SparseMatrix& saddle,
                              std::vector<int>& slots);
  void start(const SparseMatrix& saddle, const double* b);
  bool add_forces(const double* lambda);
  double size_of(int row, double multiplier) const;
  double error(const double* lambda) const;
  bool fail(const double* lambda);

  System& system_;
  std::size_t first_slope_;
  std::vector<int> slots_;  // of the entries of K, then of dQ/dlambda of each force
  SparseMatrix matrix_;
  SparseLU lu_;
  std::vector<double> x_, Q_, slope_;
};

}  // namespace yoke
