// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The stabilised index-2 equations of Gear, Gupta and Leimkuhler and their exact iteration matrix.
//
//   R_q = M (q' - v) + G^T mu          unknowns y = (q, v, z, lambda, mu)
//   R_v = M v' + G^T lambda - Q
//   R_z = z' - f
//   R_p = Phi
//   R_w = G v + Phi_t
//
// Iteration matrix dR/dy + c dR/dy', with K(.) = d(G^T .)/dq and H = d(G v + Phi_t)/dq:
//
//        q                   v              z           lambda  mu
//   R_q  c M + K(mu)         -M             .           .       G^T
//   R_v  K(lambda) - Q_q     c M - Q_v      -Q_z        G^T     .
//   R_z  -f_q                -f_v           c I - f_z   .       .
//   R_p  G                   .              .           .       .
//   R_w  H                   G              .           .       .
//
// An equation that the system has dropped is replaced by lambda_i = 0, mu_i = 0.
#pragma once

#include <vector>

#include <yoke/integrators/iteration_matrix.hpp>

namespace yoke {

class GglMatrix {
 public:
  explicit GglMatrix(System& system);

  int size() const { return size_; }
  int v() const { return n_; }  // offsets of the parts of y
  int z() const { return 2 * n_; }
  int lambda() const { return 2 * n_ + nz_; }
  int mu() const { return 2 * n_ + nz_ + rows_; }

  /// R(t, y, y') [size]. False if it is not finite.
  bool calc_residual(double t, const double* y, const double* y_dot, double* residual);
  /// Fills the matrix for the shift c [1/s].
  void calc_jacobian(double t, double c, const double* y);
  /// Scales and factorises what calc_jacobian filled.
  bool factorise() { return matrix_.factorise(c_); }
  /// b := (matrix)^-1 b.
  void solve(double* b) { matrix_.solve(b); }
  void reset() { matrix_.reset(); }
  const FactorCounters& counters() const { return matrix_.counters(); }
  /// The unscaled matrix, for checks.
  const SparseMatrix& matrix() const { return matrix_.matrix(); }

 private:
  MatrixLayout layout() const;

  System& system_;
  int n_, nz_, rows_, size_;
  IterationMatrix matrix_;
  double c_ = 1.0;
  MultiplierMask lambda_, mu_;
  std::vector<double> force_, stabilisation_;  // [n + 1], the last for the ground
};

}  // namespace yoke
