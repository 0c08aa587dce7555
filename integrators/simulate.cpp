// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/simulate.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

#include <yoke/integrators/analyses/details/driven_motion.hpp>
#include <yoke/integrators/run/checkpoint_schedule.hpp>
#include <yoke/integrators/run/constraint_summary.hpp>
#include <yoke/integrators/run/cost.hpp>
#include <yoke/integrators/run/event_dispatch.hpp>
#include <yoke/integrators/run/event_locator.hpp>
#include <yoke/integrators/run/failure_messages.hpp>
#include <yoke/integrators/run/fingerprint.hpp>
#include <yoke/integrators/run/impasse_watch.hpp>
#include <yoke/integrators/run/sampling.hpp>
#include <yoke/integrators/run/singular/singular_crossing.hpp>
#include <yoke/integrators/run/stall_detector.hpp>
#include <yoke/integrators/run/start/automatic_choice.hpp>
#include <yoke/integrators/run/start/error_weights.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>
#include <yoke/integrators/run/start/trial.hpp>
#include <yoke/integrators/sundials/callback_failure.hpp>

namespace yoke {

namespace {

constexpr double dead_point_reach =
    0.1;                             // of the time scale: how far ahead a dead point is looked for
constexpr double much_looser = 1e3;  // tolerance with which a run that stops is tried
// A tolerance below this may turn out to be out of reach on the way; then so much more is allowed.
constexpr double close_to_rounding = 1e-10, easier = 10.0;
constexpr double shortest_rest = 1e-14;  // of the end time

constexpr const char* automatic = "automatic";
constexpr const char* asked_for = "asked for";
constexpr const char* change_of_formulation = "formulation changed";
constexpr std::ptrdiff_t most_noted_changes = 5;

/// One run: a state that moves, what is recorded of it, and the formulation that moves it.
class Run {
 public:
  Run(const Model& model, const State& start, const SimulationOptions& options);
  /// Goes on from a checkpoint.
  Run(const Model& model, const Checkpoint& checkpoint, const SimulationOptions& options);
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;
  Result go();

 private:
  Run(const Model& model, const State& state, const SimulationOptions& options, double t_start);
  void choose_formulation();
  void choose_formulation_anew();
  void make_formulation();
  bool initialise();
  void start_anew();
  bool reach_checkpoint(double t);
  void write_checkpoint();
  void write_first_checkpoint();
  bool advance();
  bool observe(double t);
  void record_samples_up_to(double t);
  void record_singular_position(const SingularPosition& position);
  double locate_events(Step step);
  void start_formulation();
  bool handle_events(double t);
  bool restart_at_event(double t);
  void check_restart();
  State last_good_state();
  std::string dead_point();
  bool reaches_impasse(double t);
  std::string end_of_motion();
  double relative_tolerance() const;
  bool looser_tolerance_helps(const State& there);
  bool goes_on_with_less();
  std::string blame();
  std::string explain_stop(double t, Step step);
  bool fail_at(double t, Step step);
  void finish();
  void note_rounding();
  void summarise();
  void stop(Stop why, std::string reason);
  bool fail(std::string reason);

  const SimulationOptions& options_;
  RunCost cost_;
  FormulationEntry entry_;
  bool resumed_ = false;
  double t_start_;
  Dynamics dynamics_;
  State state_;   // at the last restart; owns the discrete memory
  State sample_;  // scratch for dense output
  Result result_;
  std::unique_ptr<RunSamples> samples_;
  std::unique_ptr<Formulation> formulation_;
  RunCheckpoints checkpoints_;
  EventLocator locator_;
  ElementEvents elements_;
  Standstill standstill_;
  ImpasseWatch impasse_;
  bool stopped_ = false;
};

Run::Run(const Model& model, const State& state, const SimulationOptions& options, double t_start)
    : options_(options),
      t_start_(t_start),
      dynamics_(model),
      state_(state),
      sample_(state),
      checkpoints_(options, t_start),
      locator_(dynamics_.system()),
      elements_(dynamics_, state_, result_,
                [this](Stop why, std::string reason) { stop(why, std::move(reason)); }),
      impasse_(dynamics_) {}

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
  formulation_ = guard_singular_positions(
      entry_, dynamics_, choose_tolerances(dynamics_.system(), state_, options),
      [this](const SingularPosition& position) { record_singular_position(position); });
}

bool Run::initialise() {
  if (resumed_) {
    start_anew();
    return state_.t < options_.until;
  }
  elements_.initialise_contacts();
  if (stopped_) return false;
  dynamics_.reset();  // a fresh factorisation: equal inputs, equal bits
  if (!dynamics_.project(state_)) return fail("accelerations at the start are not finite");
  sample_ = state_;
  samples_->start(state_);
  start_formulation();
  samples_->record_restart(state_);
  standstill_.start(state_.t, {.start = state_.t});
  if (checkpoints_.wanted()) write_first_checkpoint();
  return true;
}

// No factors, an integrator without a past.
void Run::start_anew() {
  samples_->contact_rows().start(state_.contacts);
  dynamics_.reset();
  make_formulation();
  start_formulation();
}

void Run::start_formulation() {
  formulation_->start(state_);
  locator_.start(state_);
  dynamics_.system().bind(state_);
}

// At a step's end that is not an event; false if the run cannot go on.
bool Run::reach_checkpoint(double t) {
  formulation_->interpolate(t, state_);
  if (!dynamics_.project(state_)) return fail(not_projected("at the checkpoint ", t));
  write_checkpoint();
  return true;
}

// Whoever goes on from here, this run or one that is taken up, starts from the same.
void Run::write_checkpoint() {
  standstill_.restart(state_.t);
  summarise();
  cost_.close(dynamics_, result_.summary);
  checkpoints_.write({.formulation = std::string(entry_.name),
                      .scales = dynamics_.system().scales(),
                      .state = state_,
                      .dropped_rows = dynamics_.system().dropped_rows(),
                      .next_sample = samples_->next(),
                      .ledger = samples_->ledger(),
                      .summary = result_.summary,
                      .window_start = standstill_.window().start,
                      .window_events = standstill_.window().events},
                     result_);
  start_anew();
}

// It tells what the others will cost.
void Run::write_first_checkpoint() {
  const auto begin = std::chrono::steady_clock::now();
  write_checkpoint();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  const std::string cost =
      checkpoint_cost(options_.checkpoints.every, options_.until - t_start_, taken.count());
  if (options_.warning && !cost.empty()) options_.warning(cost);
}

void Run::record_singular_position(const SingularPosition& position) {
  result_.summary.singular_positions.push_back(position);
  result_.events.push_back({.t = position.t,
                            .element = position.equation.substr(0, position.equation.find(':')),
                            .kind = "singular_position",
                            .region = ""});
}

// Of the step that ends at t.
void Run::record_samples_up_to(double t) {
  const bool in_contact = samples_->contact_rows().step();
  if (!in_contact && samples_->next_time() > t) return;
  const Work before = work_of(dynamics_);
  sample_.contacts = state_.contacts;
  sample_.parameters = state_.parameters;
  Outcome outcome = samples_->record_up_to(t, *formulation_, sample_);
  if (outcome && in_contact) outcome = samples_->record_in_contact(t, *formulation_, sample_);
  if (!outcome) fail(outcome.why);
  dynamics_.system().bind(state_);
  cost_.book_recording(work_of(dynamics_) - before);
}

double Run::locate_events(Step step) {
  sample_.contacts = state_.contacts;
  sample_.parameters = state_.parameters;
  const double t = locator_.locate(*formulation_, step, standstill_.t_last(), sample_);
  dynamics_.system().bind(state_);
  return t;
}

// False if the run ends here.
bool Run::handle_events(double t) {
  formulation_->interpolate(t, state_);
  if (const Outcome outcome = samples_->measure_drift(state_); !outcome) return fail(outcome.why);
  if (!dynamics_.project(state_)) return fail(not_projected("at the event ", state_.t));
  elements_.handle(locator_.fired());
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
  // What is left of the run is too short to be integrated.
  const bool at_the_end = options_.until - t <= shortest_rest * std::abs(options_.until);
  if (at_the_end) result_.summary.t_end = state_.t = options_.until;
  samples_->record_restart(state_);
  if (at_the_end) return false;
  if (elements_.parameters_changed()) choose_formulation_anew();
  checkpoints_.count_event();
  if (checkpoints_.due(t)) {
    write_checkpoint();
  } else {
    start_formulation();
  }
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
  return find_dead_point(system.model(), from, system.dropped_rows(), result_.summary.t_end,
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
  note_rounding();
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
  dynamics_.system().bind(state_);
  return blame_surroundings(dynamics_, there, result_.events, standstill_.last_steps(), too_tight);
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

// False at the end, whatever the reason.
bool Run::advance() {
  const Step step = formulation_->step(checkpoints_.next_stop());
  const double t = step == Step::failed ? formulation_->time() : locate_events(step);
  if (step == Step::failed || standstill_.stalls(t)) return goes_on_with_less() || fail_at(t, step);
  const bool at_event = !locator_.fired().empty();
  standstill_.note_step(formulation_->last_step());
  // A sample exactly at the event is taken after it, from the projected state.
  record_samples_up_to(at_event ? std::nextafter(t, t_start_) : t);
  result_.summary.t_end = t;
  if (!stopped_ && !at_event && reaches_impasse(t)) return false;
  if (stopped_ || (at_event && !handle_events(t))) return false;
  if (!at_event && checkpoints_.due(t) && !reach_checkpoint(t)) return false;
  return observe(t) && t < options_.until;
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
  }
  summarise();
  note_rounding();
}

// Once, at the end: how much of the tolerance was out of reach.
void Run::note_rounding() {
  const double raised = formulation_->counters().raised;
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

Result Run::go() {
  try {
    if (initialise())
      while (advance()) {
      }
    finish();
  } catch (const std::exception& error) {  // of a user's function; the results so far are kept
    stop(Stop::failed, fmt::format("after t = {:.9g} s: {}", result_.summary.t_end, error.what()));
    summarise();
  }
  return std::move(result_);
}

}  // namespace

Result simulate(const Model& model, const State& start, const SimulationOptions& options) {
  check_model(model);
  check_state(model, start);
  if (options.checkpoints.resume)
    if (const auto checkpoint = read_checkpoint(options.checkpoints.folder)) {
      check_checkpoint(model, options, *checkpoint);
      return Run(model, *checkpoint, options).go();
    }
  return Run(model, start, options).go();
}

Result resume(const Model& model, const std::filesystem::path& folder,
              std::function<bool(const Progress&)> observer) {
  check_model(model);
  const std::optional<Checkpoint> c = read_checkpoint(folder);
  if (!c)
    throw ModelError(fmt::format("there is no checkpoint in '{}' to go on from", folder.string()));
  SimulationOptions options = options_of(*c, folder);
  options.observer = std::move(observer);
  check_checkpoint(model, options, *c);
  return Run(model, *c, options).go();
}

Result simulate(const Model& model, const SimulationOptions& options) {
  return simulate(model, model.start_state(), options);
}

State assembled_state(const Model& model) {
  Dynamics dynamics(model);
  State state = model.start_state();
  if (const Outcome outcome = dynamics.assemble(state); !outcome) throw ModelError(outcome.why);
  return state;
}

}  // namespace yoke
