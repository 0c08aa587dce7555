// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A set of differential-algebraic equations R(t, y, y') = 0 with y = (q, v, z, lambda, ...), as an
// implicit integrator sees it. One file per set of equations; ida.cpp integrates them.
#pragma once

#include <yoke/core/equations/linear/sparse.hpp>

namespace yoke {

class DaeEquations {
 public:
  virtual ~DaeEquations() = default;

  virtual int size() const = 0;
  virtual int v() const = 0;  ///< offsets of the parts of y; q is at 0
  virtual int z() const = 0;
  virtual int lambda() const = 0;  ///< from here on y is algebraic

  /// R(t, y, y') [size]. False if it is not finite.
  virtual bool calc_residual(double t, const double* y, const double* y_dot, double* residual) = 0;
  /// Fills the matrix dR/dy + c dR/dy', c [1/s].
  virtual void calc_jacobian(double t, double c, const double* y, const double* y_dot) = 0;
  /// Scales and factorises what calc_jacobian filled.
  virtual bool factorise() = 0;
  /// b := (matrix)^-1 b.
  virtual void solve(double* b) = 0;
  virtual const FactorCounters& counters() const = 0;
};

}  // namespace yoke
