// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <yoke/integrators/sundials/callback_failure.hpp>
#include <yoke/integrators/sundials/newton.hpp>

namespace yoke {

namespace {

constexpr int max_iterations = 100;
constexpr double smallest_step = 1e-15;

/// One call of KINSOL; SUNDIALS sees a matrix without data and a solver that is the caller's.
class Kinsol {
 public:
  Kinsol(const NonlinearProblem& problem, Eigen::VectorXd& x)
      : problem_(problem), x_(x), in_(x), out_(x) {
    SUNContext_Create(nullptr, &context_);
    u_ = N_VNew_Serial(x.size(), context_);
    scale_ = N_VClone(u_);
    N_VConst(1.0, scale_);
    matrix_ = SUNMatNewEmpty(context_);
    matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
    matrix_->ops->zero = [](SUNMatrix) { return 0; };
    matrix_->ops->matvec = [](SUNMatrix m, N_Vector from, N_Vector to) {
      auto& me = *static_cast<Kinsol*>(m->content);
      me.load(from, me.in_);
      me.problem_.multiply(me.in_, me.out_);
      me.store(me.out_, to);
      return 0;
    };
    matrix_->content = this;
    solver_ = SUNLinSolNewEmpty(context_);
    solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
    solver_->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
    solver_->ops->setup = [](SUNLinearSolver, SUNMatrix) { return 0; };
    solver_->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector to, N_Vector b, sunrealtype) {
      auto& me = *static_cast<Kinsol*>(s->content);
      me.load(b, me.in_);
      if (!me.problem_.solve(me.in_)) return 1;
      me.store(me.in_, to);
      return 0;
    };
    solver_->content = this;
    memory_ = KINCreate(context_);
    KINSetErrHandlerFn(
        memory_,
        [](int code, const char*, const char*, char* message, void* self) {
          static_cast<Kinsol*>(self)->failure_.report(code, message);
        },
        this);
    KINInit(memory_, &Kinsol::residual, u_);
    KINSetUserData(memory_, this);
    KINSetNumMaxIters(memory_, max_iterations);
    KINSetMaxSetupCalls(memory_, 1);  // a Jacobian for every iteration
    KINSetScaledStepTol(memory_, smallest_step);
    KINSetLinearSolver(memory_, solver_, matrix_);
    KINSetJacFn(memory_, &Kinsol::jacobian);
  }
  ~Kinsol() {
    KINFree(&memory_);
    SUNLinSolFreeEmpty(solver_);
    SUNMatFreeEmpty(matrix_);
    N_VDestroy(u_);
    N_VDestroy(scale_);
    SUNContext_Free(&context_);
  }
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
  SUNContext context_ = nullptr;
  void* memory_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  N_Vector u_ = nullptr, scale_ = nullptr;
  CallbackFailure failure_;
};

}  // namespace

NonlinearOutcome solve_nonlinear(const NonlinearProblem& problem, Eigen::VectorXd& x,
                                 double tolerance, double largest_step) {
  return Kinsol(problem, x).run(tolerance, largest_step);
}

}  // namespace yoke
