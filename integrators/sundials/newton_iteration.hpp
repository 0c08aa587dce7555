// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// SUNDIALS' Newton iteration for IDA with one change of its test of convergence. IDA calls an
// iteration diverged whose correction is not smaller than the one before, also if both are far below
// the tolerance and only rounding is left to correct. Where a tolerance is close to rounding it then
// shortens the step for ever, although every first iterate was good enough. What IDA also does, to
// distrust its estimate of the rate after any change of the step, is left out: ida.cpp makes the
// matrix anew after a small one, which starts the estimate again.
#pragma once

#include <sundials/sundials_nonlinearsolver.h>

namespace yoke {

class NewtonIteration {
 public:
  NewtonIteration(N_Vector like, SUNContext context);
  ~NewtonIteration();
  NewtonIteration(const NewtonIteration&) = delete;
  NewtonIteration& operator=(const NewtonIteration&) = delete;

  /// To be called before the first step of `ida` and not again.
  void attach(void* ida);
  /// The matrix is new.
  void note_setup() { is_fresh_ = true; }

 private:
  static int test(SUNNonlinearSolver solver, N_Vector y, N_Vector correction, sunrealtype tolerance,
                  N_Vector weights, void* self);
  int judge(int iteration, double correction, double tolerance);

  SUNNonlinearSolver solver_ = nullptr;
  double first_ = 0.0;       // correction of this solve
  double remainder_ = 20.0;  // error left over the last correction, IDA's estimate
  bool is_fresh_ = true, with_fresh_ = true;
};

}  // namespace yoke
