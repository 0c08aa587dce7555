// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// F(x) = 0 by Newton's iteration with line search (SUNDIALS KINSOL), with a Jacobian and linear
// solver of one's own. x and F must be scaled to order one by the caller.
#pragma once

#include <functional>
#include <string>

#include <Eigen/Core>

namespace yoke {

struct NonlinearProblem {
  std::function<bool(const Eigen::VectorXd& x, Eigen::VectorXd& F)> residual;
  std::function<bool(const Eigen::VectorXd& x)> factorise;  // dF/dx at x
  std::function<bool(Eigen::VectorXd& b)> solve;            // b := (dF/dx)^-1 b
  std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& Jx)> multiply;
};

struct NonlinearOutcome {
  bool converged = false;  // by the residual or by steps that are only rounding any more
  long iterations = 0;
  std::string message;  // of KINSOL, if it failed
};

/// From x, which is left at the solution or at the best point met. Stops at |F|max <= tolerance.
NonlinearOutcome solve_nonlinear(const NonlinearProblem& problem, Eigen::VectorXd& x,
                                 double tolerance, double largest_step);

}  // namespace yoke
