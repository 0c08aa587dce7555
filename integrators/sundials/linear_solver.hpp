// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A direct linear solver of our own behind SUNDIALS' interface. SUNDIALS would set a sparse
// matrix's index arrays to zero before every Jacobian and could not scale it, so it sees a matrix
// without data and a solver that works on ours.
#pragma once

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

namespace yoke {

/// What the integrator calls, with `owner` as the first argument. `setup` and `solve` return 0,
/// or 1 for a matrix that is singular; `multiply` may be missing.
struct LinearSolverCalls {
  int (*setup)(void* owner) = nullptr;
  int (*solve)(void* owner, N_Vector x, N_Vector b) = nullptr;
  void (*multiply)(void* owner, N_Vector x, N_Vector product) = nullptr;
};

class OwnLinearSolver {
 public:
  OwnLinearSolver(void* owner, const LinearSolverCalls& calls, SUNContext context);
  ~OwnLinearSolver();
  OwnLinearSolver(const OwnLinearSolver&) = delete;
  OwnLinearSolver& operator=(const OwnLinearSolver&) = delete;

  SUNMatrix matrix() const { return matrix_; }
  SUNLinearSolver solver() const { return solver_; }

 private:
  void* owner_;
  LinearSolverCalls calls_;
  SUNMatrix matrix_;
  SUNLinearSolver solver_;
};

}  // namespace yoke
