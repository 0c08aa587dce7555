// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Explicit Runge-Kutta on the accelerations of the saddle system, y = (q, v, z, energies), by
// ARKODE. Two ways to stay on the constraints: projection of positions and velocities after every
// step (in the metric of the masses), or Baumgarte's stabilisation. Order 5(4) or 7(6), as it pays.
// ARKODE's dense output is worse than its steps, and a train of bounces is only as good as its
// events. So events are taken from a step of our own with the same coefficients, from the start of
// ARKODE's step to the time wanted; a root that ARKODE located on its dense output is polished on such
// steps. Samples are taken from a polynomial as good as the step, or from such steps where there is none.
#include <yoke/integrators/formulations/explicit/dense_step.hpp>
#include <yoke/integrators/formulations/explicit/order_choice.hpp>
#include <yoke/integrators/formulations/explicit/stability_watch.hpp>
#include <yoke/integrators/formulations/sundials_stepper.hpp>
#include <yoke/integrators/sundials/compatibility.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace yoke {

namespace {

constexpr int max_error_test_failures = 30;
constexpr double nowhere = std::numeric_limits<double>::infinity();
// Of a step that is planned: behind a restart more are rejected, least where only loads have changed.
constexpr double cautious = 0.8, less_cautious = 0.9;
constexpr double least_growth = 0.2, most_growth = 5.0;  // of a first step, to the next of its kind
constexpr double reached = 1.0 + 1e-9;  // a step that comes so near to a stop ends there
// Of the polynomial on which ARKODE looks for roots; one more would cost an evaluation in each step, and
// roots are made exact on steps of our own.
constexpr int interpolant = 3;
// In units of the error weights; a step that is within its tolerance needs about one.
constexpr double largest_projection = 1e4;
// A solution errs less than its judge allows, one of order 7 by far: so should what lies within its steps.
constexpr double below_judge = 10.0;
constexpr double least_error = 1e-6;  // that says something about the length of steps

/// One over the tolerances of q, v and z.
std::vector<double> weights_of(const Tolerances& tolerances) {
  std::vector<double> weights;
  for (const Eigen::VectorXd* each : {&tolerances.q, &tolerances.v, &tolerances.z})
    for (const double tolerance : *each) weights.push_back(1.0 / tolerance);
  return weights;
}

class Arkode final : public SundialsStepper {
 public:
  Arkode(Dynamics& dynamics, const Tolerances& tolerances, bool projects);
  ~Arkode() override;

  void start(const State& state) override;
  Step step(double t_stop) override;
  double last_step() const override;
  bool ends_projected() const override { return projects_; }
  bool is_bounded_by_stability() const override {
    return watches_[touching_ ? 1 : 0].bounds_steps();
  }
  void interpolate(double t, State& state) override;
  void sample(double t, State& state) override;
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
  bool recall_rates(double t, const double* y, double* y_dot);
  bool project(double t, double* y);
  struct Integrator {
    const ExplicitPair* pair = nullptr;
    void* memory = nullptr;  // ARKODE's, when it is needed
  };

  struct Slope;
  void keep(Slope& slope, const double* rates);
  void know_step();
  DenseStep::Norm norm();
  void create();
  void begin(int order, double first_step);
  void rebase();
  void set_stop(double t_stop);
  void compare_orders();
  void change_order();
  void note_first_step();
  double judge(const ExplicitPair& pair, double h);
  double cost(const ExplicitPair& pair, double h, double error) const;

  bool projects_;
  Baumgarte stabilisation_;
  OrderChoice choice_;
  std::array<StabilityWatch, 2> watches_;  // apart, touching
  StabilityWatch* watch_ = watches_.data();
  std::array<Integrator, 2> integrators_;
  Integrator* active_ = nullptr;
  double other_step_ = 0.0;  // [s] with which the other order would begin
  SundialsVector scratch_;
  std::vector<double> before_projection_;
  /// y' at an end of the last step, as far as ARKODE has asked for it.
  struct Slope {
    std::vector<double> rates{};  // [size]
    bool known = false;
  };
  Slope at_begin_, at_end_;
  const double* last_rates_ = nullptr;  // that ARKODE asked for last, since the last projection
  double t_rates_ = 0.0;                // [s]
  DenseStep dense_;
  /// The same of looks, with equations of their own.
  struct Look {
    OwnStep step;
    DenseStep dense;
    bool of_last_step = false;
  };
  std::optional<Look> look_;
  Dynamics* looking_ = nullptr;
  bool base_is_far_ = false;
  bool touching_ = false, begins_ = false;
  std::array<double, 2> first_steps_{};  // [s] apart, touching; 0: it chooses
  bool goes_on_ = false;                 // behind a restart with the step size there was
  double natural_step_ = 0.0;            // [s] one that may be made if no stop cuts it short
  double planned_step_ = nowhere;        // [s] ARKODE's next one, or nowhere: not known
};

Arkode::Arkode(Dynamics& dynamics, const Tolerances& tolerances, bool projects)
    : SundialsStepper(dynamics, tolerances,
                      2 * dynamics.system().dofs() + dynamics.system().states(), one_step),
      projects_(projects),
      stabilisation_(critically_damped(tolerances)),
      choice_(tolerances.relative, tolerances.order),
      watches_{{{weights_of(tolerances), n_}, {weights_of(tolerances), n_}}},
      integrators_{{{&explicit_pair(OrderChoice::low)}, {&explicit_pair(OrderChoice::high)}}},
      scratch_(size_, context_, &groups_),
      dense_(size_, n_,
             [this](double t, const double* y, double* y_dot) { return calc_rates(t, y, y_dot); }) {
  before_projection_ = q_start_;
  at_begin_.rates = at_end_.rates = end_;
}

Arkode::~Arkode() {
  for (Integrator& each : integrators_)
    if (each.memory != nullptr) ARKodeFree(&each.memory);
}

void Arkode::create() {
  void* memory = active_->memory = ERKStepCreate(&Arkode::rates, t_, y_, context_);
  context_.report_errors_of(SundialsPackage::arkode, memory);
  ARKodeSetUserData(memory, user_data());
  // It is copied.
  ERKStepSetTable(memory, const_cast<ARKodeButcherTable>(active_->pair->table));
  ARKodeWFtolerances(memory, &Arkode::calc_weights);
  ARKodeSetMaxErrTestFails(memory, max_error_test_failures);
  ARKodeSetInterpolantDegree(memory, interpolant);
  // SUNDIALS 6.4 takes a last stage at the end of the step for the first one of the next step, unless
  // something has been done to the solution.
  if (projects_)
    ARKodeSetPostprocessStepFn(memory, &Arkode::project);
  else if (!active_->pair->first_same_as_last)
    ARKodeSetPostprocessStepFn(memory, [](sunrealtype, N_Vector, void*) { return 0; });
  if (guard_.count() > 0) {
    ARKodeRootInit(memory, guard_.count(), &Arkode::events);
    ARKodeSetRootDirection(memory, directions().data());
    ARKodeSetNoInactiveRootWarn(memory);
  }
}

// Steps of an order from t_, y; the first one as it finds it good, or as long as told [s].
void Arkode::begin(int order, double first_step) {
  before_ = counters();
  active_ =
      &*std::ranges::find(integrators_, order, [](const Integrator& i) { return i.pair->order; });
  own_step_.use(*active_->pair);
  for (StabilityWatch& watch : watches_) watch.bound(active_->pair->stable);
  if (look_) look_->step.use(*active_->pair);
  if (active_->memory == nullptr)
    create();
  else
    ERKStepReInit(active_->memory, &Arkode::rates, t_, y_);
  ARKodeSetInitStep(active_->memory, first_step);
  t_stop_ = t_;  // not set yet
  planned_step_ = nowhere;
}

void Arkode::start(const State& state) {
  pack(state);
  t_ = state.t;
  end_step();
  base_is_far_ = false;
  natural_step_ = 0.0;
  goes_on_ = false;
  guard_.start(state);
  at_end_.known = false;
  know_step();
  touching_ = touches(state);
  choice_.start(touching_);
  watch_ = &watches_[touching_ ? 1 : 0];
  begins_ = true;
  begin(choice_.order(), first_steps_[touching_ ? 1 : 0]);
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
  ARKodeReset(active_->memory, t_end_, y_);
  t_stop_ = t_end_;  // it has forgotten that too
  planned_step_ = nowhere;
}

// Spans between events are alike: where something touches now, the step begins as it could have begun the
// last time. ARKODE's own first steps are so short that in a rattling joint they are a third of all.
void Arkode::note_first_step() {
  const double h = t_ - t_begin_;
  double next = 0.0;
  ARKodeGetCurrentStep(active_->memory, &next);
  first_steps_[touching_ ? 1 : 0] = std::clamp(cautious * next, least_growth * h, most_growth * h);
}

// Before a step, likewise.
void Arkode::change_order() {
  std::ranges::copy(end_, y());
  begin(choice_.order(), other_step_);
}

// ARKODE is told of a stop when the next step reaches it. If it knew before it would plan a step to
// there, and nobody would learn how long the step could have been.
void Arkode::set_stop(double t_stop) {
  double h = std::exchange(planned_step_, nowhere);
  if (goes_on_) {
    goes_on_ = false;
    const double rest = t_stop - t_;
    h = rest / std::ceil(rest / natural_step_);
    ARKodeSetInitStep(active_->memory, h);
  }
  if (t_ + reached * h < t_stop) t_stop = nowhere;
  if (t_stop == t_stop_) return;
  ARKodeSetStopTime(active_->memory, t_stop);
  t_stop_ = t_stop;
}

// [error weights] Of a step from where the last one began, by a pair that is not the active one.
double Arkode::judge(const ExplicitPair& pair, double h) {
  own_step_.use(pair);
  know_begin(begin_rates_);
  const double t = t_begin_ + h;
  double error = nowhere;
  if (own_step_.to(t, scratch_.data()))
    error = own_step_.error(t, scratch_.data(), [this](const double* e) { return norm_of(e); });
  own_step_.use(*active_->pair);
  know_begin(begin_rates_);
  return error;
}

// [1/s] Evaluations per time, in steps of the length at which the error would be one.
double Arkode::cost(const ExplicitPair& pair, double h, double error) const {
  const double longer = std::pow(std::max(error, least_error), -1.0 / pair.order);
  return pair.evaluations(projects_) / (longer * h);
}

// On the step that has just been made. The other pair makes it too, or half of it if it is the one for
// shorter steps.
void Arkode::compare_orders() {
  const ExplicitPair &active = *active_->pair,
                     &other = *integrators_[active_ == integrators_.data() ? 1 : 0].pair;
  const bool up = other.order > active.order;
  const double h = t_end_ - t_begin_, h_other = up ? h : 0.5 * h;
  if (ARKodeGetEstLocalErrors(active_->memory, scratch_) != ARK_SUCCESS) return;
  calc_weights(y_, sensible_weights_, user_data());
  const double here = cost(active, h, norm_of(scratch_.data()));
  const double there = cost(other, h_other, judge(other, h_other));
  up ? choice_.compare(here, there) : choice_.compare(there, here);
  other_step_ = cautious * other.evaluations(projects_) / there;
}

Step Arkode::step(double t_stop) {
  if (base_is_far_) rebase();
  if (choice_.order() != active_->pair->order) change_order();
  set_stop(t_stop);
  begin_step();
  std::swap(at_begin_, at_end_);
  at_end_.known = false;
  last_rates_ = nullptr;
  watch_->begin_step();
  const bool first = std::exchange(begins_, false);
  void* const memory = active_->memory;
  const int flag = ARKodeEvolve(memory, t_stop, y_, &t_, ARK_ONE_STEP);
  if (flag < 0) {
    undo_step();  // the last good step stays the one to interpolate
    std::swap(at_begin_, at_end_);
    know_step();
    ARKodeGetCurrentTime(memory, &t_);
    return Step::failed;
  }
  end_step();
  know_step();
  if (flag == ARK_ROOT_RETURN) {
    ARKodeGetRootInfo(memory, found_.data());
    double t_limit = t_;
    ARKodeGetCurrentTime(memory, &t_limit);
    refine_event(t_limit);
    end_step();
    know_step();
    collect_events();
    return Step::event;
  }
  if (t_stop_ == nowhere) {  // at a stop it does not say what it plans
    ARKodeGetCurrentStep(memory, &planned_step_);
    natural_step_ = less_cautious * planned_step_;
  }
  natural_step_ = std::max(natural_step_, t_ - t_begin_);
  watch_->end_step(t_ - t_begin_);
  if (first) note_first_step();
  if (last_rates_ != nullptr && t_rates_ == t_end_) {
    keep(at_end_, last_rates_);
    know_step();
  }
  accept_step();
  base_is_far_ = is_far_from_base();
  if (choice_.count()) compare_orders();
  return Step::advanced;
}

double Arkode::last_step() const {
  double h = 0.0;
  if (active_ != nullptr) ARKodeGetLastStep(active_->memory, &h);
  return h;
}

void Arkode::interpolate(double t, State& state) {
  if (t == t_end_) {
    std::copy_n(end_.begin(), size_, y());
  } else if (!own_step_.to(t, y())) {
    ARKodeGetDky(active_->memory, t, 0, y_);
  }
  unpack(t, state);
}

void Arkode::sample(double t, State& state) {
  if (t == t_end_) return interpolate(t, state);
  const bool good = dense_.raise(norm());
  // The next step begins with what it needed at the end of this one.
  if (!at_end_.known && dense_.end_rates() != nullptr) keep(at_end_, dense_.end_rates());
  if (!good) return interpolate(t, state);
  dense_.at(t, y());
  unpack(t, state);
}

void Arkode::look(double t, State& state, Dynamics& equations) {
  if (t == t_end_) return interpolate(t, state);
  looking_ = &equations;
  const auto rates = [this](double at, const double* y, double* y_dot) {
    return calc_rates(*looking_, at, y, y_dot);
  };
  if (!look_) {
    look_.emplace(Look{.step = OwnStep(size_, rates), .dense = DenseStep(size_, n_, rates)});
    look_->step.use(*active_->pair);
  }
  if (!std::exchange(look_->of_last_step, true)) {
    look_->step.from(t_begin_, begin_.data(), begin_rates_);
    look_->dense.from({.t = t_begin_, .y = begin_.data(), .rates = begin_rates_},
                      {.t = t_end_, .y = end_.data()});
  }
  if (look_->dense.raise(norm()))
    look_->dense.at(t, y());
  else if (!look_->step.to(t, y()))
    ARKodeGetDky(active_->memory, t, 0, y_);
  unpack(t, state);
}

void Arkode::glance(double t, State& state) {
  dense_.at(t, y());
  unpack(t, state);
}

/// By the weights of the last step.
DenseStep::Norm Arkode::norm() {
  const double stricter = active_->pair->order == OrderChoice::high ? below_judge : 1.0;
  return [this, stricter](const double* error) {
    ARKodeGetErrWeights(active_->memory, sensible_weights_);
    return stricter * norm_of(error);
  };
}

/// The last step, which is another one now.
void Arkode::know_step() {
  know_begin(at_begin_.known ? at_begin_.rates.data() : nullptr);
  dense_.from(
      {.t = t_begin_, .y = begin_.data(), .rates = begin_rates_},
      {.t = t_end_, .y = end_.data(), .rates = at_end_.known ? at_end_.rates.data() : nullptr});
  if (look_) look_->of_last_step = false;
}

StepCounters Arkode::counters() const {
  StepCounters total = before_;
  total.raised = floor_.raised();
  if (active_ == nullptr) return total;
  long steps = 0, failures = 0;
  ARKodeGetNumSteps(active_->memory, &steps);
  ARKodeGetNumErrTestFails(active_->memory, &failures);
  total.steps += steps;
  total.rejected += failures;
  return total;
}

int Arkode::rates(sunrealtype t, N_Vector y, N_Vector y_dot, void* self) {
  auto& me = from<Arkode>(self);
  return me.failure_.guard([&] {
    double* y_dot_data = NV_DATA_S(y_dot);
    if (me.recall_rates(t, NV_DATA_S(y), y_dot_data)) return 0;
    if (!me.calc_rates(t, NV_DATA_S(y), y_dot_data)) return 1;  // try a shorter step
    me.watch_->see(t, NV_DATA_S(y), y_dot_data);
    me.last_rates_ = y_dot_data;
    me.t_rates_ = t;
    if (t == me.t_begin_ && !me.at_begin_.known) me.keep(me.at_begin_, y_dot_data);
    return 0;
  });
}

// Where the step begins, if a sample of the last one needed them.
bool Arkode::recall_rates(double t, const double* y, double* y_dot) {
  if (t != t_begin_ || !at_begin_.known || !std::equal(y, y + size_, begin_.begin())) return false;
  std::ranges::copy(at_begin_.rates, y_dot);
  return true;
}

void Arkode::keep(Slope& slope, const double* rates) {
  std::copy_n(rates, size_, slope.rates.begin());
  slope.known = true;
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
  last_rates_ = nullptr;
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
