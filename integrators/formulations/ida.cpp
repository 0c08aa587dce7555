// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// BDF of variable order and step (SUNDIALS IDAS) on the equations it is given. The matrix and the
// linear solver are our own: IDA would set a sparse matrix's index arrays to zero before every
// Jacobian, and could not scale it. Energies E are unknowns of their own, E' = power: IDAS'
// quadratures fall to order 1 where the motion itself is without error, as in a mechanism that is
// wholly driven. The first part of y are displacements from the last restart, so that rounding in
// IDA's sums does not know where the origin is.
#include <idas/idas.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <yoke/integrators/formulations/event_guard.hpp>
#include <yoke/integrators/formulations/ida.hpp>
#include <yoke/integrators/formulations/ida_step_control.hpp>
#include <yoke/integrators/sundials/callback_failure.hpp>
#include <yoke/integrators/sundials/vector.hpp>

#include <algorithm>
#include <cmath>

namespace yoke {

namespace {

constexpr int steps_per_matrix = 3;
constexpr double step_change = 0.02;      // of dR/dy' that asks for a new matrix
constexpr double probe = 50.0;            // changes of y, in tolerances, that show y''
constexpr double first_error = 1e-4;      // of the first step, in tolerances
constexpr double longest_first = 1000.0;  // the same, in times of the probe
constexpr double unweighted = 1e30;  // multipliers: no error test, no say in Newton's convergence

class Ida final : public Formulation {
 public:
  Ida(Dynamics& dynamics, const Tolerances& tolerances, std::unique_ptr<DaeEquations> equations);
  ~Ida() override;

  void start(const State& state) override;
  Step step(double t_stop) override;
  double time() const override { return t_; }
  double last_step() const override;
  void interpolate(double t, State& state) override;
  const std::vector<int>& fired() const override { return guard_.fired(); }
  const std::vector<int>& passed() const override { return guard_.passed(); }
  StepCounters counters() const override;
  std::string failure() const override { return failure_.text; }

 private:
  static int residual(sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector r, void* self);
  static int jacobian(sunrealtype t, sunrealtype c, N_Vector y, N_Vector y_dot, N_Vector r,
                      SUNMatrix matrix, void* self, N_Vector, N_Vector, N_Vector);
  bool calc_residual(double t, const double* y, const double* y_dot, double* residual);
  static int events(sunrealtype t, N_Vector y, N_Vector y_dot, sunrealtype* g, void* self);
  static int weights(N_Vector y, N_Vector weights, void* self);
  static int setup(SUNLinearSolver solver, SUNMatrix matrix);
  static int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b,
                   sunrealtype tolerance);
  static void on_error(int code, const char* module, const char* function, char* message,
                       void* self);
  void create_matrix_and_solver();
  void create(const State& state);
  void set_weights();
  void pack(const State& state);
  void refresh_matrix();
  double first_step();

  /// y with positions for displacements, in scratch.
  const double* absolute(const double* y);
  double* y() { return NV_DATA_S(y_); }
  double* y_dot() { return NV_DATA_S(y_dot_); }

  Dynamics& dynamics_;
  Tolerances tolerances_;
  std::unique_ptr<DaeEquations> own_equations_;
  DaeEquations& equations_;
  EventGuard guard_;
  int n_, nz_, rows_, quadratures_, size_;
  SUNContext context_ = nullptr;
  void* memory_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  N_Vector y_ = nullptr, y_dot_ = nullptr, weights_ = nullptr;  // weights_: 1 / tolerance
  N_Vector scratch_ = nullptr;
  std::vector<double> a_, lambda_, power_;
  double shift_ = 1.0;  // dR/dy' of the last Jacobian
  int steps_with_matrix_ = 0;
  IdaStepControl control_;
  std::vector<double> q_start_, absolute_;
  double t_ = 0.0;
  double t_stop_ = 0.0;
  std::vector<int> found_;
  StepCounters before_;
  long residuals_ = 0, matrices_ = 0;  // never reset
  CallbackFailure failure_;
};

Ida::Ida(Dynamics& dynamics, const Tolerances& tolerances, std::unique_ptr<DaeEquations> equations)
    : dynamics_(dynamics),
      tolerances_(tolerances),
      own_equations_(std::move(equations)),
      equations_(*own_equations_),
      guard_(dynamics),
      n_(dynamics.system().dofs()),
      nz_(dynamics.system().states()),
      rows_(dynamics.system().rows()),
      quadratures_(dynamics.system().quadratures()),
      size_(equations_.size() + quadratures_) {
  SUNContext_Create(nullptr, &context_);
  y_ = new_vector(size_, context_);
  y_dot_ = N_VClone(y_);
  weights_ = N_VClone(y_);
  scratch_ = N_VClone(y_);
  power_.assign(static_cast<std::size_t>(quadratures_), 0.0);
  found_.assign(static_cast<std::size_t>(guard_.count()), 0);
  a_.assign(static_cast<std::size_t>(n_), 0.0);
  lambda_.assign(static_cast<std::size_t>(rows_), 0.0);
  failure_.text.reserve(512);
  q_start_.assign(static_cast<std::size_t>(n_), 0.0);
  absolute_.assign(static_cast<std::size_t>(size_), 0.0);
  create_matrix_and_solver();
}

Ida::~Ida() {
  if (memory_ != nullptr) IDAFree(&memory_);
  SUNLinSolFreeEmpty(solver_);
  SUNMatFreeEmpty(matrix_);
  for (N_Vector vector : {y_, y_dot_, weights_, scratch_}) N_VDestroy(vector);
  SUNContext_Free(&context_);
}

const double* Ida::absolute(const double* y) {
  std::copy_n(y, absolute_.size(), absolute_.begin());
  for (std::size_t i = 0; i < q_start_.size(); ++i) absolute_[i] += q_start_[i];
  return absolute_.data();
}

// SUNDIALS sees a matrix without data and a direct solver that works on equations_.
void Ida::create_matrix_and_solver() {
  matrix_ = SUNMatNewEmpty(context_);
  matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix_->ops->zero = [](SUNMatrix) { return 0; };
  matrix_->content = this;
  solver_ = SUNLinSolNewEmpty(context_);
  solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver_->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  solver_->ops->setup = &Ida::setup;
  solver_->ops->solve = &Ida::solve;
  solver_->content = this;
}

void Ida::set_weights() {
  // The root mean square of IDA runs over all unknowns; what is not weighted must not dilute it.
  const double weighted = std::max(1, 2 * n_ + nz_);
  const double share = std::sqrt(weighted / std::max(1, size_));
  double* w = NV_DATA_S(weights_);
  for (int i = 0; i < n_; ++i) {
    w[i] = share * std::max(tolerances_.q[i], rounding_of(q_start_[static_cast<std::size_t>(i)]));
    w[equations_.v() + i] = share * tolerances_.v[i];
  }
  for (int i = 0; i < nz_; ++i) w[equations_.z() + i] = share * tolerances_.z[i];
  for (int i = equations_.lambda(); i < equations_.size(); ++i) w[i] = unweighted;
  for (int i = equations_.size(); i < size_; ++i) w[i] = share * tolerances_.energy;
  for (int i = 0; i < size_; ++i) w[i] = 1.0 / w[i];
}

void Ida::pack(const State& state) {
  N_VConst(0.0, y_);
  N_VConst(0.0, y_dot_);
  std::copy_n(state.q.data(), n_, q_start_.begin());
  std::copy_n(state.v.data(), n_, y() + equations_.v());
  std::copy_n(state.z.data(), nz_, y() + equations_.z());
  std::copy_n(state.lambda.data(), rows_, y() + equations_.lambda());
  std::copy_n(state.v.data(), n_, y_dot());
  std::copy_n(state.energy.data(), quadratures_, y() + equations_.size());
  // The accelerations of the state belong to the contacts before an event; ask again.
  dynamics_.calc_accelerations(state.t, state.q.data(), y() + n_, y() + 2 * n_, a_.data(),
                               lambda_.data(), nz_ > 0 ? y_dot() + 2 * n_ : nullptr,
                               quadratures_ > 0 ? y_dot() + equations_.size() : nullptr);
  std::copy(a_.begin(), a_.end(), y_dot() + equations_.v());
  std::copy(lambda_.begin(), lambda_.end(), y() + equations_.lambda());
}

void Ida::create(const State& state) {
  memory_ = IDACreate(context_);
  IDASetErrHandlerFn(memory_, &Ida::on_error, this);
  IDAInit(memory_, &Ida::residual, state.t, y_, y_dot_);
  IDASetUserData(memory_, this);
  set_weights();
  IDAWFtolerances(memory_, &Ida::weights);
  IDASetLinearSolver(memory_, solver_, matrix_);
  IDASetJacFn(memory_, &Ida::jacobian);
  IDASetDeltaCjLSetup(memory_, step_change);
  IDASetMaxErrTestFails(memory_, 30);
  IDASetMaxConvFails(memory_, 30);
  if (guard_.count() > 0) {
    IDARootInit(memory_, guard_.count(), &Ida::events);
    std::vector<int> upwards(found_.size(), 1);
    IDASetRootDirection(memory_, upwards.data());
    IDASetNoInactiveRootWarn(memory_);
  }
}

void Ida::start(const State& state) {
  pack(state);
  t_ = state.t;
  t_stop_ = t_;
  guard_.start(state);
  if (memory_ == nullptr) {
    create(state);
  } else {
    before_ = counters();
    before_.factors = {};  // these are never reset
    IDAReInit(memory_, state.t, y_, y_dot_);
    set_weights();
  }
  IDASetInitStep(memory_, first_step());
  control_.start(memory_);
}

// A first step of order 1 whose error, y'' h^2 / 2, is a small part of the tolerance. IDA's own is
// so much shorter that rounding rules its first error estimates and the order does not rise. y'' is
// seen a little ahead, as in Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I,
// II.4. 0: IDA's own.
double Ida::first_step() {
  const double rate = N_VWrmsNorm(y_dot_, weights_);
  if (!(rate > 0.0)) return 0.0;
  const double d = probe / rate;
  absolute(y());
  for (int i = 0; i < equations_.lambda(); ++i)
    absolute_[static_cast<std::size_t>(i)] += d * y_dot()[i];
  N_VConst(0.0, scratch_);
  double* change = NV_DATA_S(scratch_);
  const double* at = absolute_.data();
  const int found = failure_.guard([&] {
    return dynamics_.calc_accelerations(t_ + d, at, at + n_, at + 2 * n_, change + n_,
                                        lambda_.data(), nz_ > 0 ? change + 2 * n_ : nullptr,
                                        quadratures_ > 0 ? change + equations_.size() : nullptr)
               ? 0
               : 1;
  });
  if (found != 0) {
    failure_.text.clear();
    return 0.0;
  }
  for (int i = n_; i < size_; ++i) change[i] = (change[i] - y_dot()[i]) / d;
  std::copy_n(y_dot() + n_, n_, change);
  const double curvature = N_VWrmsNorm(scratch_, weights_), longest = longest_first * d;
  return std::min(longest, std::sqrt(2.0 * first_error / curvature));  // infinity if straight
}

Step Ida::step(double t_stop) {
  t_stop = std::min(t_stop, control_.limit());
  if (t_stop != t_stop_) {
    IDASetStopTime(memory_, t_stop);
    t_stop_ = t_stop;
  }
  const int flag = IDASolve(memory_, t_stop, &t_, y_, y_dot_, IDA_ONE_STEP);
  if (flag < 0) {
    IDAGetCurrentTime(memory_, &t_);
    return Step::failed;
  }
  if (flag == IDA_ROOT_RETURN) {
    IDAGetRootInfo(memory_, found_.data());
    guard_.collect(t_, absolute(y()), y() + n_, y() + 2 * n_, found_);
    return Step::event;
  }
  refresh_matrix();
  control_.accept(memory_, t_, weights_, scratch_);
  guard_.accept(t_, absolute(y()), y() + n_, y() + 2 * n_);
  return Step::advanced;
}

// IDA keeps its matrix as long as Newton's iteration converges, and judges that by a rate it may
// have measured long ago: at a constant step it accepts the first iterate for ever, whose error
// grows with the distance to where the matrix was made. The error estimates of high order see that
// as noise and the order falls. So the matrix is made anew behind IDA's back, for the same step;
// for the same reason a small change of the step asks for one.
void Ida::refresh_matrix() {
  if (++steps_with_matrix_ < steps_per_matrix) return;
  equations_.calc_jacobian(t_, shift_, absolute(y()), y_dot());
  equations_.factorise();
  ++matrices_;
  steps_with_matrix_ = 0;
}

double Ida::last_step() const {
  double h = 0.0;
  if (memory_ != nullptr) IDAGetLastStep(memory_, &h);
  return h;
}

void Ida::interpolate(double t, State& state) {
  IDAGetDky(memory_, t, 0, y_);
  state.t = t;
  std::copy_n(absolute(y()), n_, state.q.data());
  std::copy_n(y() + equations_.v(), n_, state.v.data());
  std::copy_n(y() + equations_.z(), nz_, state.z.data());
  std::copy_n(y() + equations_.size(), quadratures_, state.energy.data());
}

StepCounters Ida::counters() const {
  StepCounters total = before_;
  total.factors = equations_.counters();
  total.evaluations = residuals_;
  total.jacobians = matrices_;
  if (memory_ == nullptr) return total;
  long steps = 0, errors = 0, newton = 0;
  IDAGetNumSteps(memory_, &steps);
  IDAGetNumErrTestFails(memory_, &errors);
  IDAGetNumStepSolveFails(memory_, &newton);
  total.steps += steps;
  total.rejected += errors + newton;
  return total;
}

int Ida::residual(sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector r, void* self) {
  auto& me = *static_cast<Ida*>(self);
  return me.failure_.guard([&] {
    // 1: try a shorter step
    return me.calc_residual(t, NV_DATA_S(y), NV_DATA_S(y_dot), NV_DATA_S(r)) ? 0 : 1;
  });
}

bool Ida::calc_residual(double t, const double* y, const double* y_dot, double* residual) {
  const double* at = absolute(y);
  ++residuals_;
  if (!equations_.calc_residual(t, at, y_dot, residual)) return false;
  if (quadratures_ == 0) return true;
  // Multipliers from the acceleration-level solve: IDA's own are a hundred times worse.
  if (!dynamics_.calc_accelerations(t, at, y + n_, y + 2 * n_, a_.data(), lambda_.data(), nullptr,
                                    power_.data()))
    return false;
  for (int i = 0; i < quadratures_; ++i)
    residual[equations_.size() + i] =
        y_dot[equations_.size() + i] - power_[static_cast<std::size_t>(i)];
  return true;
}

int Ida::jacobian(sunrealtype t, sunrealtype c, N_Vector y, N_Vector y_dot, N_Vector, SUNMatrix,
                  void* self, N_Vector, N_Vector, N_Vector) {
  auto& me = *static_cast<Ida*>(self);
  return me.failure_.guard([&] {
    me.shift_ = c;
    me.steps_with_matrix_ = 0;
    ++me.matrices_;
    me.equations_.calc_jacobian(t, c, me.absolute(NV_DATA_S(y)), NV_DATA_S(y_dot));
    return 0;
  });
}

// They do not depend on y, so SUNDIALS need not compute them anew in every step.
int Ida::weights(N_Vector, N_Vector weights, void* self) {
  N_VScale(1.0, static_cast<Ida*>(self)->weights_, weights);
  return 0;
}

int Ida::setup(SUNLinearSolver solver, SUNMatrix) {
  return static_cast<Ida*>(solver->content)->equations_.factorise() ? 0 : 1;
}

int Ida::solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) {
  auto& me = *static_cast<Ida*>(solver->content);
  std::copy_n(NV_DATA_S(b), me.size_, NV_DATA_S(x));
  me.equations_.solve(NV_DATA_S(x));
  // Energies act on nothing, so Newton's iteration does without their derivatives by the motion.
  for (int i = me.equations_.size(); i < me.size_; ++i) NV_Ith_S(x, i) /= me.shift_;
  return 0;
}

int Ida::events(sunrealtype t, N_Vector y_vector, N_Vector, sunrealtype* g, void* self) {
  auto& me = *static_cast<Ida*>(self);
  const double* y = NV_DATA_S(y_vector);
  return me.failure_.guard(
      [&] { return me.guard_.evaluate(t, me.absolute(y), y + me.n_, y + 2 * me.n_, g) ? 0 : -1; });
}

void Ida::on_error(int code, const char*, const char*, char* message, void* self) {
  static_cast<Ida*>(self)->failure_.report(code, message);
}

}  // namespace

std::unique_ptr<Formulation> make_ida(Dynamics& dynamics, const Tolerances& tolerances,
                                      std::unique_ptr<DaeEquations> equations) {
  return std::make_unique<Ida>(dynamics, tolerances, std::move(equations));
}

}  // namespace yoke
