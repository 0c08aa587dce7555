// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Multistep methods of variable order and step (SUNDIALS CVODES) on the accelerations of the saddle
// system, y = (q, v, z, energies).
//
// Adams, for long smooth motions at tight tolerances: no matrix, fixed-point iteration. SUNDIALS
// has no projection for it, so accelerations are stabilised after Baumgarte.
//
// BDF, for stiff contacts: SUNDIALS' own projection puts positions and velocities back on the
// constraints at every step. Newton's matrix I - g J would be dense, as an
// acceleration depends on all bodies; with the multipliers as further unknowns the same step is
// sparse (acceleration_matrix.hpp, c = 1/g):
//
//   c I x_q - x_v                                        = c b_q
//   (K - Q_q) x_q + (c M - Q_v) x_v - Q_z x_z + G^T dl   = c M b_v
//   -f_q x_q - f_v x_v + (c I - f_z) x_z                 = c b_z
//   H(a) x_q + (c G + 2 H) x_v                           = c G b_v
//
// Energies act on nothing, so Newton's iteration does without their derivatives by the motion. The
// first part of y are displacements from the last restart.
#include <cvodes/cvodes.h>
#include <cvodes/cvodes_ls.h>
#include <cvodes/cvodes_proj.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <yoke/integrators/formulations/equations/acceleration_matrix.hpp>
#include <yoke/integrators/formulations/event_guard.hpp>
#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/sundials/callback_failure.hpp>
#include <yoke/integrators/sundials/vector.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace yoke {

namespace {

// What the fixed-point iteration leaves, in tolerances. It is noise in the history of the method,
// on which its order and steps depend; CVODE's own 0.1 costs more steps than it saves iterations.
constexpr double iteration_error = 0.01;

enum class Method { bdf_projection, adams_baumgarte };

class Cvode final : public Formulation {
 public:
  Cvode(Dynamics& dynamics, const Tolerances& tolerances, Method method);
  ~Cvode() override;

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
  static int rates(sunrealtype t, N_Vector y, N_Vector y_dot, void* self);
  static int linear_system(sunrealtype t, N_Vector y, N_Vector fy, SUNMatrix matrix,
                           sunbooleantype jok, sunbooleantype* jcur, sunrealtype gamma, void* self,
                           N_Vector, N_Vector, N_Vector);
  static int weights(N_Vector y, N_Vector weights, void* self);
  static int setup(SUNLinearSolver solver, SUNMatrix matrix);
  static int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b,
                   sunrealtype tolerance);
  static int project(sunrealtype t, N_Vector y, N_Vector correction, sunrealtype epsilon,
                     N_Vector error, void* self);
  static int events(sunrealtype t, N_Vector y, sunrealtype* g, void* self);
  static void on_error(int code, const char* module, const char* function, char* message,
                       void* self);
  bool calc_rates(double t, const double* y, double* y_dot);
  bool calc_linear_system(double t, const double* y, double gamma);
  void solve(const double* b, double* x);
  bool project(double t, const double* y, double* correction);
  void create_matrix_and_solver();
  void create(const State& state);
  void attach_newton();
  void attach_fixed_point();
  void set_weights();
  void pack(const State& state);

  double* y() { return NV_DATA_S(y_); }
  /// Positions for displacements y, in scratch.
  double* q_of(const double* y);
  const double* v_of(const double* y) const { return y + n_; }
  const double* z_of(const double* y) const { return y + 2 * n_; }

  Dynamics& dynamics_;
  Tolerances tolerances_;
  std::optional<AccelerationMatrix> equations_;  // BDF's
  std::optional<Baumgarte> stabilisation_;       // that of Adams
  EventGuard guard_;
  int n_, nz_, quadratures_, size_;
  SUNContext context_ = nullptr;
  void* memory_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  SUNNonlinearSolver fixed_point_ = nullptr;
  N_Vector y_ = nullptr, weights_ = nullptr;  // weights_: 1 / tolerance
  std::vector<double> q_start_, q_, v_, a_, lambda_, x_;
  std::vector<double> G_;  // blocks at the point of the matrix
  double c_ = 1.0;
  double t_ = 0.0;
  double t_stop_ = 0.0;
  std::vector<int> found_;
  StepCounters before_;  // of integrations before the last restart
  CallbackFailure failure_;
};

Cvode::Cvode(Dynamics& dynamics, const Tolerances& tolerances, Method method)
    : dynamics_(dynamics),
      tolerances_(tolerances),
      guard_(dynamics),
      n_(dynamics.system().dofs()),
      nz_(dynamics.system().states()),
      quadratures_(dynamics.system().quadratures()),
      size_(2 * n_ + nz_ + quadratures_) {
  SUNContext_Create(nullptr, &context_);
  y_ = new_vector(size_, context_);
  weights_ = N_VClone(y_);
  found_.assign(static_cast<std::size_t>(guard_.count()), 0);
  q_start_.assign(static_cast<std::size_t>(n_), 0.0);
  q_ = v_ = a_ = q_start_;
  lambda_.assign(static_cast<std::size_t>(dynamics.system().rows()), 0.0);
  failure_.text.reserve(512);
  if (method == Method::adams_baumgarte) {
    const double rate =
        tolerances.baumgarte_rate > 0.0 ? tolerances.baumgarte_rate : tolerances.natural_rate;
    stabilisation_ = {.alpha = rate, .beta = rate};
    fixed_point_ = SUNNonlinSol_FixedPoint(y_, 0, context_);
  } else {
    equations_.emplace(dynamics.system());
    x_.assign(static_cast<std::size_t>(equations_->size()), 0.0);
    G_.assign(dynamics.system().jacobian_size(), 0.0);
    create_matrix_and_solver();
  }
}

Cvode::~Cvode() {
  if (memory_ != nullptr) CVodeFree(&memory_);
  if (solver_ != nullptr) SUNLinSolFreeEmpty(solver_);
  if (matrix_ != nullptr) SUNMatFreeEmpty(matrix_);
  if (fixed_point_ != nullptr) SUNNonlinSolFree(fixed_point_);
  N_VDestroy(y_);
  N_VDestroy(weights_);
  SUNContext_Free(&context_);
}

// SUNDIALS sees a matrix without data and a direct solver that works on equations_.
void Cvode::create_matrix_and_solver() {
  matrix_ = SUNMatNewEmpty(context_);
  matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix_->ops->zero = [](SUNMatrix) { return 0; };
  matrix_->content = this;
  solver_ = SUNLinSolNewEmpty(context_);
  solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver_->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  solver_->ops->setup = &Cvode::setup;
  solver_->ops->solve = &Cvode::solve;
  solver_->content = this;
}

double* Cvode::q_of(const double* y) {
  for (std::size_t i = 0; i < q_.size(); ++i) q_[i] = q_start_[i] + y[i];
  return q_.data();
}

void Cvode::set_weights() {
  double* w = NV_DATA_S(weights_);
  for (int i = 0; i < n_; ++i)
    w[i] = std::max(tolerances_.q[i], rounding_of(q_start_[static_cast<std::size_t>(i)]));
  std::copy_n(tolerances_.v.data(), n_, w + n_);
  std::copy_n(tolerances_.z.data(), nz_, w + 2 * n_);
  std::fill_n(w + 2 * n_ + nz_, quadratures_, tolerances_.energy);
  for (int i = 0; i < size_; ++i) w[i] = 1.0 / w[i];
}

void Cvode::pack(const State& state) {
  std::copy_n(state.q.data(), n_, q_start_.begin());
  std::fill_n(y(), n_, 0.0);
  std::copy_n(state.v.data(), n_, y() + n_);
  std::copy_n(state.z.data(), nz_, y() + 2 * n_);
  std::copy_n(state.energy.data(), quadratures_, y() + 2 * n_ + nz_);
}

void Cvode::create(const State& state) {
  memory_ = CVodeCreate(equations_ ? CV_BDF : CV_ADAMS, context_);
  CVodeSetErrHandlerFn(memory_, &Cvode::on_error, this);
  CVodeInit(memory_, &Cvode::rates, state.t, y_);
  CVodeSetUserData(memory_, this);
  set_weights();
  CVodeWFtolerances(memory_, &Cvode::weights);
  equations_ ? attach_newton() : attach_fixed_point();
  CVodeSetMaxErrTestFails(memory_, 30);
  CVodeSetMaxConvFails(memory_, 30);
  if (guard_.count() > 0) {
    CVodeRootInit(memory_, guard_.count(), &Cvode::events);
    std::vector<int> upwards(found_.size(), 1);
    CVodeSetRootDirection(memory_, upwards.data());
    CVodeSetNoInactiveRootWarn(memory_);
  }
}

void Cvode::attach_newton() {
  CVodeSetLinearSolver(memory_, solver_, matrix_);
  CVodeSetLinSysFn(memory_, &Cvode::linear_system);
  CVodeSetProjFn(memory_, &Cvode::project);
  CVodeSetProjErrEst(memory_, SUNFALSE);
}

void Cvode::attach_fixed_point() {
  CVodeSetNonlinearSolver(memory_, fixed_point_);
  CVodeSetNonlinConvCoef(memory_, iteration_error);
}

void Cvode::start(const State& state) {
  pack(state);
  t_ = state.t;
  t_stop_ = t_;
  guard_.start(state);
  if (memory_ == nullptr) {
    create(state);
    return;
  }
  before_ = counters();
  before_.factors = {};  // these are never reset
  CVodeReInit(memory_, state.t, y_);
  set_weights();
}

Step Cvode::step(double t_stop) {
  if (t_stop != t_stop_) {
    CVodeSetStopTime(memory_, t_stop);
    t_stop_ = t_stop;
  }
  const int flag = CVode(memory_, t_stop, y_, &t_, CV_ONE_STEP);
  // With the fixed-point iteration CVODE tries shorter steps even after an exception.
  if (flag < 0 || failure_.thrown) {
    CVodeGetCurrentTime(memory_, &t_);
    return Step::failed;
  }
  if (flag == CV_ROOT_RETURN) {
    CVodeGetRootInfo(memory_, found_.data());
    guard_.collect(t_, q_of(y()), v_of(y()), z_of(y()), found_);
    return Step::event;
  }
  guard_.accept(t_, q_of(y()), v_of(y()), z_of(y()));
  return Step::advanced;
}

double Cvode::last_step() const {
  double h = 0.0;
  if (memory_ != nullptr) CVodeGetLastStep(memory_, &h);
  return h;
}

void Cvode::interpolate(double t, State& state) {
  CVodeGetDky(memory_, t, 0, y_);
  state.t = t;
  std::copy_n(q_of(y()), n_, state.q.data());
  std::copy_n(y() + n_, n_, state.v.data());
  std::copy_n(y() + 2 * n_, nz_, state.z.data());
  std::copy_n(y() + 2 * n_ + nz_, quadratures_, state.energy.data());
}

StepCounters Cvode::counters() const {
  StepCounters total = before_;
  if (equations_) total.factors = equations_->counters();
  if (memory_ == nullptr) return total;
  long steps = 0, errors = 0, newton = 0, setups = 0;
  CVodeGetNumSteps(memory_, &steps);
  CVodeGetNumErrTestFails(memory_, &errors);
  CVodeGetNumStepSolveFails(memory_, &newton);
  CVodeGetNumLinSolvSetups(memory_, &setups);
  total.steps += steps;
  total.rejected += errors + newton;
  total.jacobians += setups;
  return total;
}

int Cvode::rates(sunrealtype t, N_Vector y, N_Vector y_dot, void* self) {
  auto& me = *static_cast<Cvode*>(self);
  return me.failure_.guard([&] {
    return me.calc_rates(t, NV_DATA_S(y), NV_DATA_S(y_dot)) ? 0 : 1;  // 1: try a shorter step
  });
}

bool Cvode::calc_rates(double t, const double* y, double* y_dot) {
  std::copy_n(y + n_, n_, y_dot);
  return dynamics_.calc_accelerations(t, q_of(y), v_of(y), z_of(y), y_dot + n_, nullptr,
                                      y_dot + 2 * n_, y_dot + 2 * n_ + nz_,
                                      stabilisation_ ? &*stabilisation_ : nullptr);
}

int Cvode::linear_system(sunrealtype t, N_Vector y, N_Vector, SUNMatrix, sunbooleantype,
                         sunbooleantype* jcur, sunrealtype gamma, void* self, N_Vector, N_Vector,
                         N_Vector) {
  auto& me = *static_cast<Cvode*>(self);
  *jcur = SUNTRUE;
  return me.failure_.guard([&] { return me.calc_linear_system(t, NV_DATA_S(y), gamma) ? 0 : 1; });
}

bool Cvode::calc_linear_system(double t, const double* y, double gamma) {
  c_ = 1.0 / gamma;
  const double* q = q_of(y);
  if (!dynamics_.calc_accelerations(t, q, v_of(y), z_of(y), a_.data(), lambda_.data(), nullptr,
                                    nullptr))
    return false;
  equations_->evaluate(t, c_, q, v_of(y), z_of(y), lambda_.data(), a_.data());
  std::copy_n(dynamics_.system().G(), G_.size(), G_.begin());
  return true;
}

// They do not depend on y, so SUNDIALS need not compute them anew in every step.
int Cvode::weights(N_Vector, N_Vector weights, void* self) {
  N_VScale(1.0, static_cast<Cvode*>(self)->weights_, weights);
  return 0;
}

int Cvode::setup(SUNLinearSolver solver, SUNMatrix) {
  return static_cast<Cvode*>(solver->content)->equations_->factorise() ? 0 : 1;
}

int Cvode::solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) {
  static_cast<Cvode*>(solver->content)->solve(NV_DATA_S(b), NV_DATA_S(x));
  return 0;
}

void Cvode::solve(const double* b, double* x) {
  System& system = dynamics_.system();
  const int lambda = equations_->lambda();
  for (int i = 0; i < lambda; ++i) x_[static_cast<std::size_t>(i)] = c_ * b[i];
  double* x_v = x_.data() + equations_->v();
  double* x_l = x_.data() + lambda;
  std::fill_n(x_l, system.rows(), 0.0);
  std::copy(G_.begin(), G_.end(), system.G());
  system.add_jacobian_times(x_v, x_l);
  for (const int i : system.dropped_rows()) x_l[i] = 0.0;
  for (int i = 0; i < n_; ++i) x_v[i] *= system.mass()[static_cast<std::size_t>(i)];
  equations_->solve(x_.data());
  std::copy_n(x_.data(), lambda, x);
  std::copy_n(b + lambda, quadratures_, x + lambda);
}

int Cvode::project(sunrealtype t, N_Vector y, N_Vector correction, sunrealtype, N_Vector,
                   void* self) {
  auto& me = *static_cast<Cvode*>(self);
  return me.failure_.guard(
      [&] { return me.project(t, NV_DATA_S(y), NV_DATA_S(correction)) ? 0 : 1; });
}

bool Cvode::project(double t, const double* y, double* correction) {
  double* q = q_of(y);
  std::copy_n(y + n_, n_, v_.begin());
  if (!dynamics_.project(t, q, v_.data(), Correction::smooth)) {
    failure_.text =
        fmt::format("positions cannot be projected on the constraints; worst equation '{}'",
                    dynamics_.system().equation_name(dynamics_.worst_row()));
    return false;
  }
  std::fill_n(correction, size_, 0.0);
  for (int i = 0; i < n_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    correction[i] = q[i] - q_start_[k] - y[i];
    correction[n_ + i] = v_[k] - y[n_ + i];
  }
  return true;
}

int Cvode::events(sunrealtype t, N_Vector y_vector, sunrealtype* g, void* self) {
  auto& me = *static_cast<Cvode*>(self);
  const double* y = NV_DATA_S(y_vector);
  return me.failure_.guard(
      [&] { return me.guard_.evaluate(t, me.q_of(y), me.v_of(y), me.z_of(y), g) ? 0 : -1; });
}

void Cvode::on_error(int code, const char*, const char*, char* message, void* self) {
  static_cast<Cvode*>(self)->failure_.report(code, message);
}

}  // namespace

std::unique_ptr<Formulation> make_cvode_projection(Dynamics& dynamics,
                                                   const Tolerances& tolerances) {
  return std::make_unique<Cvode>(dynamics, tolerances, Method::bdf_projection);
}

std::unique_ptr<Formulation> make_adams_baumgarte(Dynamics& dynamics,
                                                  const Tolerances& tolerances) {
  return std::make_unique<Cvode>(dynamics, tolerances, Method::adams_baumgarte);
}

}  // namespace yoke
