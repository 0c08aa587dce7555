// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// How a run ends: why it cannot go on, whom to blame, and what is left to be written.
#include <yoke/integrators/engine/run.hpp>

#include <algorithm>

#include <yoke/integrators/analyses/details/driven_motion.hpp>
#include <yoke/integrators/run/constraint_summary.hpp>
#include <yoke/integrators/run/failure_messages.hpp>
#include <yoke/integrators/run/start/trial.hpp>
#include <yoke/integrators/sundials/callback_failure.hpp>

namespace yoke {

namespace {

constexpr double dead_point_reach =
    0.1;                             // of the time scale: how far ahead a dead point is looked for
constexpr double much_looser = 1e3;  // tolerance with which a run that stops is tried
// A tolerance below this may turn out to be out of reach on the way; then so much more is allowed.
constexpr double close_to_rounding = 1e-10, easier = 10.0;

}  // namespace

State Run::last_good_state() {
  State there = state_;
  if (result_.summary.t_end > state_.t) formulation_->interpolate(result_.summary.t_end, there);
  there.contacts = state_.contacts;
  there.parameters = state_.parameters;
  return there;
}

/// Empty, or the dead point that the drivers have run into. Positions of a mechanism that is fully
/// driven follow from the last restart; others are known at the last good state only.
std::string Run::dead_point() {
  const System& system = dynamics_.system();
  const State from = degrees_of_freedom(dynamics_) == 0 ? state_ : last_good_state();
  return find_dead_point(system.model(), from, system.left_out_rows(), result_.summary.t_end,
                         dead_point_reach * system.scales().time);
}

/// Empty, or why no motion leads on, whatever the formulation.
std::string Run::end_of_motion() {
  std::string reason = dead_point();
  if (!reason.empty() || !impasse_.watches() || !dynamics_.system().not_finite().empty())
    return reason;
  return impasse_.explain(last_good_state());
}

bool Run::reaches_impasse(double t) {
  if (!impasse_.watches()) return false;
  formulation_->interpolate(t, sample_);
  std::string reason = impasse_.look(sample_);
  if (reason.empty()) return false;
  stop(Stop::failed, std::move(reason));
  return true;
}

/// Does the formulation get on from there if less is asked of it? Then the tolerance is too tight.
bool Run::looser_tolerance_helps(const State& there) {
  SimulationOptions options = options_;
  options.relative_tolerance = std::min(much_looser * relative_tolerance(), 1e-2);
  if (options.relative_tolerance < 2.0 * relative_tolerance()) return false;
  return gets_on(entry_, dynamics_, there, options, formulation_->last_step());
}

/// A tolerance close to rounding may be out of reach: noise that no floor of the error weights
/// foresaw. Then the run goes on with less, and says so.
bool Run::goes_on_with_less() {
  if (!(easier * relative_tolerance() <= close_to_rounding) ||
      !dynamics_.system().not_finite().empty())
    return false;
  State there = last_good_state();
  if (!dynamics_.project(there) || !looser_tolerance_helps(there) || !end_of_motion().empty()) {
    dynamics_.system().bind(state_);
    return false;
  }
  cost_.write(dynamics_, *formulation_, result_.summary);
  note_steps();
  cost_.close(dynamics_, result_.summary);
  state_ = std::move(there);
  result_.summary.tolerance_kept = easier * relative_tolerance();
  result_.summary.notes.push_back(fmt::format(
      "rounding: at t = {:.9g} s the tolerance was out of reach; from there it was {:g}", state_.t,
      relative_tolerance()));
  standstill_.restart(state_.t);
  start_anew();
  return true;
}

/// Who is to blame for a step that fails, and what to try.
std::string Run::blame() {
  if (std::string element = blame_element(dynamics_.system()); !element.empty()) return element;
  State there = last_good_state();
  const bool too_tight = looser_tolerance_helps(there);
  std::string text =
      blame_surroundings(dynamics_, there, result_.events, standstill_.last_steps(), too_tight);
  dynamics_.system().bind(state_);  // no longer to `there`
  return text;
}

std::string Run::explain_stop(double t, Step step) {
  if (step != Step::failed)
    return fmt::format("the step size has run to zero at t = {:.9g} s{}", t, blame());
  const std::string failure = formulation_->failure();
  return explained(failure, t,
                   fmt::format("the integrator stopped at t = {:.9g} s with a step of {:g} s{}", t,
                               formulation_->last_step(), blame()));
}

// Where the motion ends no other explanation is needed.
bool Run::fail_at(double t, Step step) {
  std::string reason = end_of_motion();
  if (reason.empty()) reason = explain_stop(t, step);
  stop(Stop::failed, std::move(reason));
  return false;
}

// Stops the run; false, for callers that say whether it goes on.
bool Run::fail(std::string reason) {
  if (stopped_) return false;
  if (std::string end = end_of_motion(); !end.empty()) reason = std::move(end);
  stop(Stop::failed, std::move(reason));
  return false;
}

void Run::stop(Stop why, std::string reason) {
  if (stopped_) return;
  stopped_ = true;
  result_.summary.stop = why;
  result_.summary.reason = std::move(reason);
}

void Run::finish() {
  if (!stopped_) stop(Stop::completed, "reached the end time");
  // The final state is that of the end time, however the run ended.
  if (result_.summary.t_end > state_.t) {
    formulation_->interpolate(result_.summary.t_end, state_);
    State projected = state_;  // at an impasse there may be none
    if (dynamics_.project(projected)) state_ = std::move(projected);
  } else {
    settle();
  }
  summarise();
  note_steps();
}

// Once, at the end: who made the steps, and how much of the tolerance was out of reach.
void Run::note_steps() {
  const StepCounters counters = formulation_->counters();
  if (counters.by_other > 0)
    result_.summary.notes.push_back(
        fmt::format("stiff: stability bounded explicit steps, so ida-ggl made {} of the {} steps{}",
                    counters.by_other, counters.steps,
                    resumed_ || checkpoints_.wanted() ? " since the last checkpoint" : ""));
  const double raised = counters.raised;
  if (raised <= 1.0) return;
  result_.summary.notes.push_back(
      fmt::format("rounding: positions and velocities are not known to the tolerance of {:g} "
                  "everywhere; where it was out of reach up to {:.2g} times as much was allowed",
                  relative_tolerance(), raised));
}

void Run::summarise() {
  result_.summary.events = static_cast<long>(result_.events.size());
  cost_.write(dynamics_, *formulation_, result_.summary);
  result_.final = state_;
}

}  // namespace yoke
