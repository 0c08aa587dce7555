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

#include <yoke/core/equations/linear/index.hpp>
#include <yoke/integrators/formulations/ida.hpp>
#include <yoke/integrators/formulations/ida_step_control.hpp>
#include <yoke/integrators/formulations/sundials_stepper.hpp>
#include <yoke/integrators/sundials/linear_solver.hpp>
#include <yoke/integrators/sundials/newton_iteration.hpp>

#include <algorithm>
#include <cmath>

namespace yoke {

namespace {

constexpr int steps_per_matrix = 3;
constexpr double step_change = 0.02;       // of dR/dy' that asks for a new matrix
constexpr double probe = 50.0;             // changes of y, in tolerances, that show y''
constexpr double first_error = 1e-4;       // of the first step, in tolerances
constexpr double longest_first = 1000.0;   // the same, in times of the probe
constexpr double shortest_first = 1000.0;  // the same, in units of the rounding of time
constexpr double unweighted = 1e30;  // multipliers: no error test, no say in Newton's convergence

class Ida final : public SundialsStepper {
 public:
  Ida(Dynamics& dynamics, const Tolerances& tolerances, std::unique_ptr<DaeEquations> equations,
      ErrorNorm norm);
  ~Ida() override;

  void start(const State& state) override;
  Step step(double t_stop) override;
  double last_step() const override;
  void interpolate(double t, State& state) override;
  StepCounters counters() const override;

 private:
  static int residual(sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector r, void* self);
  static int jacobian(sunrealtype t, sunrealtype c, N_Vector y, N_Vector y_dot, N_Vector r,
                      SUNMatrix matrix, void* self, N_Vector, N_Vector, N_Vector);
  static int events(sunrealtype t, N_Vector y, N_Vector y_dot, sunrealtype* g, void* self);
  LinearSolverCalls solver_calls() const;
  bool calc_rates(double t, const double* y, double* y_dot) override;
  bool calc_residual(double t, const double* y, const double* y_dot, double* residual);
  void calc_jacobian(double t, double c, const double* y, const double* y_dot);
  void solve(const double* b, double* x);
  void create(double t);
  void set_weights();
  void pack(const State& state);
  void refresh_matrix();
  double first_step();

  /// y with positions for displacements, in scratch.
  const double* absolute(const double* y);
  double* y_dot() { return y_dot_.data(); }

  std::unique_ptr<DaeEquations> own_equations_;
  DaeEquations& equations_;
  int rows_;
  OwnLinearSolver solver_;
  NewtonIteration newton_;
  void* memory_ = nullptr;
  SundialsVector y_dot_, scratch_;
  std::vector<double> a_, lambda_, power_;
  double shift_ = 1.0;  // dR/dy' of the last Jacobian
  int steps_with_matrix_ = 0;
  IdaStepControl control_;
  std::vector<double> absolute_;
  long residuals_ = 0, matrices_ = 0;  // never reset
};

Ida::Ida(Dynamics& dynamics, const Tolerances& tolerances, std::unique_ptr<DaeEquations> equations,
         ErrorNorm norm)
    : SundialsStepper(dynamics, tolerances, equations->size(), multistep),
      own_equations_(std::move(equations)),
      equations_(*own_equations_),
      rows_(dynamics.system().rows()),
      solver_(this, solver_calls(), context_),
      newton_(y_, context_),
      y_dot_(size_, context_, &groups_),
      scratch_(size_, context_, &groups_) {
  if (norm == ErrorNorm::assemblies) groups_.tie(assemblies_of(dynamics.system()));
  power_.assign(static_cast<std::size_t>(quadratures_), 0.0);
  a_.assign(static_cast<std::size_t>(n_), 0.0);
  lambda_.assign(static_cast<std::size_t>(rows_), 0.0);
  absolute_.assign(static_cast<std::size_t>(size_), 0.0);
}

Ida::~Ida() {
  if (memory_ != nullptr) IDAFree(&memory_);
}

const double* Ida::absolute(const double* y) {
  std::copy_n(y, absolute_.size(), absolute_.begin());
  std::copy_n(q_of(y), n_, absolute_.begin());
  return absolute_.data();
}

LinearSolverCalls Ida::solver_calls() const {
  return {.setup =
              [](void* me) {
                auto& ida = *static_cast<Ida*>(me);
                ida.newton_.note_setup();
                return ida.equations_.factorise() ? 0 : 1;
              },
          .solve =
              [](void* me, N_Vector x, N_Vector b) {
                static_cast<Ida*>(me)->solve(NV_DATA_S(b), NV_DATA_S(x));
                return 0;
              }};
}

void Ida::set_weights() {
  SundialsStepper::set_weights();
  std::fill(weights_.data() + equations_.lambda(), weights_.data() + energies_, 1.0 / unweighted);
}

void Ida::pack(const State& state) {
  N_VConst(0.0, y_);
  N_VConst(0.0, y_dot_);
  SundialsStepper::pack(state);
  std::copy_n(state.v.data(), n_, y_dot());
  // The accelerations of the state belong to the contacts before an event; ask again.
  dynamics_.calc_accelerations(
      {.t = state.t, .q = state.q.data(), .v = y() + n_, .z = y() + 2 * n_},
      {.a = a_.data(),
       .lambda = lambda_.data(),
       .z_dot = nz_ > 0 ? y_dot() + 2 * n_ : nullptr,
       .quadrature_rates = quadratures_ > 0 ? y_dot() + energies_ : nullptr});
  std::copy(a_.begin(), a_.end(), y_dot() + equations_.v());
  std::copy(lambda_.begin(), lambda_.end(), y() + equations_.lambda());
}

void Ida::create(double t) {
  memory_ = IDACreate(context_);
  context_.report_errors_of(SundialsPackage::ida, memory_);
  IDAInit(memory_, &Ida::residual, t, y_, y_dot_);
  IDASetUserData(memory_, user_data());
  set_weights();
  IDAWFtolerances(memory_, &Ida::calc_weights);
  newton_.attach(memory_);
  IDASetLinearSolver(memory_, solver_.solver(), solver_.matrix());
  IDASetJacFn(memory_, &Ida::jacobian);
  IDASetDeltaCjLSetup(memory_, step_change);
  IDASetMaxErrTestFails(memory_, 30);
  if (std::isfinite(tolerances_.longest_step)) IDASetMaxStep(memory_, tolerances_.longest_step);
  IDASetMaxConvFails(memory_, 30);
  if (guard_.count() > 0) {
    IDARootInit(memory_, guard_.count(), &Ida::events);
    IDASetRootDirection(memory_, directions().data());
    IDASetNoInactiveRootWarn(memory_);
  }
}

void Ida::start(const State& state) {
  pack(state);
  t_ = state.t;
  t_stop_ = t_;
  end_step();
  guard_.start(state);
  if (memory_ == nullptr) {
    create(state.t);
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
// II.4. Not so short that the rounding of time would show in rates: behind an onset of d^0.13 y'' has
// no bound. 0: IDA's own.
double Ida::first_step() {
  calc_weights(y_, sensible_weights_, user_data());
  const double rate = N_VWrmsNorm(y_dot_, sensible_weights_);
  if (!(rate > 0.0)) return 0.0;
  const double d = probe / rate;
  absolute(y());
  for (int i = 0; i < equations_.lambda(); ++i)
    absolute_[static_cast<std::size_t>(i)] += d * y_dot()[i];
  N_VConst(0.0, scratch_);
  double* change = scratch_.data();
  const double* at = absolute_.data();
  const int found = failure_.guard([&] {
    return dynamics_.calc_accelerations(
               {.t = t_ + d, .q = at, .v = at + n_, .z = at + 2 * n_},
               {.a = change + n_,
                .lambda = lambda_.data(),
                .z_dot = nz_ > 0 ? change + 2 * n_ : nullptr,
                .quadrature_rates = quadratures_ > 0 ? change + energies_ : nullptr})
               ? 0
               : 1;
  });
  if (found != 0) {
    failure_.text.clear();
    return 0.0;
  }
  for (int i = n_; i < size_; ++i) change[i] = (change[i] - y_dot()[i]) / d;
  std::copy_n(y_dot() + n_, n_, change);
  const double curvature = N_VWrmsNorm(scratch_, sensible_weights_), longest = longest_first * d;
  const double shortest = shortest_first * machine_epsilon * std::abs(t_);
  const double step = std::max(shortest, std::sqrt(2.0 * first_error / curvature));
  return std::min(longest, step);  // step: infinity if straight
}

Step Ida::step(double t_stop) {
  t_stop = std::min(t_stop, control_.limit());
  if (t_stop != t_stop_) {
    IDASetStopTime(memory_, t_stop);
    t_stop_ = t_stop;
  }
  begin_step();
  const int flag = IDASolve(memory_, t_stop, &t_, y_, y_dot_, IDA_ONE_STEP);
  if (flag < 0) {
    undo_step();
    IDAGetCurrentTime(memory_, &t_);
    return Step::failed;
  }
  if (flag == IDA_ROOT_RETURN) {
    IDAGetRootInfo(memory_, found_.data());
    double t_limit = t_;
    IDAGetCurrentTime(memory_, &t_limit);
    IDAGetErrWeights(memory_, sensible_weights_);
    refine_event_if_rough(t_limit, y_dot());
    end_step();
    collect_events();
    return Step::event;
  }
  end_step();
  refresh_matrix();
  IDAGetErrWeights(memory_, sensible_weights_);
  control_.accept(memory_, t_, sensible_weights_, scratch_);
  accept_step();
  return Step::advanced;
}

// IDA keeps its matrix as long as Newton's iteration converges, and judges that by a rate it may
// have measured long ago: at a constant step it accepts the first iterate for ever, whose error
// grows with the distance to where the matrix was made. The error estimates of high order see that
// as noise and the order falls. So the matrix is made anew behind IDA's back, for the same step;
// for the same reason a small change of the step asks for one.
void Ida::refresh_matrix() {
  if (++steps_with_matrix_ < steps_per_matrix) return;
  calc_jacobian(t_, shift_, y(), y_dot());
  equations_.factorise();
}

double Ida::last_step() const {
  double h = 0.0;
  if (memory_ != nullptr) IDAGetLastStep(memory_, &h);
  return h;
}

void Ida::interpolate(double t, State& state) {
  if (t == t_end_)
    std::copy_n(end_.begin(), size_, y());
  else
    IDAGetDky(memory_, t, 0, y_);
  unpack(t, state);
}

StepCounters Ida::counters() const {
  StepCounters total = before_;
  total.raised = floor_.raised();
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
  auto& me = from<Ida>(self);
  return me.failure_.guard([&] {
    // 1: try a shorter step
    return me.calc_residual(t, NV_DATA_S(y), NV_DATA_S(y_dot), NV_DATA_S(r)) ? 0 : 1;
  });
}

// Multipliers are left as they are: events make them anew.
bool Ida::calc_rates(double t, const double* y, double* y_dot) {
  std::fill_n(y_dot, size_, 0.0);
  std::copy_n(y + n_, n_, y_dot);
  return dynamics_.calc_accelerations(
      {.t = t, .q = q_of(y), .v = v_of(y), .z = z_of(y)},
      {.a = y_dot + n_,
       .z_dot = nz_ > 0 ? y_dot + 2 * n_ : nullptr,
       .quadrature_rates = quadratures_ > 0 ? y_dot + energies_ : nullptr});
}

bool Ida::calc_residual(double t, const double* y, const double* y_dot, double* residual) {
  const double* at = absolute(y);
  ++residuals_;
  if (!equations_.calc_residual(t, at, y_dot, residual)) return false;
  if (quadratures_ == 0) return true;
  // Multipliers from the acceleration-level solve: IDA's own are a hundred times worse.
  if (!dynamics_.calc_accelerations(
          {.t = t, .q = at, .v = y + n_, .z = y + 2 * n_},
          {.a = a_.data(), .lambda = lambda_.data(), .quadrature_rates = power_.data()}))
    return false;
  for (int i = 0; i < quadratures_; ++i)
    residual[energies_ + i] = y_dot[energies_ + i] - power_[static_cast<std::size_t>(i)];
  return true;
}

int Ida::jacobian(sunrealtype t, sunrealtype c, N_Vector y, N_Vector y_dot, N_Vector, SUNMatrix,
                  void* self, N_Vector, N_Vector, N_Vector) {
  auto& me = from<Ida>(self);
  return me.failure_.guard([&] {
    me.calc_jacobian(t, c, NV_DATA_S(y), NV_DATA_S(y_dot));
    return 0;
  });
}

void Ida::calc_jacobian(double t, double c, const double* y, const double* y_dot) {
  shift_ = c;
  steps_with_matrix_ = 0;
  ++matrices_;
  equations_.calc_jacobian(t, c, absolute(y), y_dot);
}

void Ida::solve(const double* b, double* x) {
  std::copy_n(b, size_, x);
  equations_.solve(x);
  // Energies act on nothing, so Newton's iteration does without their derivatives by the motion.
  for (int i = energies_; i < size_; ++i) x[i] /= shift_;
}

int Ida::events(sunrealtype t, N_Vector y, N_Vector, sunrealtype* g, void* self) {
  auto& me = from<Ida>(self);
  return me.failure_.guard([&] { return me.evaluate_events(t, NV_DATA_S(y), g) ? 0 : -1; });
}

}  // namespace

std::unique_ptr<Formulation> make_ida(Dynamics& dynamics, const Tolerances& tolerances,
                                      std::unique_ptr<DaeEquations> equations, ErrorNorm norm) {
  return std::make_unique<Ida>(dynamics, tolerances, std::move(equations), norm);
}

}  // namespace yoke
