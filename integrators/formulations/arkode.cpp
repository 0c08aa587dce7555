// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Explicit Runge-Kutta on the accelerations of the saddle system, y = (q, v, z, energies), by
// ARKODE. Two ways to stay on the constraints: projection of positions and velocities after every
// step (in the metric of the masses), or Baumgarte's stabilisation. Order 5(4) of Dormand and
// Prince. ARKODE's dense output is an order worse than its steps, and a train of bounces is only as
// good as its events. So samples and events are taken from a step of our own with the same
// coefficients, from the start of ARKODE's step to the time wanted; a root that ARKODE located on
// its dense output is polished on such steps.
#include <yoke/integrators/formulations/sundials_stepper.hpp>
#include <yoke/integrators/sundials/compatibility.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace yoke {

namespace {

constexpr int max_error_test_failures = 30;
constexpr ARKODE_ERKTableID tableau = ARKODE_DORMAND_PRINCE_7_4_5;
constexpr double nowhere = std::numeric_limits<double>::infinity();
constexpr double cautious = 0.8;  // of a step that is planned: behind a restart more are rejected
constexpr double reached = 1.0 + 1e-9;  // a step that comes so near to a stop ends there
// Of the polynomial on which ARKODE looks for roots; one more would cost an evaluation in each step, and
// roots are made exact on steps of our own.
constexpr int interpolant = 3;
// In units of the error weights; a step that is within its tolerance needs about one.
constexpr double largest_projection = 1e4;

class Arkode final : public SundialsStepper {
 public:
  Arkode(Dynamics& dynamics, const Tolerances& tolerances, bool projects);
  ~Arkode() override;

  void start(const State& state) override;
  Step step(double t_stop) override;
  double last_step() const override;
  void interpolate(double t, State& state) override;
  void glance(double t, State& state) override;
  void look(double t, State& state, Dynamics& equations) override;
  void restart(const State& state) override;
  StepCounters counters() const override;

 private:
  static int rates(sunrealtype t, N_Vector y, N_Vector y_dot, void* self);
  static int project(sunrealtype t, N_Vector y, void* self);
  static int events(sunrealtype t, N_Vector y, sunrealtype* g, void* self);
  bool calc_rates(double t, const double* y, double* y_dot) override {
    return calc_rates(dynamics_, t, y, y_dot);
  }
  bool calc_rates(Dynamics& equations, double t, const double* y, double* y_dot);
  bool project(double t, double* y);
  void create(double t);
  void rebase();
  void set_stop(double t_stop);

  bool projects_;
  Baumgarte stabilisation_;
  void* memory_ = nullptr;
  std::vector<double> before_projection_;
  std::optional<OwnStep> look_step_;  // of looks, with the equations they were given last
  Dynamics* looking_ = nullptr;
  bool base_is_far_ = false;
  bool goes_on_ = false;           // behind a restart with the step size there was
  double natural_step_ = 0.0;      // [s] one that may be made if no stop cuts it short
  double planned_step_ = nowhere;  // [s] ARKODE's next one, or nowhere: not known
};

Arkode::Arkode(Dynamics& dynamics, const Tolerances& tolerances, bool projects)
    : SundialsStepper(dynamics, tolerances,
                      2 * dynamics.system().dofs() + dynamics.system().states(), one_step),
      projects_(projects),
      stabilisation_(critically_damped(tolerances)) {
  before_projection_ = q_start_;
}

Arkode::~Arkode() {
  if (memory_ != nullptr) ARKodeFree(&memory_);
}

void Arkode::create(double t) {
  memory_ = ERKStepCreate(&Arkode::rates, t, y_, context_);
  context_.report_errors_of(SundialsPackage::arkode, memory_);
  ARKodeSetUserData(memory_, user_data());
  ERKStepSetTableNum(memory_, tableau);
  ARKodeWFtolerances(memory_, &Arkode::calc_weights);
  ARKodeSetMaxErrTestFails(memory_, max_error_test_failures);
  ARKodeSetInterpolantDegree(memory_, interpolant);
  if (projects_) ARKodeSetPostprocessStepFn(memory_, &Arkode::project);
  if (guard_.count() > 0) {
    ARKodeRootInit(memory_, guard_.count(), &Arkode::events);
    ARKodeSetRootDirection(memory_, directions().data());
    ARKodeSetNoInactiveRootWarn(memory_);
  }
}

void Arkode::start(const State& state) {
  pack(state);
  t_ = state.t;
  t_stop_ = t_;  // not set yet
  end_step();
  base_is_far_ = false;
  natural_step_ = 0.0;
  planned_step_ = nowhere;
  goes_on_ = false;
  guard_.start(state);
  if (memory_ == nullptr) {
    create(state.t);
  } else {
    before_ = counters();
    ERKStepReInit(memory_, &Arkode::rates, state.t, y_);
    ARKodeSetInitStep(memory_, 0.0);  // it chooses
  }
  set_weights();
}

// Steps to the next stop are then all of one length, no longer than the natural one.
void Arkode::restart(const State& state) {
  const double h = natural_step_;
  start(state);
  natural_step_ = h;
  goes_on_ = h > 0.0;
}

// Before a step, when nobody asks for the last one any more.
void Arkode::rebase() {
  base_is_far_ = false;
  std::ranges::copy(end_, y());
  move_base();
  end_step();
  ARKodeReset(memory_, t_end_, y_);
  t_stop_ = t_end_;  // it has forgotten that too
  planned_step_ = nowhere;
}

// ARKODE is told of a stop when the next step reaches it. If it knew before it would plan a step to
// there, and nobody would learn how long the step could have been.
void Arkode::set_stop(double t_stop) {
  double h = std::exchange(planned_step_, nowhere);
  if (goes_on_) {
    goes_on_ = false;
    const double rest = t_stop - t_;
    h = rest / std::ceil(rest / natural_step_);
    ARKodeSetInitStep(memory_, h);
  }
  if (t_ + reached * h < t_stop) t_stop = nowhere;
  if (t_stop == t_stop_) return;
  ARKodeSetStopTime(memory_, t_stop);
  t_stop_ = t_stop;
}

Step Arkode::step(double t_stop) {
  if (base_is_far_) rebase();
  set_stop(t_stop);
  begin_step();
  const int flag = ARKodeEvolve(memory_, t_stop, y_, &t_, ARK_ONE_STEP);
  if (flag < 0) {
    undo_step();  // the last good step stays the one to interpolate
    ARKodeGetCurrentTime(memory_, &t_);
    return Step::failed;
  }
  end_step();
  if (flag == ARK_ROOT_RETURN) {
    ARKodeGetRootInfo(memory_, found_.data());
    double t_limit = t_;
    ARKodeGetCurrentTime(memory_, &t_limit);
    refine_event(t_limit);
    end_step();
    collect_events();
    return Step::event;
  }
  if (t_stop_ == nowhere) {  // at a stop it does not say what it plans
    ARKodeGetCurrentStep(memory_, &planned_step_);
    natural_step_ = cautious * planned_step_;
  }
  natural_step_ = std::max(natural_step_, t_ - t_begin_);
  accept_step();
  base_is_far_ = is_far_from_base();
  return Step::advanced;
}

double Arkode::last_step() const {
  double h = 0.0;
  if (memory_ != nullptr) ARKodeGetLastStep(memory_, &h);
  return h;
}

void Arkode::interpolate(double t, State& state) {
  if (t == t_end_) {
    std::copy_n(end_.begin(), size_, y());
  } else if (!own_step_.to(t, y())) {
    ARKodeGetDky(memory_, t, 0, y_);
  }
  unpack(t, state);
}

void Arkode::look(double t, State& state, Dynamics& equations) {
  if (t == t_end_) return interpolate(t, state);
  looking_ = &equations;
  if (!look_step_)
    look_step_.emplace(size_, [this](double at, const double* y, double* y_dot) {
      return calc_rates(*looking_, at, y, y_dot);
    });
  look_step_->from(t_begin_, begin_.data());
  if (!look_step_->to(t, y())) ARKodeGetDky(memory_, t, 0, y_);
  unpack(t, state);
}

// Positions by Hermite's cubic and velocities by its derivative, the rest linear.
void Arkode::glance(double t, State& state) {
  const double h = t_end_ - t_begin_, s = h > 0.0 ? (t - t_begin_) / h : 1.0;
  for (std::size_t i = 0; i < end_.size(); ++i) y()[i] = begin_[i] + s * (end_[i] - begin_[i]);
  for (int i = 0; h > 0.0 && i < n_; ++i) {
    const auto k = static_cast<std::size_t>(i), v = k + static_cast<std::size_t>(n_);
    const double mean = (end_[k] - begin_[k]) / h;
    const double a = begin_[v] - mean, b = end_[v] - mean;
    y()[i] += h * s * (1.0 - s) * ((1.0 - s) * a - s * b);
    y()[n_ + i] = mean + (1.0 - s) * (1.0 - 3.0 * s) * a + s * (3.0 * s - 2.0) * b;
  }
  unpack(t, state);
}

StepCounters Arkode::counters() const {
  StepCounters total = before_;
  total.raised = floor_.raised();
  if (memory_ == nullptr) return total;
  long steps = 0, failures = 0;
  ARKodeGetNumSteps(memory_, &steps);
  ARKodeGetNumErrTestFails(memory_, &failures);
  total.steps += steps;
  total.rejected += failures;
  return total;
}

int Arkode::rates(sunrealtype t, N_Vector y, N_Vector y_dot, void* self) {
  auto& me = from<Arkode>(self);
  return me.failure_.guard([&] {
    return me.calc_rates(t, NV_DATA_S(y), NV_DATA_S(y_dot)) ? 0 : 1;  // 1: try a shorter step
  });
}

bool Arkode::calc_rates(Dynamics& equations, double t, const double* y, double* y_dot) {
  std::copy_n(y + n_, n_, y_dot);
  return equations.calc_accelerations(
      {.t = t, .q = q_of(y), .v = v_of(y), .z = z_of(y)},
      {.a = y_dot + n_, .z_dot = y_dot + 2 * n_, .quadrature_rates = y_dot + 2 * n_ + nz_},
      projects_ ? nullptr : &stabilisation_);
}

int Arkode::project(sunrealtype t, N_Vector y_vector, void* self) {
  auto& me = from<Arkode>(self);
  return me.failure_.guard([&] { return me.project(t, NV_DATA_S(y_vector)) ? 0 : -1; });
}

bool Arkode::project(double t, double* y) {
  double* q = q_of(y);
  std::copy_n(q, n_, before_projection_.begin());
  if (!dynamics_.project(t, q, y + n_)) {
    report_failed_projection();
    return false;
  }
  double moved = 0.0;  // in units of the error weights
  for (int i = 0; i < n_; ++i) {
    // Displacements know more digits than absolute positions: only the correction is taken over.
    const double correction = q[i] - before_projection_[static_cast<std::size_t>(i)];
    moved = std::max(moved, std::abs(correction) * weights_.data()[i]);
    y[i] += correction;
  }
  if (moved < largest_projection) return true;
  failure_.text = fmt::format(
      "a driver or joint jumps: the projection would move the mechanism by {:.0e} times the "
      "tolerance in one step",
      moved);
  return false;
}

int Arkode::events(sunrealtype t, N_Vector y, sunrealtype* g, void* self) {
  auto& me = from<Arkode>(self);
  return me.failure_.guard([&] { return me.evaluate_events(t, NV_DATA_S(y), g) ? 0 : -1; });
}

}  // namespace

std::unique_ptr<Formulation> make_arkode_projection(Dynamics& dynamics,
                                                    const Tolerances& tolerances) {
  return std::make_unique<Arkode>(dynamics, tolerances, true);
}

std::unique_ptr<Formulation> make_arkode_baumgarte(Dynamics& dynamics,
                                                   const Tolerances& tolerances) {
  return std::make_unique<Arkode>(dynamics, tolerances, false);
}

}  // namespace yoke
