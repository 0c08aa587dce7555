// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <kinsol/kinsol.h>

#include <yoke/integrators/sundials/context.hpp>
#include <yoke/integrators/sundials/linear_solver.hpp>
#include <yoke/integrators/sundials/newton.hpp>
#include <yoke/integrators/sundials/vector.hpp>

namespace yoke {

namespace {

constexpr int max_iterations = 100;
constexpr double smallest_step = 1e-15;

/// One call of KINSOL, with the caller's linear solver.
class Kinsol {
 public:
  Kinsol(const NonlinearProblem& problem, Eigen::VectorXd& x)
      : problem_(problem),
        x_(x),
        in_(x),
        out_(x),
        context_(failure_),
        u_(static_cast<int>(x.size()), context_),
        scale_(static_cast<int>(x.size()), context_),
        solver_(this, {.solve = &Kinsol::solve, .multiply = &Kinsol::multiply}, context_) {
    N_VConst(1.0, scale_);
    memory_ = KINCreate(context_);
    context_.report_errors_of(SundialsPackage::kinsol, memory_);
    KINInit(memory_, &Kinsol::residual, u_);
    KINSetUserData(memory_, this);
    KINSetNumMaxIters(memory_, max_iterations);
    KINSetMaxSetupCalls(memory_, 1);  // a Jacobian for every iteration
    KINSetScaledStepTol(memory_, smallest_step);
    KINSetLinearSolver(memory_, solver_.solver(), solver_.matrix());
    KINSetJacFn(memory_, &Kinsol::jacobian);
  }
  ~Kinsol() { KINFree(&memory_); }
  Kinsol(const Kinsol&) = delete;
  Kinsol& operator=(const Kinsol&) = delete;

  NonlinearOutcome run(double tolerance, double largest_step) {
    KINSetFuncNormTol(memory_, tolerance);
    KINSetMaxNewtonStep(memory_, largest_step);
    store(x_, u_);
    const int flag = KINSol(memory_, u_, KIN_LINESEARCH, scale_, scale_);
    NonlinearOutcome outcome{.converged = flag >= 0, .message = failure_.text};
    KINGetNumNonlinSolvIters(memory_, &outcome.iterations);
    load(u_, x_);
    return outcome;
  }

 private:
  static void load(N_Vector from, Eigen::VectorXd& to) {
    to = Eigen::Map<const Eigen::VectorXd>(NV_DATA_S(from), to.size());
  }
  static void store(const Eigen::VectorXd& from, N_Vector to) {
    Eigen::Map<Eigen::VectorXd>(NV_DATA_S(to), from.size()) = from;
  }
  static int solve(void* self, N_Vector x, N_Vector b) {
    auto& me = *static_cast<Kinsol*>(self);
    load(b, me.in_);
    if (!me.problem_.solve(me.in_)) return 1;
    store(me.in_, x);
    return 0;
  }
  static void multiply(void* self, N_Vector x, N_Vector product) {
    auto& me = *static_cast<Kinsol*>(self);
    load(x, me.in_);
    me.problem_.multiply(me.in_, me.out_);
    store(me.out_, product);
  }
  static int residual(N_Vector u, N_Vector f, void* self) {
    auto& me = *static_cast<Kinsol*>(self);
    return me.failure_.guard([&] {
      load(u, me.in_);
      if (!me.problem_.residual(me.in_, me.out_)) return 1;
      store(me.out_, f);
      return 0;
    });
  }
  static int jacobian(N_Vector u, N_Vector, SUNMatrix, void* self, N_Vector, N_Vector) {
    auto& me = *static_cast<Kinsol*>(self);
    return me.failure_.guard([&] {
      load(u, me.in_);
      return me.problem_.factorise(me.in_) ? 0 : 1;
    });
  }

  const NonlinearProblem& problem_;
  Eigen::VectorXd& x_;
  Eigen::VectorXd in_, out_;
  CallbackFailure failure_;
  SundialsContext context_;
  SundialsVector u_, scale_;
  OwnLinearSolver solver_;
  void* memory_ = nullptr;
};

}  // namespace

NonlinearOutcome solve_nonlinear(const NonlinearProblem& problem, Eigen::VectorXd& x,
                                 double tolerance, double largest_step) {
  return Kinsol(problem, x).run(tolerance, largest_step);
}

}  // namespace yoke
