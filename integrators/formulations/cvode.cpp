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
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <yoke/integrators/formulations/equations/acceleration_matrix.hpp>
#include <yoke/integrators/formulations/sundials_stepper.hpp>
#include <yoke/integrators/sundials/linear_solver.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace yoke {

namespace {

// What the fixed-point iteration leaves, in tolerances. It is noise in the history of the method,
// on which its order and steps depend; CVODE's own 0.1 costs more steps than it saves iterations.
constexpr double iteration_error = 0.01;
// Of the tolerances of bodies in contacts: what a step of Adams may err by. Its errors have one sign
// throughout an impact and add up to hundreds of tolerances of its speed; a fifth costs a fifth more steps.
constexpr double share_in_contacts = 0.2;

enum class Method { bdf_projection, adams_baumgarte };

class Cvode final : public SundialsStepper {
 public:
  Cvode(Dynamics& dynamics, const Tolerances& tolerances, Method method);
  ~Cvode() override;

  void start(const State& state) override;
  Step step(double t_stop) override;
  double last_step() const override;
  void interpolate(double t, State& state) override;
  StepCounters counters() const override;

 private:
  static int rates(sunrealtype t, N_Vector y, N_Vector y_dot, void* self);
  static int linear_system(sunrealtype t, N_Vector y, N_Vector fy, SUNMatrix matrix,
                           sunbooleantype jok, sunbooleantype* jcur, sunrealtype gamma, void* self,
                           N_Vector, N_Vector, N_Vector);
  static int project(sunrealtype t, N_Vector y, N_Vector correction, sunrealtype epsilon,
                     N_Vector error, void* self);
  static int events(sunrealtype t, N_Vector y, sunrealtype* g, void* self);
  bool calc_rates(double t, const double* y, double* y_dot) override;
  bool calc_linear_system(double t, const double* y, double gamma);
  void solve(const double* b, double* x);
  bool project(double t, const double* y, double* correction);
  void create(double t);
  void attach_newton();
  void attach_fixed_point();

  std::optional<AccelerationMatrix> equations_;  // BDF's
  std::optional<OwnLinearSolver> solver_;        // BDF's
  std::optional<Baumgarte> stabilisation_;       // that of Adams
  SUNNonlinearSolver fixed_point_ = nullptr;     // that of Adams
  void* memory_ = nullptr;
  SundialsVector slope_;  // of the dense output
  std::vector<double> v_, a_, lambda_, x_, before_projection_;
  std::vector<double> G_;  // blocks at the point of the matrix
  double c_ = 1.0;
};

Tolerances tighter_in_contacts(const System& system, const Tolerances& tolerances) {
  Tolerances tighter = tolerances;
  for (const ForceSlot& f : system.forces())
    for (int j = 0; f.element->penetration_scale() > 0.0 && j < f.columns; ++j) {
      const int dof = system.dof()[static_cast<std::size_t>(f.dofs + j)];
      if (dof < 0) continue;
      tighter.q[dof] = share_in_contacts * tolerances.q[dof];
      tighter.v[dof] = share_in_contacts * tolerances.v[dof];
      tighter.relative =
          share_in_contacts * tolerances.relative;  // by which a speed counts as high
    }
  return tighter;
}

Cvode::Cvode(Dynamics& dynamics, const Tolerances& tolerances, Method method)
    : SundialsStepper(dynamics,
                      method == Method::adams_baumgarte
                          ? tighter_in_contacts(dynamics.system(), tolerances)
                          : tolerances,
                      2 * dynamics.system().dofs() + dynamics.system().states(), multistep),
      slope_(size_, context_, &groups_) {
  v_ = a_ = before_projection_ = q_start_;
  lambda_.assign(static_cast<std::size_t>(dynamics.system().rows()), 0.0);
  if (method == Method::adams_baumgarte) {
    stabilisation_ = critically_damped(tolerances);
    fixed_point_ = SUNNonlinSol_FixedPoint(y_, 0, context_);
    return;
  }
  equations_.emplace(dynamics.system());
  x_.assign(static_cast<std::size_t>(equations_->size()), 0.0);
  G_.assign(dynamics.system().jacobian_size(), 0.0);
  const LinearSolverCalls calls = {
      .setup = [](void* me) { return static_cast<Cvode*>(me)->equations_->factorise() ? 0 : 1; },
      .solve =
          [](void* me, N_Vector x, N_Vector b) {
            static_cast<Cvode*>(me)->solve(NV_DATA_S(b), NV_DATA_S(x));
            return 0;
          }};
  solver_.emplace(this, calls, context_);
}

Cvode::~Cvode() {
  if (memory_ != nullptr) CVodeFree(&memory_);
  if (fixed_point_ != nullptr) SUNNonlinSolFree(fixed_point_);
}

void Cvode::create(double t) {
  memory_ = CVodeCreate(equations_ ? CV_BDF : CV_ADAMS, context_);
  context_.report_errors_of(SundialsPackage::cvode, memory_);
  CVodeInit(memory_, &Cvode::rates, t, y_);
  CVodeSetUserData(memory_, user_data());
  set_weights();
  CVodeWFtolerances(memory_, &Cvode::calc_weights);
  equations_ ? attach_newton() : attach_fixed_point();
  CVodeSetMaxErrTestFails(memory_, 30);
  if (std::isfinite(tolerances_.longest_step)) CVodeSetMaxStep(memory_, tolerances_.longest_step);
  CVodeSetMaxConvFails(memory_, 30);
  if (guard_.count() > 0) {
    CVodeRootInit(memory_, guard_.count(), &Cvode::events);
    CVodeSetRootDirection(memory_, directions().data());
    CVodeSetNoInactiveRootWarn(memory_);
  }
}

void Cvode::attach_newton() {
  CVodeSetLinearSolver(memory_, solver_->solver(), solver_->matrix());
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
  end_step();
  guard_.start(state);
  if (memory_ == nullptr) {
    create(state.t);
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
  begin_step();
  const int flag = CVode(memory_, t_stop, y_, &t_, CV_ONE_STEP);
  // With the fixed-point iteration CVODE tries shorter steps even after an exception.
  if (flag < 0 || failure_.thrown) {
    undo_step();
    CVodeGetCurrentTime(memory_, &t_);
    return Step::failed;
  }
  if (flag == CV_ROOT_RETURN) {
    CVodeGetRootInfo(memory_, found_.data());
    double t_limit = t_;
    CVodeGetCurrentTime(memory_, &t_limit);
    CVodeGetErrWeights(memory_, sensible_weights_);
    CVodeGetDky(memory_, t_, 1, slope_);
    refine_event_if_rough(t_limit, slope_.data());
    end_step();
    collect_events();
    return Step::event;
  }
  end_step();
  accept_step();
  return Step::advanced;
}

double Cvode::last_step() const {
  double h = 0.0;
  if (memory_ != nullptr) CVodeGetLastStep(memory_, &h);
  return h;
}

void Cvode::interpolate(double t, State& state) {
  if (t == t_end_)
    std::copy_n(end_.begin(), size_, y());
  else
    CVodeGetDky(memory_, t, 0, y_);
  unpack(t, state);
}

StepCounters Cvode::counters() const {
  StepCounters total = before_;
  total.raised = floor_.raised();
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
  auto& me = from<Cvode>(self);
  return me.failure_.guard([&] {
    return me.calc_rates(t, NV_DATA_S(y), NV_DATA_S(y_dot)) ? 0 : 1;  // 1: try a shorter step
  });
}

bool Cvode::calc_rates(double t, const double* y, double* y_dot) {
  std::copy_n(y + n_, n_, y_dot);
  return dynamics_.calc_accelerations(
      {.t = t, .q = q_of(y), .v = v_of(y), .z = z_of(y)},
      {.a = y_dot + n_, .z_dot = y_dot + 2 * n_, .quadrature_rates = y_dot + 2 * n_ + nz_},
      stabilisation_ ? &*stabilisation_ : nullptr);
}

int Cvode::linear_system(sunrealtype t, N_Vector y, N_Vector, SUNMatrix, sunbooleantype,
                         sunbooleantype* jcur, sunrealtype gamma, void* self, N_Vector, N_Vector,
                         N_Vector) {
  auto& me = from<Cvode>(self);
  *jcur = SUNTRUE;
  return me.failure_.guard([&] { return me.calc_linear_system(t, NV_DATA_S(y), gamma) ? 0 : 1; });
}

bool Cvode::calc_linear_system(double t, const double* y, double gamma) {
  c_ = 1.0 / gamma;
  const double* q = q_of(y);
  if (!dynamics_.calc_accelerations({.t = t, .q = q, .v = v_of(y), .z = z_of(y)},
                                    {.a = a_.data(), .lambda = lambda_.data()}))
    return false;
  equations_->evaluate(t, c_, q, v_of(y), z_of(y), lambda_.data(), a_.data());
  std::copy_n(dynamics_.system().G(), G_.size(), G_.begin());
  return true;
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
  auto& me = from<Cvode>(self);
  return me.failure_.guard(
      [&] { return me.project(t, NV_DATA_S(y), NV_DATA_S(correction)) ? 0 : 1; });
}

bool Cvode::project(double t, const double* y, double* correction) {
  double* q = q_of(y);
  std::copy_n(q, n_, before_projection_.begin());
  std::copy_n(y + n_, n_, v_.begin());
  if (!dynamics_.project(t, q, v_.data(), Correction::smooth)) {
    report_failed_projection();
    return false;
  }
  std::fill_n(correction, size_, 0.0);
  for (int i = 0; i < n_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    correction[i] = q[i] - before_projection_[k];
    correction[n_ + i] = v_[k] - y[n_ + i];
  }
  return true;
}

int Cvode::events(sunrealtype t, N_Vector y, sunrealtype* g, void* self) {
  auto& me = from<Cvode>(self);
  return me.failure_.guard([&] { return me.evaluate_events(t, NV_DATA_S(y), g) ? 0 : -1; });
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
