// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The iteration matrix of formulations at acceleration level, with multipliers as unknowns of their
// own so that it stays sparse. Unknowns (q, v, z, lambda), time derivatives replaced by c times the
// unknown; H = d(G v + Phi_t)/dq, K(lambda) = d(G^T lambda)/dq, H(a) likewise at the accelerations:
//
//        q                              v                       z         lambda
//   R_q  c I                            -I                      .         .
//   R_v  K(lambda) - Q_q                c M - Q_v               -Q_z      G^T - Q_l
//   R_z  -f_q                           -f_v                    c I - f_z -f_l
//   R_l  H(a) + 2 alpha H + beta^2 G    (c + 2 alpha) G + 2 H   .         .
//
// R_l is G v' - gamma + 2 alpha (G v + Phi_t) + beta^2 Phi. What is left out is the change of the
// convective term gamma with the position (third derivatives of Phi, times v v): against c^2 G it
// is as small as the square of the angle turned within a step, and Newton's iteration, which keeps
// its matrix over many steps anyway, does not notice. It has no say in the result. Nor has the part of
// d(gamma)/dv that is not 2 H in rows of friction that holds, whose G is no gradient.
#pragma once

#include <yoke/integrators/formulations/equations/iteration_matrix.hpp>

namespace yoke {

class AccelerationMatrix {
 public:
  explicit AccelerationMatrix(System& system, const Baumgarte& stabilisation = {});

  int size() const { return matrix_.size(); }
  int v() const { return n_; }
  int z() const { return 2 * n_; }
  int lambda() const { return 2 * n_ + nz_; }

  /// Fills the matrix for the shift c [1/s] at q, v, z, lambda and accelerations a.
  void evaluate(double t, double c, const double* q, const double* v, const double* z,
                const double* lambda, const double* a);
  bool factorise() { return matrix_.factorise(c_); }
  void solve(double* b) { matrix_.solve(b); }
  const FactorCounters& counters() const { return matrix_.counters(); }
  const SparseMatrix& matrix() const { return matrix_.matrix(); }
  /// As KLU saw it last.
  const SparseMatrix& scaled() const { return matrix_.scaled(); }

 private:
  MatrixLayout layout() const;

  int n_, nz_, rows_;
  Baumgarte stabilisation_;
  IterationMatrix matrix_;
  double c_ = 1.0;
  MultiplierMask lambda_;
};

}  // namespace yoke
