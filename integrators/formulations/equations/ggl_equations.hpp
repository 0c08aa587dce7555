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
//   R_v  K(lambda) - Q_q     c M - Q_v      -Q_z        G^T-Q_l .
//   R_z  -f_q                -f_v           c I - f_z   -f_l    .
//   R_p  G                   .              .           .       .
//   R_w  H                   G              .           .       .
//
// An equation that the system has left out is replaced by lambda_i = 0, mu_i = 0. Friction that holds
// has a row of velocity level only: R_w with its lambda_i, and mu_i = 0 for R_p; while it does not hold,
// lambda_i = 0 for R_w.
#pragma once

#include <vector>

#include <yoke/integrators/formulations/equations/dae_equations.hpp>
#include <yoke/integrators/formulations/equations/iteration_matrix.hpp>

namespace yoke {

class GglEquations final : public DaeEquations {
 public:
  explicit GglEquations(System& system);

  int size() const override { return size_; }
  int v() const override { return n_; }
  int z() const override { return 2 * n_; }
  int lambda() const override { return 2 * n_ + nz_; }
  int mu() const { return 2 * n_ + nz_ + rows_; }

  bool calc_residual(double t, const double* y, const double* y_dot, double* residual) override;
  void calc_jacobian(double t, double c, const double* y, const double* y_dot) override;
  bool factorise() override { return matrix_.factorise(c_); }
  void solve(double* b) override { matrix_.solve(b); }
  const FactorCounters& counters() const override { return matrix_.counters(); }
  void reset() { matrix_.reset(); }
  /// The unscaled matrix, for checks.
  const SparseMatrix& matrix() const { return matrix_.matrix(); }
  /// As KLU saw it last.
  const SparseMatrix& scaled() const { return matrix_.scaled(); }

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
