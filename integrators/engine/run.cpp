// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/engine/run.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <yoke/integrators/formulations/stiffness_switch.hpp>
#include <yoke/integrators/run/constraint_summary.hpp>
#include <yoke/integrators/run/failure_messages.hpp>
#include <yoke/integrators/run/fingerprint.hpp>
#include <yoke/integrators/run/singular/singular_crossing.hpp>
#include <yoke/integrators/run/start/automatic_choice.hpp>
#include <yoke/integrators/run/start/error_weights.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>

namespace yoke {

namespace {

constexpr double shortest_rest = 1e-14;  // of the end time

constexpr const char* automatic = "automatic";
constexpr const char* asked_for = "asked for";
constexpr const char* change_of_formulation = "formulation changed";
constexpr std::ptrdiff_t most_noted_changes = 5;

}  // namespace

Run::Run(const Model& model, const State& state, const SimulationOptions& options, double t_start)
    : options_(options),
      t_start_(t_start),
      dynamics_(model, linear_solver_named(options.linear_solver)),
      state_(state),
      sample_(state),
      checkpoints_(options, t_start),
      locator_(dynamics_),
      elements_(dynamics_, state_, result_,
                [this](Stop why, std::string reason) { stop(why, std::move(reason)); }),
      impasse_(dynamics_),
      t_shown_(state.t) {}

Run::Run(const Model& model, const State& start, const SimulationOptions& options)
    : Run(model, start, options, start.t) {
  check_options(options, start.t);
  if (options.formulation != automatic) find_formulation(options.formulation);
  Summary& summary = result_.summary;
  summary.relative_tolerance = options.relative_tolerance;
  summary.t_start = summary.t_end = start.t;
  summary.t_asked = options.until;

  if (options.length_scale > 0.0)
    dynamics_.system().set_scales({.length = options.length_scale, .time = 1.0});
  if (const Outcome outcome = dynamics_.assemble(state_); !outcome) throw ModelError(outcome.why);
  check_drivers(dynamics_.system(), state_, options.until);
  const Scales scales = choose_scales(dynamics_.system(), state_, options);
  dynamics_.system().set_scales(scales);
  summary.length_scale = scales.length;
  summary.time_scale = scales.time;
  note_constraints(dynamics_, result_.summary);
  summary.linear_solver = name_of(dynamics_.saddle().in_use());
  choose_formulation();
  make_formulation();
  samples_ = std::make_unique<RunSamples>(dynamics_, result_, options_, t_start_);
  if (!options.checkpoints.folder.empty()) checkpoints_.begin(fingerprint(model));
}

Run::Run(const Model& model, const Checkpoint& c, const SimulationOptions& options)
    : Run(model, c.state, options, c.summary.t_start) {
  entry_ = find_formulation(c.formulation);
  resumed_ = true;
  dynamics_.system().set_scales(c.scales);
  dynamics_.system().bind(state_);
  dynamics_.leave_out(c.dropped_rows);
  largest_independence_ = c.largest_independence;
  make_formulation();
  samples_ = std::make_unique<RunSamples>(dynamics_, result_, options_, t_start_);
  result_.summary = c.summary;
  cost_.resume(c.summary);
  samples_->resume(c.ledger, c.next_sample);
  standstill_.start(state_.t, {.start = c.window_start, .events = c.window_events});
  read_rows(options.checkpoints.folder, c, result_);
  checkpoints_.resume(c);
}

void Run::choose_formulation() {
  Choice choice{options_.formulation, asked_for};
  if (choice.name == automatic)
    choice = yoke::choose_formulation(dynamics_, state_, options_.relative_tolerance);
  entry_ = find_formulation(choice.name);
  result_.summary.formulation = entry_.name;
  result_.summary.formulation_reason = choice.reason;
}

// An event has changed parameters: what was not stiff may be so now, or no longer.
void Run::choose_formulation_anew() {
  Summary& summary = result_.summary;
  if (summary.formulation_reason == asked_for) return;
  dynamics_.system().bind(state_);
  const Choice choice = yoke::choose_formulation(dynamics_, state_, options_.relative_tolerance);
  if (choice.name == entry_.name) return;
  const auto noted = std::ranges::count_if(summary.notes, [](const std::string& note) {
    return note.starts_with(change_of_formulation);
  });
  if (noted < most_noted_changes)
    summary.notes.push_back(
        fmt::format("{} at t = {:.9g} s from {} to {}: {}{}", change_of_formulation, state_.t,
                    entry_.name, choice.name, choice.reason,
                    noted + 1 == most_noted_changes ? "; further changes are not noted" : ""));
  cost_.write(dynamics_, *formulation_, summary);
  cost_.close(dynamics_, summary);
  entry_ = find_formulation(choice.name);
  summary.formulation = entry_.name;
  summary.formulation_reason = choice.reason;
  make_formulation();
}

double Run::relative_tolerance() const {
  return std::max(options_.relative_tolerance, result_.summary.tolerance_kept);
}

void Run::make_formulation() {
  SimulationOptions options = options_;
  options.relative_tolerance = relative_tolerance();
  FormulationEntry entry = entry_;
  const bool free = result_.summary.formulation_reason != asked_for;
  if (free && entry.name == formulation_registry().front().name) entry.make = make_stiffness_switch;
  formulation_ = guard_singular_positions(
      entry, dynamics_, choose_tolerances(dynamics_.system(), state_, options),
      [this](const SingularPosition& position) { record_singular_position(position); },
      largest_independence_);
}

bool Run::initialise() {
  if (resumed_) {
    start_anew();
    return state_.t < options_.until;
  }
  elements_.initialise_contacts();
  if (stopped_) return false;
  dynamics_.reset();  // a fresh factorisation: equal inputs, equal bits
  if (!dynamics_.project(state_))
    return fail("accelerations at the start are not finite" + blame_element(dynamics_.system()));
  sample_ = state_;
  samples_->start(state_);
  if (watch_ != nullptr) watch_->start(state_, dynamics_.system());
  if (!take_samples_due()) return false;
  settle();
  if (stopped_) return false;
  start_formulation();
  samples_->record_restart(state_);
  standstill_.start(state_.t, {.start = state_.t});
  if (checkpoints_.wanted()) write_first_checkpoint();
  return true;
}

// No factors, an integrator without a past.
void Run::start_anew() {
  samples_->contact_rows().start(state_);
  dynamics_.reset();
  make_formulation();
  start_formulation();
}

void Run::start_formulation(bool loads_only) {
  loads_only ? formulation_->restart(state_) : formulation_->start(state_);
  locator_.start(state_, loads_only);
  dynamics_.system().bind(state_);
  t_sample_ = next_sample();
}

// [s] At the end there is nothing left to control.
double Run::next_sample() const {
  const double t = elements_.next_sample();
  return t < options_.until ? t : std::numeric_limits<double>::infinity();
}

// Controllers' samples that are due at state_, which gets its accelerations when somebody wants them.
// False if the run ends there.
bool Run::take_samples_due() {
  dynamics_.system().bind(state_);
  const double until = state_.t + shortest_rest * std::abs(options_.until);
  if (elements_.next_sample() > until) return true;
  if (watch_ != nullptr) watch_->sample(state_);
  elements_.take_samples(until);
  stale_ = true;
  if (result_.summary.stop == Stop::by_event) {
    settle();
    samples_->record_end(state_);
  }
  return !stopped_;
}

// At the end of a step, a time at which controllers sample. They see no accelerations, and the step
// has been looked at where it was recorded: it is enough to be on the constraints.
bool Run::reach_samples(double t, bool at_event) {
  if (!at_event) {
    formulation_->interpolate(t, state_);
    dynamics_.system().bind(state_);
    if (!formulation_->ends_projected() &&
        !dynamics_.project(t, state_.q.data(), state_.v.data()) && !dynamics_.project(state_))
      return fail(not_projected("at the sample ", t));
  }
  if (!take_samples_due()) return false;
  if (elements_.changed()) return restart_at_sample(t);
  t_sample_ = next_sample();
  return true;
}

bool Run::restart_at_sample(double t) {
  const bool at_the_end = reaches_end(t), row = samples_->next_time() == state_.t;
  const bool checkpoint = checkpoints_.due(t), other_forces = elements_.stiffness_changed();
  if (row || checkpoint || other_forces) settle();
  if (stopped_) return false;
  if (row) samples_->record_restart(state_);
  if (at_the_end) return false;
  if (other_forces) choose_formulation_anew();
  if (checkpoint) {
    write_checkpoint();
  } else {
    start_formulation(elements_.loads_only());
  }
  return true;
}

void Run::record_singular_position(const SingularPosition& position) {
  result_.summary.singular_positions.push_back(position);
  result_.events.push_back({.t = position.t,
                            .element = position.equation.substr(0, position.equation.find(':')),
                            .kind = "singular_position",
                            .region = ""});
}

// Of the step made, up to t.
void Run::record_samples_up_to(double t) {
  if (samples_->next_time() > t) return;
  record([&] { return samples_->record_up_to(t, *formulation_, sample_); });
}

void Run::record_in_contact(const StepSpan& step) {
  if (!samples_->contact_rows().counts()) return;
  record([&] { return samples_->record_in_contact(step, *formulation_, sample_); });
}

void Run::record(const std::function<Outcome()>& rows) {
  if (stopped_) return;
  const Work before = work_of(dynamics_);
  sample_.contacts = state_.contacts;
  sample_.parameters = state_.parameters;
  if (const Outcome outcome = rows(); !outcome) fail(outcome.why);
  dynamics_.system().bind(state_);
  cost_.book_recording(work_of(dynamics_) - before);
}

double Run::locate_events(Step step) {
  sample_.contacts = state_.contacts;
  sample_.parameters = state_.parameters;
  const double t = locator_.locate(*formulation_, step, t_behind_, sample_);
  dynamics_.system().bind(state_);
  return t;
}

// False if the run ends here.
bool Run::handle_events(double t) {
  formulation_->interpolate(t, state_);
  if (const Outcome outcome = samples_->measure_drift(state_); !outcome) return fail(outcome.why);
  if (!dynamics_.project(state_)) return fail(not_projected("at the event ", state_.t));
  stale_ = false;
  const std::optional<State> before = watch_ != nullptr ? std::optional(state_) : std::nullopt;
  elements_.handle(locator_.fired());
  if (before && !stopped_ && elements_.changed()) watch_->jump(*before, locator_.fired(), state_);
  if (result_.summary.stop == Stop::by_event) {  // ends with a row of its own
    dynamics_.calc_accelerations(state_);
    samples_->record_end(state_);
  }
  if (stopped_) return false;
  if (!elements_.changed() && t == formulation_->time()) return true;  // nothing to restart for
  return restart_at_event(t);
}

bool Run::restart_at_event(double t) {
  check_restart();
  if (stopped_) return false;
  const bool at_the_end = reaches_end(t);
  samples_->record_restart(state_);
  if (at_the_end) return false;
  if (elements_.stiffness_changed()) choose_formulation_anew();
  checkpoints_.count_event();
  if (checkpoints_.due(t)) {
    write_checkpoint();
  } else {
    start_formulation();
  }
  return true;
}

// Is what is left of the run too short to be integrated? Then state_ is its end.
bool Run::reaches_end(double t) {
  if (options_.until - t > shortest_rest * std::abs(options_.until)) return false;
  result_.summary.t_end = state_.t = t_shown_ = options_.until;
  return true;
}

void Run::check_restart() {
  const double duration = options_.until - t_start_;
  if (standstill_.chatters(state_.t, duration))
    fail(chattering(max_events_in_window, event_window * duration, state_.t, result_.events));
  if (!dynamics_.calc_accelerations(state_))
    fail(fmt::format("accelerations after the event at t = {:.9g} s are not finite{}", state_.t,
                     blame_element(dynamics_.system())));
}

// False at the end, whatever the reason. Without a step made if the run goes on with a tolerance that
// can be kept.
bool Run::make_step() {
  if (disturbed_ && !restart_if_disturbed()) return false;
  const Step step = formulation_->step(std::min(checkpoints_.next_stop(), t_sample_));
  t_behind_ = standstill_.t_last();
  const double t = step == Step::failed ? formulation_->time() : locate_events(step);
  if (step == Step::failed || standstill_.stalls(t)) return goes_on_with_less() || fail_at(t, step);
  standstill_.note_step(formulation_->last_step());
  ahead_ = true;
  t_ahead_ = t;
  return true;
}

// Shows a time [s] within the step made.
void Run::show(double t) {
  record_samples_up_to(t);
  t_shown_ = t;
}

// Shows the end of the step made. False at the end of the run, whatever the reason.
bool Run::complete_step() {
  const double t = t_ahead_;
  const bool at_event = !locator_.fired().empty(), at_sample = t == t_sample_;
  // A row exactly at the event is taken after it, from the projected state.
  const double end = at_event || at_sample ? std::nextafter(t, t_start_) : t;
  record_samples_up_to(end);
  record_in_contact({.from = t_behind_, .to = t, .end = end, .at_event = at_event});
  ahead_ = false;
  result_.summary.t_end = t_shown_ = t;
  if (watch_ != nullptr) watch_->step(*formulation_, state_, t, at_event);
  if (!stopped_ && !at_event && reaches_impasse(t)) return false;
  if (stopped_ || (at_event && !handle_events(t))) return false;
  if (at_sample && !reach_samples(t, at_event)) return false;
  if (!at_event && checkpoints_.due(t) && !reach_checkpoint(t)) return false;
  return observe(t) && t < options_.until;
}

void Run::end() {
  finish();
  t_shown_ = result_.summary.t_end;
  ended_ = true;
  ahead_ = disturbed_ = false;
}

// A user's function may throw; the results so far are kept.
void Run::guarded(const std::function<void()>& f) {
  if (look_) look_->known = look_->recorded = false;
  try {
    f();
  } catch (const std::exception& error) {
    stop(Stop::failed, fmt::format("after t = {:.9g} s: {}", result_.summary.t_end, error.what()));
    summarise();
    ended_ = true;
    ahead_ = disturbed_ = false;
  }
}

void Run::begin() {
  guarded([this] {
    if (!initialise()) end();
  });
}

bool Run::advance_to(double t) {
  guarded([this, t] {
    while (!ended_ && t_shown_ < t) {
      if (!ahead_ && !make_step()) end();
      if (!ahead_) continue;
      if (t < t_ahead_) show(t);
      if ((stopped_ || t >= t_ahead_) && !complete_step()) end();
    }
  });
  return t_shown_ >= t;
}

bool Run::step() {
  const double from = t_shown_;
  guarded([this] {
    while (!ended_ && !ahead_)
      if (!make_step()) end();
    if (ahead_ && !complete_step()) end();
  });
  return t_shown_ > from;
}

Result Run::finish_run() {
  advance_to(options_.until);
  return std::move(result_);
}

bool Run::observe(double t) {
  if (!options_.observer) return true;
  const Progress progress{.t = t,
                          .fraction = (t - t_start_) / (options_.until - t_start_),
                          .steps = cost_.steps(*formulation_),
                          .events = static_cast<long>(result_.events.size()),
                          .so_far = &result_};
  if (options_.observer(progress)) return true;
  stop(Stop::interrupted, fmt::format("interrupted at t = {:.9g} s", t));
  return false;
}

}  // namespace yoke
