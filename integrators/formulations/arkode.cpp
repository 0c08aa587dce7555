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
#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>

#include <yoke/integrators/formulations/event_guard.hpp>
#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/sundials/callback_failure.hpp>
#include <yoke/integrators/sundials/vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace yoke {

namespace {

constexpr int max_error_test_failures = 30;
constexpr ARKODE_ERKTableID method = ARKODE_DORMAND_PRINCE_7_4_5;
constexpr int max_polish_iterations = 6;
// Of the step: secant steps converge with order 1.6, so the next one would move by 1e-11 of it.
constexpr double polished = 1e-7;
// In units of the error weights; a step that is within its tolerance needs about one.
constexpr double largest_projection = 1e4;

class Arkode final : public Formulation {
 public:
  Arkode(Dynamics& dynamics, const Tolerances& tolerances, bool projects);
  ~Arkode() override;

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
  static int weights(N_Vector y, N_Vector weights, void* self);
  static int project(sunrealtype t, N_Vector y, void* self);
  bool project(double t, double* y);
  static int events(sunrealtype t, N_Vector y, sunrealtype* g, void* self);
  static void on_error(int code, const char* module, const char* function, char* message,
                       void* self);
  bool calc_rates(double t, const double* y, double* y_dot);
  /// y at a time inside the last step, by a step of our own from where it began.
  bool substep(double t);
  double calc_event(int slot, double t);
  void polish_root();
  void create(const State& state);
  void pack(const State& state);
  void set_weights();
  Step fail();

  double* y() { return NV_DATA_S(y_); }
  /// Positions for displacements y, in scratch.
  double* q_of(const double* y);
  const double* v_of(const double* y) const { return y + n_; }
  const double* z_of(const double* y) const { return y + 2 * n_; }

  Dynamics& dynamics_;
  Tolerances tolerances_;
  bool projects_;
  Baumgarte stabilisation_;
  EventGuard guard_;
  int n_, nz_, quadratures_, size_;
  SUNContext context_ = nullptr;
  void* memory_ = nullptr;
  N_Vector y_ = nullptr;
  N_Vector weights_ = nullptr;  // 1 / tolerance
  std::vector<double> q_start_, q_;
  ARKodeButcherTable table_ = nullptr;
  std::vector<double> begin_, end_, stage_;  // y where the last step began and ended
  std::vector<std::vector<double>> k_;       // rates of the stages of substep()
  std::vector<double> g_;
  double t_begin_ = 0.0, t_end_ = 0.0;
  bool first_rate_known_ = false;
  double t_ = 0.0;
  double t_stop_ = 0.0;
  std::vector<int> found_;
  StepCounters before_;  // of integrations before the last restart
  CallbackFailure failure_;
};

Arkode::Arkode(Dynamics& dynamics, const Tolerances& tolerances, bool projects)
    : dynamics_(dynamics),
      tolerances_(tolerances),
      projects_(projects),
      guard_(dynamics),
      n_(dynamics.system().dofs()),
      nz_(dynamics.system().states()),
      quadratures_(dynamics.system().quadratures()),
      size_(2 * n_ + nz_ + quadratures_) {
  const double rate =
      tolerances.baumgarte_rate > 0.0 ? tolerances.baumgarte_rate : tolerances.natural_rate;
  stabilisation_ = {.alpha = rate, .beta = rate};
  SUNContext_Create(nullptr, &context_);
  y_ = new_vector(size_, context_);
  weights_ = new_vector(size_, context_);
  found_.assign(static_cast<std::size_t>(guard_.count()), 0);
  failure_.text.reserve(512);
  q_start_.assign(static_cast<std::size_t>(n_), 0.0);
  q_ = q_start_;
  table_ = ARKodeButcherTable_LoadERK(method);
  begin_.assign(static_cast<std::size_t>(size_), 0.0);
  end_ = stage_ = begin_;
  k_.assign(static_cast<std::size_t>(table_->stages), begin_);
  g_.assign(found_.size(), 0.0);
}

double* Arkode::q_of(const double* y) {
  for (std::size_t i = 0; i < q_.size(); ++i) q_[i] = q_start_[i] + y[i];
  return q_.data();
}

Arkode::~Arkode() {
  if (memory_ != nullptr) ERKStepFree(&memory_);
  ARKodeButcherTable_Free(table_);
  N_VDestroy(y_);
  N_VDestroy(weights_);
  SUNContext_Free(&context_);
}

void Arkode::set_weights() {
  double* w = NV_DATA_S(weights_);
  for (int i = 0; i < n_; ++i)
    w[i] = std::max(tolerances_.q[i], rounding_of(q_start_[static_cast<std::size_t>(i)]));
  std::copy_n(tolerances_.v.data(), n_, w + n_);
  std::copy_n(tolerances_.z.data(), nz_, w + 2 * n_);
  std::fill_n(w + 2 * n_ + nz_, quadratures_, tolerances_.energy);
  for (int i = 0; i < size_; ++i) w[i] = 1.0 / w[i];
}

void Arkode::pack(const State& state) {
  std::copy_n(state.q.data(), n_, q_start_.begin());
  std::fill_n(y(), n_, 0.0);
  std::copy_n(state.v.data(), n_, y() + n_);
  std::copy_n(state.z.data(), nz_, y() + 2 * n_);
  std::copy_n(state.energy.data(), quadratures_, y() + 2 * n_ + nz_);
}

void Arkode::create(const State& state) {
  memory_ = ERKStepCreate(&Arkode::rates, state.t, y_, context_);
  ERKStepSetErrHandlerFn(memory_, &Arkode::on_error, this);
  ERKStepSetUserData(memory_, this);
  ERKStepSetTableNum(memory_, method);
  ERKStepWFtolerances(memory_, &Arkode::weights);
  ERKStepSetMaxErrTestFails(memory_, max_error_test_failures);
  if (projects_) ERKStepSetPostprocessStepFn(memory_, &Arkode::project);
  if (guard_.count() > 0) {
    ERKStepRootInit(memory_, guard_.count(), &Arkode::events);
    std::vector<int> upwards(found_.size(), 1);
    ERKStepSetRootDirection(memory_, upwards.data());
    ERKStepSetNoInactiveRootWarn(memory_);
  }
}

void Arkode::start(const State& state) {
  pack(state);
  t_ = state.t;
  t_stop_ = t_;  // not set yet
  std::copy_n(y(), size_, end_.begin());
  t_end_ = t_;
  guard_.start(state);
  if (memory_ == nullptr) {
    create(state);
  } else {
    before_ = counters();
    ERKStepReInit(memory_, &Arkode::rates, state.t, y_);
  }
  set_weights();
}

Step Arkode::step(double t_stop) {
  if (t_stop != t_stop_) {
    ERKStepSetStopTime(memory_, t_stop);
    t_stop_ = t_stop;
  }
  std::swap(begin_, end_);
  const double t_begin_before = std::exchange(t_begin_, t_end_);
  first_rate_known_ = false;
  const int flag = ERKStepEvolve(memory_, t_stop, y_, &t_, ARK_ONE_STEP);
  if (flag < 0) {
    std::swap(begin_, end_);  // the last good step stays the one to interpolate
    t_begin_ = t_begin_before;
    return fail();
  }
  std::copy_n(y(), size_, end_.begin());
  t_end_ = t_;
  if (flag == ARK_ROOT_RETURN) {
    ERKStepGetRootInfo(memory_, found_.data());
    polish_root();
    guard_.collect(t_, q_of(y()), v_of(y()), z_of(y()), found_);
    return Step::event;
  }
  guard_.accept(t_, q_of(y()), v_of(y()), z_of(y()));
  return Step::advanced;
}

Step Arkode::fail() {
  ERKStepGetCurrentTime(memory_, &t_);
  return Step::failed;
}

double Arkode::last_step() const {
  double h = 0.0;
  if (memory_ != nullptr) ERKStepGetLastStep(memory_, &h);
  return h;
}

bool Arkode::substep(double t) {
  const double h = t - t_begin_;
  const auto combine = [&](const double* weights, int count) {
    for (std::size_t i = 0; i < stage_.size(); ++i) {
      double sum = 0.0;
      for (int j = 0; j < count; ++j) sum += weights[j] * k_[static_cast<std::size_t>(j)][i];
      stage_[i] = begin_[i] + h * sum;
    }
  };
  if (!first_rate_known_) first_rate_known_ = calc_rates(t_begin_, begin_.data(), k_[0].data());
  if (!first_rate_known_) return false;
  int needed = table_->stages;
  while (table_->b[needed - 1] == 0.0) --needed;  // first same as last
  for (int i = 1; i < needed; ++i) {
    combine(table_->A[i], i);
    if (!calc_rates(t_begin_ + table_->c[i] * h, stage_.data(),
                    k_[static_cast<std::size_t>(i)].data()))
      return false;
  }
  combine(table_->b, needed);
  std::copy(stage_.begin(), stage_.end(), y());
  return true;
}

double Arkode::calc_event(int slot, double t) {
  if (!substep(t) || !guard_.evaluate(t, q_of(y()), v_of(y()), z_of(y()), g_.data()))
    return std::numeric_limits<double>::quiet_NaN();
  return g_[static_cast<std::size_t>(slot)];
}

// Secant steps from the root of the dense output; what does not converge nearby is left alone.
void Arkode::polish_root() {
  const auto slot = static_cast<int>(std::ranges::find(found_, 1) - found_.begin());
  if (slot == guard_.count()) return;
  const double h = t_ - t_begin_, close_enough = polished * h;
  double t_limit = t_;
  ERKStepGetCurrentTime(memory_, &t_limit);
  double t_last = t_ - 1e-3 * h, g_last = calc_event(slot, t_last);
  double t = t_, g = calc_event(slot, t);
  for (int i = 0; i < max_polish_iterations && g != g_last; ++i) {
    const double t_next = t - g * (t - t_last) / (g - g_last);
    if (!(std::abs(t_next - t_) < 0.1 * h && t_next <= t_limit)) break;  // NaN too
    t_last = std::exchange(t, t_next);
    if (std::abs(t - t_last) <= close_enough) {
      t_ = t;
      break;
    }
    g_last = std::exchange(g, calc_event(slot, t));
  }
  if (!substep(t_)) ERKStepGetDky(memory_, t_, 0, y_);
  std::copy_n(y(), size_, end_.begin());
  t_end_ = t_;
}

void Arkode::interpolate(double t, State& state) {
  if (t == t_end_) {
    std::copy_n(end_.begin(), size_, y());
  } else if (!substep(t)) {
    ERKStepGetDky(memory_, t, 0, y_);
  }
  state.t = t;
  std::copy_n(q_of(y()), n_, state.q.data());
  std::copy_n(y() + n_, n_, state.v.data());
  std::copy_n(y() + 2 * n_, nz_, state.z.data());
  std::copy_n(y() + 2 * n_ + nz_, quadratures_, state.energy.data());
}

StepCounters Arkode::counters() const {
  StepCounters total = before_;
  if (memory_ == nullptr) return total;
  long steps = 0, failures = 0;
  ERKStepGetNumSteps(memory_, &steps);
  ERKStepGetNumErrTestFails(memory_, &failures);
  total.steps += steps;
  total.rejected += failures;
  return total;
}

int Arkode::rates(sunrealtype t, N_Vector y, N_Vector y_dot, void* self) {
  auto& me = *static_cast<Arkode*>(self);
  return me.failure_.guard([&] {
    return me.calc_rates(t, NV_DATA_S(y), NV_DATA_S(y_dot)) ? 0 : 1;  // 1: try a shorter step
  });
}

bool Arkode::calc_rates(double t, const double* y, double* y_dot) {
  std::copy_n(y + n_, n_, y_dot);
  return dynamics_.calc_accelerations(t, q_of(y), v_of(y), z_of(y), y_dot + n_, nullptr,
                                      y_dot + 2 * n_, y_dot + 2 * n_ + nz_,
                                      projects_ ? nullptr : &stabilisation_);
}

// They do not depend on y, so SUNDIALS need not compute them anew in every step.
int Arkode::weights(N_Vector, N_Vector weights, void* self) {
  N_VScale(1.0, static_cast<Arkode*>(self)->weights_, weights);
  return 0;
}

int Arkode::project(sunrealtype t, N_Vector y_vector, void* self) {
  auto& me = *static_cast<Arkode*>(self);
  return me.failure_.guard([&] { return me.project(t, NV_DATA_S(y_vector)) ? 0 : -1; });
}

bool Arkode::project(double t, double* y) {
  double* q = q_of(y);
  if (dynamics_.project(t, q, y + n_)) {
    double moved = 0.0;  // in units of the error weights
    for (std::size_t i = 0; i < q_.size(); ++i) {
      const double projected = q[i] - q_start_[i];
      moved = std::max(moved, std::abs(projected - y[i]) * NV_DATA_S(weights_)[i]);
      y[i] = projected;
    }
    if (moved < largest_projection) return true;
    failure_.text = fmt::format(
        "a driver or joint jumps: the projection would move the mechanism by "
        "{:.0e} times the tolerance in one step",
        moved);
    return false;
  }
  failure_.text =
      fmt::format("positions cannot be projected on the constraints; worst equation '{}'",
                  dynamics_.system().equation_name(dynamics_.worst_row()));
  return false;
}

int Arkode::events(sunrealtype t, N_Vector y_vector, sunrealtype* g, void* self) {
  auto& me = *static_cast<Arkode*>(self);
  const double* y = NV_DATA_S(y_vector);
  return me.failure_.guard(
      [&] { return me.guard_.evaluate(t, me.q_of(y), me.v_of(y), me.z_of(y), g) ? 0 : -1; });
}

void Arkode::on_error(int code, const char*, const char*, char* message, void* self) {
  static_cast<Arkode*>(self)->failure_.report(code, message);
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
