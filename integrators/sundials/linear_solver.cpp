// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/sundials/linear_solver.hpp>

namespace yoke {

namespace {

template <class Handle>
OwnLinearSolver& of(Handle handle) {
  return *static_cast<OwnLinearSolver*>(handle->content);
}

}  // namespace

OwnLinearSolver::OwnLinearSolver(void* owner, const LinearSolverCalls& calls, SUNContext context)
    : owner_(owner),
      calls_(calls),
      matrix_(SUNMatNewEmpty(context)),
      solver_(SUNLinSolNewEmpty(context)) {
  matrix_->content = this;
  matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix_->ops->zero = [](SUNMatrix) { return 0; };
  if (calls_.multiply != nullptr)
    matrix_->ops->matvec = [](SUNMatrix m, N_Vector x, N_Vector product) {
      of(m).calls_.multiply(of(m).owner_, x, product);
      return 0;
    };
  solver_->content = this;
  solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver_->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  solver_->ops->setup = [](SUNLinearSolver s, SUNMatrix) {
    return of(s).calls_.setup == nullptr ? 0 : of(s).calls_.setup(of(s).owner_);
  };
  solver_->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) {
    return of(s).calls_.solve(of(s).owner_, x, b);
  };
}

OwnLinearSolver::~OwnLinearSolver() {
  SUNLinSolFreeEmpty(solver_);
  SUNMatFreeEmpty(matrix_);
}

}  // namespace yoke
