// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/stiffness_switch.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include <yoke/integrators/formulations/event_guard.hpp>

namespace yoke {

namespace {

// Of the tolerance, BDF's. But not at once: what stability left to explicit steps is a ripple as large as
// the tolerance, which has to be damped and not to be followed.
constexpr double tighter = 0.05;
// In evaluations (measured on the friction cases); a step is work beside them.
constexpr double work_of_jacobian = 5.0, work_of_step = 2.0;
constexpr double work_of_trial = 250.0;  // evaluations
constexpr double worth_it = 0.8;         // of the work per time of explicit steps
constexpr long first_trial = 5;
constexpr double smoothing = 0.1;         // weight of one step in the work per time before
constexpr double most_of_place = 1000.0;  // work in a trial that is compared with it alone
constexpr long longer = 4;                // to the next trial, after one that was lost
// Steps of BDF that lead nowhere, in evaluations of explicit ones; how many it may make.
constexpr double shortest = 1e-9;
constexpr int most_stuck = 20;
constexpr double tightest = 1e-10;  // relative tolerance: beyond, BDF always loses

class StiffnessSwitch final : public Formulation {
 public:
  StiffnessSwitch(Dynamics& dynamics, const Tolerances& tolerances)
      : dynamics_(dynamics),
        tolerances_(tolerances),
        explicit_(find_formulation("arkode-projection").make(dynamics, tolerances)),
        active_(explicit_.get()) {}

  void start(const State& state) override;
  void restart(const State& state) override;
  Step step(double t_stop) override;
  double time() const override { return active_->time(); }
  double last_step() const override { return active_->last_step(); }
  bool ends_projected() const override { return active_->ends_projected(); }
  void interpolate(double t, State& state) override { active_->interpolate(t, state); }
  void sample(double t, State& state) override { active_->sample(t, state); }
  void glance(double t, State& state) override { active_->glance(t, state); }
  void look(double t, State& state, Dynamics& equations) override {
    active_->look(t, state, equations);
  }
  const std::vector<int>& fired() const override { return active_->fired(); }
  const std::vector<int>& passed() const override { return active_->passed(); }
  StepCounters counters() const override;
  std::string failure() const override { return active_->failure(); }

 private:
  /// What a method has done, since it went on or was judged.
  struct Account {
    double work = 0.0, time = 0.0;  // [evaluations], [s]
  };
  /// With or without contacts that touch.
  struct Span {
    bool implicit = false;
    Account all;               // explicit steps
    double rate_before = 0.0;  // [1/s] work per time of the last of them
    long bounded = 0;          // of them, that stability has bounded, since BDF was left
    long next = first_trial;   // at how many of them BDF has a trial
    Account trial;             // BDF, since it has gone on
    double judged = 0.0;       // work of it, at which it is judged; 0: it has not begun to count
  };

  bool is_implicit() const { return active_ != explicit_.get(); }
  double work() const;
  void count(double work, double time);
  bool wants_other();
  bool change(bool to_implicit);
  void begin(bool implicit, const State& state);
  bool is_stuck(double h);
  Step go_on_explicitly(double t_stop);

  Dynamics& dynamics_;
  Tolerances tolerances_;
  std::unique_ptr<Formulation> explicit_, implicit_;  // the second when it is needed
  Formulation* active_;
  State state_;  // of the last start, to start the other one with
  std::array<Span, 2> spans_;
  Span* span_ = spans_.data();
  double t_good_ = 0.0;  // [s] end of the last good step
  int stuck_ = 0;        // steps, one after the other, that led nowhere
};

void StiffnessSwitch::start(const State& state) {
  state_ = state;
  span_ = &spans_[touches(state) ? 1 : 0];
  active_ = span_->implicit ? implicit_.get() : explicit_.get();
  active_->start(state);
  t_good_ = state.t;
  stuck_ = 0;
}

void StiffnessSwitch::restart(const State& state) {
  state_ = state;
  active_->restart(state);
  t_good_ = state.t;
}

double StiffnessSwitch::work() const {
  double sum = static_cast<double>(dynamics_.evaluations());
  if (!is_implicit()) return sum;
  const StepCounters counters = implicit_->counters();
  return sum + static_cast<double>(counters.evaluations) +
         work_of_jacobian * static_cast<double>(counters.jacobians) +
         work_of_step * static_cast<double>(counters.steps);
}

Step StiffnessSwitch::step(double t_stop) {
  if (wants_other()) change(!is_implicit());
  const double before = work();
  const Step step = active_->step(t_stop);
  if (step == Step::failed) return is_implicit() ? go_on_explicitly(t_stop) : step;
  const double h = active_->time() - t_good_;
  count(work() - before, h);
  if (is_implicit() && is_stuck(h)) return go_on_explicitly(t_stop);
  t_good_ = active_->time();
  return step;
}

void StiffnessSwitch::count(double work, double time) {
  if (!(time > 0.0)) return;
  Span& span = *span_;
  Account& account = is_implicit() ? span.trial : span.all;
  account.work += work;
  account.time += time;
  if (is_implicit()) return;
  double& rate = span.rate_before;
  rate = rate > 0.0 ? rate + smoothing * (work / time - rate) : work / time;
  if (explicit_->is_bounded_by_stability()) ++span.bounded;
}

// It is compared with the explicit steps just before it, and the longer it has gone on, with all of them:
// what a place costs differs more than what methods do.
bool StiffnessSwitch::wants_other() {
  Span& span = *span_;
  if (tolerances_.relative < tightest) return false;
  if (!is_implicit()) return span.bounded >= span.next;
  const Account& trial = span.trial;
  if (trial.work < std::max(span.judged, work_of_trial)) return false;
  implicit_->tighten(tighter);
  if (span.judged == 0.0) {  // it had to raise its order and step first
    span.trial = {};
    span.judged = work_of_trial;
    return false;
  }
  const double here = span.rate_before * std::min(1.0, most_of_place / trial.work);
  const double rate = std::max(here, span.all.work / span.all.time);
  const bool loses = trial.work > worth_it * rate * trial.time;
  span.judged = 2.0 * trial.work;
  if (loses) span.next *= longer;
  return loses;
}

// At the end of the last step; false if there is no way to start the other one there.
bool StiffnessSwitch::change(bool to_implicit) {
  span_->bounded = 0;
  active_->interpolate(t_good_, state_);
  const bool consistent =
      dynamics_.project(state_.t, state_.q.data(), state_.v.data()) &&
      dynamics_.calc_accelerations(
          {.t = state_.t, .q = state_.q.data(), .v = state_.v.data(), .z = state_.z.data()},
          {.a = state_.a.data(), .lambda = state_.lambda.data()});
  if (consistent) begin(to_implicit, state_);
  return consistent;
}

void StiffnessSwitch::begin(bool implicit, const State& state) {
  if (implicit) {
    if (implicit_ == nullptr) implicit_ = find_formulation("ida-ggl").make(dynamics_, tolerances_);
    implicit_->tighten(1.0);
  }
  Span& span = *span_;
  span.implicit = implicit;
  span.trial = {};
  span.judged = 0.0;
  active_ = implicit ? implicit_.get() : explicit_.get();
  active_->start(state);
  t_good_ = state.t;
  stuck_ = 0;
}

// Where a law has no limit, steps may run to zero without a failure.
bool StiffnessSwitch::is_stuck(double h) {
  const Account& all = span_->all;
  stuck_ = h * all.work < shortest * all.time ? stuck_ + 1 : 0;
  return stuck_ >= most_stuck;
}

// From the last good step. A formulation that fails has lost.
Step StiffnessSwitch::go_on_explicitly(double t_stop) {
  span_->next *= longer;
  if (!change(false)) return Step::failed;
  const Step step = active_->step(t_stop);
  if (step != Step::failed) t_good_ = active_->time();
  return step;
}

StepCounters StiffnessSwitch::counters() const {
  StepCounters sum = explicit_->counters();
  if (implicit_ == nullptr) return sum;
  const StepCounters other = implicit_->counters();
  sum.steps += other.steps;
  sum.rejected += other.rejected;
  sum.jacobians += other.jacobians;
  sum.evaluations += other.evaluations;
  sum.factors.refactorisations += other.factors.refactorisations;
  sum.factors.fresh += other.factors.fresh;
  sum.raised = std::max(sum.raised, other.raised);
  sum.by_other = other.steps;
  return sum;
}

}  // namespace

std::unique_ptr<Formulation> make_stiffness_switch(Dynamics& dynamics,
                                                   const Tolerances& tolerances) {
  return std::make_unique<StiffnessSwitch>(dynamics, tolerances);
}

}  // namespace yoke
