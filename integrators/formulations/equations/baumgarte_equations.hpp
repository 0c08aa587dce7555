// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The index-1 equations, stabilised after Baumgarte (1972), by BDF; y = (q, v, z, lambda):
//
//   R_q = q' - v
//   R_v = M v' + G^T lambda - Q
//   R_z = z' - f
//   R_l = G v' - gamma + 2 alpha (G v + Phi_t) + beta^2 Phi,      alpha = beta: critical damping
//
// The gains are constants of the run: gains that change with the step would spoil a multistep
// method.
#pragma once

#include <vector>

#include <yoke/integrators/formulations/equations/acceleration_matrix.hpp>
#include <yoke/integrators/formulations/equations/dae_equations.hpp>

namespace yoke {

class BaumgarteEquations final : public DaeEquations {
 public:
  BaumgarteEquations(System& system, const Baumgarte& stabilisation);

  int size() const override { return matrix_.size(); }
  int v() const override { return matrix_.v(); }
  int z() const override { return matrix_.z(); }
  int lambda() const override { return matrix_.lambda(); }

  bool calc_residual(double t, const double* y, const double* y_dot, double* residual) override;
  void calc_jacobian(double t, double c, const double* y, const double* y_dot) override;
  bool factorise() override { return matrix_.factorise(); }
  void solve(double* b) override { matrix_.solve(b); }
  const FactorCounters& counters() const override { return matrix_.counters(); }
  /// The unscaled matrix, for checks.
  const SparseMatrix& matrix() const { return matrix_.matrix(); }

 private:
  void calc_constraint_residual(const double* y_dot, double* r_l);

  System& system_;
  int n_, nz_;
  Baumgarte stabilisation_;
  AccelerationMatrix matrix_;
  MultiplierMask lambda_;
  std::vector<double> force_;  // [n + 1], the last for the ground
  std::vector<double> phi_, phi_dot_;
};

}  // namespace yoke
