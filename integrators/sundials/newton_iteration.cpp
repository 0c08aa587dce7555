// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <idas/idas.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <yoke/integrators/sundials/newton_iteration.hpp>

#include <cmath>

namespace yoke {

namespace {

// IDA's own (Hindmarsh et al., User Documentation for IDA, "Mathematical considerations").
constexpr double unknown_remainder = 20.0;  // after a new matrix
constexpr double slowest = 0.9;             // rate of convergence
constexpr double negligible = 1e-4 * 1e-4;  // first correction, in tolerances

}  // namespace

NewtonIteration::NewtonIteration(N_Vector like, SUNContext context)
    : solver_(SUNNonlinSol_Newton(like, context)) {}

NewtonIteration::~NewtonIteration() { SUNNonlinSolFree(solver_); }

void NewtonIteration::attach(void* ida) {
  IDASetNonlinearSolver(ida, solver_);
  SUNNonlinSolSetConvTestFn(solver_, &NewtonIteration::test, this);
}

int NewtonIteration::test(SUNNonlinearSolver solver, N_Vector, N_Vector correction,
                          sunrealtype tolerance, N_Vector weights, void* self) {
  int iteration = 0;
  SUNNonlinSolGetCurIter(solver, &iteration);
  return static_cast<NewtonIteration*>(self)->judge(iteration, N_VWrmsNorm(correction, weights),
                                                    tolerance);
}

int NewtonIteration::judge(int iteration, double correction, double tolerance) {
  if (iteration == 0) {
    if (is_fresh_) remainder_ = unknown_remainder;
    with_fresh_ = is_fresh_;
    is_fresh_ = false;
    first_ = correction;
    if (correction <= negligible * tolerance) return SUN_NLS_SUCCESS;
  } else {
    const double rate = std::pow(correction / first_, 1.0 / iteration);
    if (!(rate <= slowest))
      return with_fresh_ && correction <= tolerance ? SUN_NLS_SUCCESS : SUN_NLS_CONV_RECVR;
    remainder_ = rate / (1.0 - rate);
  }
  return remainder_ * correction <= tolerance ? SUN_NLS_SUCCESS : SUN_NLS_CONTINUE;
}

}  // namespace yoke
