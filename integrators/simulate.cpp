// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/simulate.hpp>

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <chrono>
#include <cmath>
#include <limits>

#include <yoke/core/fingerprint.hpp>
#include <yoke/core/recorder.hpp>
#include <yoke/integrators/callback_failure.hpp>
#include <yoke/integrators/checkpoint.hpp>
#include <yoke/integrators/choice.hpp>
#include <yoke/integrators/formulation.hpp>
#include <yoke/integrators/scales.hpp>
#include <yoke/integrators/singular_crossing.hpp>
#include <yoke/integrators/start_checks.hpp>

namespace yoke {

namespace {

using Clock = std::chrono::steady_clock;

// A contact that opens and closes this often within one part in a million of the run makes no
// progress any more.
constexpr long max_events_in_window = 2000;
constexpr double event_window = 1e-6;
constexpr int max_stalled_steps = 100;
constexpr double shortest_rest = 1e-14;  // of the end time
constexpr double largest_drift = 1e4;    // in units of the tolerance; a step errs by about one

constexpr const char* automatic = "automatic";

const FormulationEntry& find_formulation(const std::string& name) {
  std::string known = "'automatic'";
  for (const FormulationEntry& entry : formulation_registry()) {
    if (entry.name == name) return entry;
    known += fmt::format(", '{}'", entry.name);
  }
  throw ModelError(fmt::format("unknown formulation '{}': there are {}", name, known));
}

/// Work on the equations of motion.
struct Cost {
  long evaluations = 0, refactorisations = 0, fresh = 0;
  Cost operator-(const Cost& o) const {
    return {evaluations - o.evaluations, refactorisations - o.refactorisations, fresh - o.fresh};
  }
  void operator+=(const Cost& o) {
    evaluations += o.evaluations;
    refactorisations += o.refactorisations;
    fresh += o.fresh;
  }
};

/// One run: a state that moves, what is recorded of it, and the formulation that moves it.
class Run {
 public:
  Run(const Model& model, const State& start, const SimulationOptions& options);
  /// Goes on from a checkpoint.
  Run(const Model& model, const Checkpoint& checkpoint, const SimulationOptions& options);
  Result go();

 private:
  void choose_formulation();
  void note_constraints();
  void make_formulation();
  void set_up();
  bool initialise();
  double next_stop() const;
  bool checkpoint_due(double t) const;
  bool reach_checkpoint(double t);
  void write_checkpoint();
  void start_formulation();
  bool advance();
  void record_samples_up_to(double t);
  void record_at(double t);
  bool measure_drift(const State& state);
  void record_event_state();
  void record_singular_position(const SingularPosition& position);
  void record_last_row();
  double locate_events();
  double locate_crossing(int slot, double from, double to);
  bool handle_events(double t);
  void handle_event(const ForceSlot& slot, int event);
  EventContext context_of(const ForceSlot& slot);
  bool too_many_events();
  bool stalls(double t);
  std::string where_to_look();
  std::string blame();
  Cost cost() const;
  void finish();
  void summarise();
  void stop(Stop why, std::string reason);
  double sample_time(long i) const;

  const SimulationOptions& options_;
  FormulationEntry entry_;
  const Checkpoint* resumed_ = nullptr;
  Clock::time_point began_ = Clock::now();
  double wall_time_before_ = 0.0;  // [s] of the run that is gone on with
  Dynamics dynamics_;
  State state_;   // at the last restart; owns the discrete memory
  State sample_;  // scratch for dense output
  Result result_;
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<Formulation> formulation_;
  double t_start_;
  long next_sample_ = 0;
  Cost recording_;  // of samples, told apart from that of the steps
  std::unique_ptr<CheckpointWriter> writer_;
  std::uint64_t fingerprint_ = 0;
  long next_time_ = 1;     // number of the next checkpoint by time
  long events_since_ = 0;  // restarts at events since the last one
  Summary before_;         // counters up to the last checkpoint
  Cost cost_before_;       // of dynamics_ by then
  double window_start_ = 0.0;
  long window_events_ = 0;
  std::vector<double> local_acceleration_;
  std::vector<int> fired_;
  std::vector<double> event_values_;
  std::vector<ContactMemory> contacts_before_;
  double t_last_ = 0.0;
  std::array<double, 3> last_steps_{};  // [s]
  int stalled_steps_ = 0;
  bool stopped_ = false;
  bool parameters_changed_ = false;  // by the events being handled
};

Run::Run(const Model& model, const State& start, const SimulationOptions& options)
    : options_(options), dynamics_(model), state_(start), t_start_(start.t) {
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
  note_constraints();
  choose_formulation();
  set_up();
  if (options.checkpoints.folder.empty()) return;
  fingerprint_ = fingerprint(model);
  writer_ = std::make_unique<CheckpointWriter>(options.checkpoints.folder, nullptr);
}

Run::Run(const Model& model, const Checkpoint& c, const SimulationOptions& options)
    : options_(options),
      entry_(find_formulation(c.formulation)),
      resumed_(&c),
      dynamics_(model),
      state_(c.state),
      t_start_(c.summary.t_start),
      fingerprint_(c.model) {
  dynamics_.system().set_scales(c.scales);
  dynamics_.system().bind(state_);
  dynamics_.leave_out(c.dropped_rows);
  set_up();
  result_.summary = before_ = c.summary;
  wall_time_before_ = c.summary.wall_time;
  read_rows(options.checkpoints.folder, c, result_);
  writer_ = std::make_unique<CheckpointWriter>(options.checkpoints.folder, &c);
}

// What the assembly found out about the constraints.
void Run::note_constraints() {
  const System& system = dynamics_.system();
  const Redundancy& redundancy = dynamics_.redundancy();
  Summary& summary = result_.summary;
  summary.degrees_of_freedom =
      system.dofs() - (redundancy.here.rank > 0 ? redundancy.rank : system.rows());
  for (const int row : redundancy.redundant)
    summary.redundant_equations.push_back(system.equation_name(row));
  summary.not_unique_reactions = column_names(system, redundancy.doubts);
}

void Run::make_formulation() {
  formulation_ = guard_singular_positions(
      entry_, dynamics_, choose_tolerances(dynamics_.system(), state_, options_),
      [this](const SingularPosition& position) { record_singular_position(position); });
}

void Run::choose_formulation() {
  Choice choice{options_.formulation, "asked for"};
  if (choice.name == automatic)
    choice = yoke::choose_formulation(dynamics_.system(), state_, options_.relative_tolerance);
  entry_ = find_formulation(choice.name);
  result_.summary.formulation = entry_.name;
  result_.summary.formulation_reason = choice.reason;
}

// The workspace: after this a run depends on the state and the options alone.
void Run::set_up() {
  event_values_.assign(static_cast<std::size_t>(dynamics_.system().events()), 0.0);
  make_formulation();
  recorder_ = std::make_unique<Recorder>(dynamics_, result_,
                                         static_cast<std::size_t>(std::max(options_.samples, 0)));
  result_.events.reserve(1024);
  fired_.reserve(event_values_.size());
}

EventContext Run::context_of(const ForceSlot& slot) {
  System& system = dynamics_.system();
  local_acceleration_.assign(static_cast<std::size_t>(slot.columns), 0.0);
  for (int j = 0; j < slot.columns; ++j)
    if (const int dof = system.dof()[static_cast<std::size_t>(slot.dofs + j)]; dof >= 0)
      local_acceleration_[static_cast<std::size_t>(j)] = state_.a[dof];
  return {.input = system.force_input(slot),
          .contact = state_.contacts.data() + slot.contacts,
          .effective_mass = [this,
                             &slot](const double* d) { return dynamics_.effective_mass(slot, d); },
          .acceleration = local_acceleration_.data(),
          .dissipate =
              [this, &slot](double joules) {
                if (slot.dissipated >= 0) state_.energy[slot.dissipated] += joules;
              },
          .record =
              [this, &slot](EventRecord record) {
                record.t = state_.t;
                record.element = slot.element->name();
                result_.events.push_back(std::move(record));
              },
          .fail =
              [this, &slot](std::string reason) {
                stop(Stop::failed, fmt::format("'{}': {}", slot.element->name(), reason));
              },
          .stop =
              [this, &slot] {
                stop(Stop::by_event,
                     fmt::format("event '{}' at t = {:.9g} s", slot.element->name(), state_.t));
              },
          .parameter = [this](std::string_view name) -> double& {
            parameters_changed_ = true;
            return state_.parameters[dynamics_.system().model().find_parameter(name)];
          }};
}

bool Run::initialise() {
  if (resumed_ != nullptr) {
    recorder_->resume(resumed_->ledger);
    next_sample_ = resumed_->next_sample;
    next_time_ = resumed_->next_time;
    events_since_ = resumed_->events_since;
    window_start_ = resumed_->window_start;
    window_events_ = resumed_->window_events;
    contacts_before_ = state_.contacts;
    t_last_ = state_.t;
    sample_ = state_;
    start_formulation();
    return state_.t < options_.until;
  }
  for (const ForceSlot& slot : dynamics_.system().forces()) {
    if (slot.element->contacts() == 0) continue;
    EventContext context = context_of(slot);
    slot.element->initialise_contacts(context);
  }
  if (stopped_) return false;
  dynamics_.reset();  // a fresh factorisation: equal inputs, equal bits
  if (!dynamics_.project(state_)) {
    stop(Stop::failed, "accelerations at the start are not finite");
    return false;
  }
  sample_ = state_;
  recorder_->start(state_);
  formulation_->start(state_);
  record_event_state();
  window_start_ = t_last_ = state_.t;
  contacts_before_ = state_.contacts;
  if (writer_) write_checkpoint();
  return true;
}

double Run::next_stop() const {
  if (!writer_ || !(options_.checkpoints.every > 0.0)) return options_.until;
  return std::min(options_.until,
                  t_start_ + static_cast<double>(next_time_) * options_.checkpoints.every);
}

bool Run::checkpoint_due(double t) const {
  if (!writer_ || stopped_ || t >= options_.until) return false;
  const long every_events = options_.checkpoints.every_events;
  return t >= next_stop() || (every_events > 0 && events_since_ >= every_events);
}

// At a step's end that is not an event; false if the run cannot go on.
bool Run::reach_checkpoint(double t) {
  formulation_->interpolate(t, state_);
  if (!dynamics_.project(state_)) {
    stop(Stop::failed, fmt::format("the state at the checkpoint at t = {:.9g} s cannot be "
                                   "projected on the constraints",
                                   t));
    return false;
  }
  write_checkpoint();
  return true;
}

// Whoever goes on from here, this run or one that is taken up, starts from the same: this state,
// no factors, an integrator without a past.
void Run::write_checkpoint() {
  while (next_stop() <= state_.t && next_stop() < options_.until) ++next_time_;
  events_since_ = 0;
  t_last_ = state_.t;
  stalled_steps_ = 0;
  summarise();
  before_ = result_.summary;
  cost_before_ = cost();
  recording_ = {};
  const auto& [folder, every, every_events, resume] = options_.checkpoints;
  Checkpoint c{.model = fingerprint_,
               .until = options_.until,
               .relative_tolerance = options_.relative_tolerance,
               .formulation = std::string(entry_.name),
               .samples = options_.samples,
               .every = every,
               .every_events = every_events,
               .baumgarte_rate = options_.baumgarte_rate,
               .spectral_radius = options_.spectral_radius,
               .scales = dynamics_.system().scales(),
               .state = state_,
               .dropped_rows = dynamics_.system().dropped_rows(),
               .next_sample = next_sample_,
               .next_time = next_time_,
               .events_since = events_since_,
               .ledger = recorder_->ledger(),
               .summary = before_,
               .window_start = window_start_,
               .window_events = window_events_};
  writer_->write(c, result_);
  start_formulation();
}

void Run::start_formulation() {
  dynamics_.reset();
  make_formulation();
  formulation_->start(state_);
}

double Run::sample_time(long i) const {
  const long last = options_.samples - 1;
  if (i == last) return options_.until;
  return t_start_ +
         (options_.until - t_start_) * (static_cast<double>(i) / static_cast<double>(last));
}

// A sample that falls on a restart is taken from the projected state itself.
void Run::record_event_state() {
  if (next_sample_ < options_.samples && sample_time(next_sample_) == state_.t) {
    recorder_->record(state_);
    ++next_sample_;
  } else {
    recorder_->check(state_);
  }
}

// A run that ends by an event ends with a row of its own.
void Run::record_last_row() {
  if (options_.samples > 0) recorder_->record(state_);
}

void Run::record_singular_position(const SingularPosition& position) {
  result_.summary.singular_positions.push_back(position);
  result_.events.push_back({.t = position.t,
                            .element = position.equation.substr(0, position.equation.find(':')),
                            .kind = "singular_position",
                            .region = ""});
}

// How far the integrator has left the constraints. A formulation after Baumgarte follows a driver
// that jumps by a motion of its own; projection would then put the mechanism somewhere else.
bool Run::measure_drift(const State& state) {
  Summary& summary = result_.summary;
  summary.velocity_drift = std::max(summary.velocity_drift, dynamics_.velocity_violation(state));
  summary.position_drift = std::max(summary.position_drift, dynamics_.position_violation(state));
  const double drift = dynamics_.worst_residual();
  if (drift <= largest_drift * options_.relative_tolerance) return true;
  stop(
      Stop::failed,
      fmt::format("at t = {:.9g} s '{}' is violated by {:.1e} of the length scale (or rad), {:.0e} "
                  "times the tolerance: a driver or joint jumps, or the formulation drifts; try "
                  "another",
                  state.t, dynamics_.system().equation_name(dynamics_.worst_row()), drift,
                  drift / options_.relative_tolerance));
  return false;
}

void Run::record_at(double t) {
  formulation_->interpolate(t, sample_);
  if (!measure_drift(sample_)) return;
  if (!dynamics_.project(sample_)) {
    stop(Stop::failed, fmt::format("the state at t = {:.9g} s cannot be projected on the "
                                   "constraints; worst equation '{}'",
                                   t, dynamics_.system().equation_name(dynamics_.worst_row())));
    return;
  }
  recorder_->record(sample_);
}

void Run::record_samples_up_to(double t) {
  if (next_sample_ >= options_.samples || sample_time(next_sample_) > t) return;
  const Cost before = cost();
  sample_.contacts = state_.contacts;
  sample_.parameters = state_.parameters;
  while (!stopped_ && next_sample_ < options_.samples && sample_time(next_sample_) <= t) {
    record_at(sample_time(next_sample_));
    ++next_sample_;
  }
  dynamics_.system().bind(state_);
  recording_ += cost() - before;
}

bool Run::too_many_events() {
  if (state_.t - window_start_ > event_window * (options_.until - t_start_)) {
    window_start_ = state_.t;
    window_events_ = 0;
  }
  return ++window_events_ > max_events_in_window;
}

// When the events of this step happen: at the root the formulation located, or earlier, where
// another function crossed zero unnoticed because it came back within the step.
double Run::locate_events() {
  double t = formulation_->time();
  fired_ = formulation_->fired();
  for (const int slot : formulation_->passed()) {
    const double crossing = locate_crossing(slot, t_last_, formulation_->time());
    if (crossing < t) {
      t = crossing;
      fired_.clear();
    }
    if (crossing == t) fired_.push_back(slot);
  }
  dynamics_.system().bind(state_);
  return t;
}

double Run::locate_crossing(int slot, double from, double to) {
  const auto function = [&](double t) {
    formulation_->interpolate(t, sample_);
    System& system = dynamics_.system();
    system.set_motion(t, sample_.q.data(), sample_.v.data());
    system.set_states(sample_.z.data());
    system.calc_events(event_values_.data());
    return event_values_[static_cast<std::size_t>(slot)];
  };
  const double at_from = function(from), at_to = function(to);
  if (!(at_from < 0.0 && at_to > 0.0)) return to;
  std::uintmax_t iterations = 100;
  const auto bracket = boost::math::tools::toms748_solve(
      function, from, to, at_from, at_to,
      boost::math::tools::eps_tolerance<double>(std::numeric_limits<double>::digits), iterations);
  return bracket.second;
}

bool Run::handle_events(double t) {
  formulation_->interpolate(t, state_);
  if (!measure_drift(state_)) return false;
  if (!dynamics_.project(state_)) {
    stop(Stop::failed, fmt::format("the state at the event at t = {:.9g} s cannot be projected on "
                                   "the constraints",
                                   state_.t));
    return false;
  }
  contacts_before_ = state_.contacts;
  parameters_changed_ = false;
  state_.handled.clear();
  state_.handled_at = state_.t;
  for (const int fired : fired_) {
    for (const ForceSlot& slot : dynamics_.system().forces()) {
      if (fired < slot.events || fired >= slot.events + slot.element->events()) continue;
      handle_event(slot, fired - slot.events);
    }
  }
  if (result_.summary.stop == Stop::by_event) {
    dynamics_.calc_accelerations(state_);
    record_last_row();
  }
  if (stopped_) return false;
  const bool changed = parameters_changed_ || !(state_.contacts == contacts_before_);
  if (!changed && t == formulation_->time()) return true;  // nothing to restart for
  if (too_many_events())
    stop(Stop::failed,
         fmt::format("more than {} events within {:g} s before t = {:.9g} s, the last "
                     "of '{}': a contact that chatters; give it more damping or a "
                     "softer law",
                     max_events_in_window, event_window * (options_.until - t_start_), state_.t,
                     result_.events.empty() ? "?" : result_.events.back().element));
  if (!dynamics_.calc_accelerations(state_))
    stop(Stop::failed,
         fmt::format("accelerations after the event at t = {:.9g} s are not finite", state_.t));
  if (stopped_) return false;
  // What is left of the run is too short to be integrated.
  if (options_.until - t <= shortest_rest * std::abs(options_.until)) {
    state_.t = options_.until;
    result_.summary.t_end = options_.until;
    record_event_state();
    return false;
  }
  record_event_state();
  ++events_since_;
  if (checkpoint_due(t)) {
    write_checkpoint();
  } else {
    formulation_->start(state_);
  }
  return true;
}

void Run::handle_event(const ForceSlot& slot, int event) {
  if (slot.element->events_settle()) state_.handled.push_back(slot.events + event);
  EventContext context = context_of(slot);
  const EnergyTerms before = dynamics_.system().calc_energy();
  slot.element->handle_event(event, context);
  if (parameters_changed_) dynamics_.system().model().check_parameters(state_.parameters);
  if (!parameters_changed_ || slot.supplied < 0) return;
  const EnergyTerms after = dynamics_.system().calc_energy();
  state_.energy[slot.supplied] += after.potential + after.stored - before.potential - before.stored;
}

// IDA goes on for ever with steps that no longer move the time.
bool Run::stalls(double t) {
  const double resolvable = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(t);
  stalled_steps_ = t - t_last_ > resolvable ? 0 : stalled_steps_ + 1;
  t_last_ = t;
  return stalled_steps_ > max_stalled_steps;
}

/// What moves most violently at the last good state, and the steps on the way there: where to look.
std::string Run::where_to_look() {
  std::string text = fmt::format("; last steps {:.1e}, {:.1e}, {:.1e} s", last_steps_[0],
                                 last_steps_[1], last_steps_[2]);
  State& there = sample_;
  if (result_.summary.t_end > state_.t)
    formulation_->interpolate(result_.summary.t_end, there);
  else
    there = state_;
  there.contacts = state_.contacts;
  there.parameters = state_.parameters;
  if (!there.q.allFinite() || !dynamics_.calc_accelerations(there)) return text;
  const Scales scales = dynamics_.system().scales();
  Eigen::Index most = 0;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < there.a.size(); ++i) {
    const double size = std::abs(there.a[i]) / (i % 3 == 2 ? 1.0 : scales.length);
    if (size > largest) {
      largest = size;
      most = i;
    }
  }
  const auto& body = dynamics_.system().model().bodies()[static_cast<std::size_t>(most / 3) + 1];
  text += fmt::format("; the largest acceleration is that of '{}', {:.2g} {}", body.name,
                      there.a[most], most % 3 == 2 ? "rad/s^2" : "m/s^2");
  if (dynamics_.system().rows() > 0) {
    dynamics_.position_violation(there);
    text += fmt::format("; the equation violated most is '{}'",
                        dynamics_.system().equation_name(dynamics_.worst_row()));
  }
  return text;
}

/// Who is to blame for a step that fails, and what to try.
std::string Run::blame() {
  const std::string& culprit = dynamics_.system().not_finite();
  if (!culprit.empty())
    return fmt::format(": '{}' gives a value that is not finite there", culprit);
  const std::string last =
      result_.events.empty()
          ? ""
          : fmt::format(" (last event: {} of '{}' at t = {:.9g} s)", result_.events.back().kind,
                        result_.events.back().element, result_.events.back().t);
  return fmt::format(
      ": a force or driver has no limit there, or the tolerance is too tight{}; try "
      "a looser tolerance or another formulation{}",
      last, where_to_look());
}

bool Run::advance() {
  const Step step = formulation_->step(next_stop());
  const bool at_event = step == Step::event;
  const double t = at_event ? locate_events() : formulation_->time();
  if (step == Step::failed) {
    stop(Stop::failed,
         explained(formulation_->failure(), t,
                   fmt::format("the integrator stopped at t = {:.9g} s with a step of {:g} s{}", t,
                               formulation_->last_step(), blame())));
    return false;
  }
  if (stalls(t)) {
    stop(Stop::failed, fmt::format("the step size has run to zero at t = {:.9g} s{}", t, blame()));
    return false;
  }
  std::ranges::rotate(last_steps_, last_steps_.begin() + 1);
  last_steps_.back() = formulation_->last_step();
  // A sample exactly at the event is taken after it, from the projected state.
  record_samples_up_to(at_event ? std::nextafter(t, t_start_) : t);
  result_.summary.t_end = t;
  if (stopped_ || (at_event && !handle_events(t))) return false;
  if (!at_event && checkpoint_due(t) && !reach_checkpoint(t)) return false;
  if (options_.observer) {
    const Progress progress{.t = t,
                            .fraction = (t - t_start_) / (options_.until - t_start_),
                            .steps = before_.steps + formulation_->counters().steps,
                            .events = static_cast<long>(result_.events.size())};
    if (!options_.observer(progress)) {
      stop(Stop::interrupted, fmt::format("interrupted at t = {:.9g} s", t));
      return false;
    }
  }
  return t < options_.until;
}

void Run::stop(Stop why, std::string reason) {
  if (stopped_) return;
  stopped_ = true;
  result_.summary.stop = why;
  result_.summary.reason = std::move(reason);
}

Cost Run::cost() const {
  const FactorCounters& factors = dynamics_.counters();
  return {dynamics_.evaluations(), factors.refactorisations, factors.fresh};
}

void Run::finish() {
  if (!stopped_) stop(Stop::completed, "reached the end time");
  // The final state is that of the end time, however the run ended.
  if (result_.summary.t_end > state_.t) {
    formulation_->interpolate(result_.summary.t_end, state_);
    dynamics_.project(state_);
  }
  summarise();
}

void Run::summarise() {
  Summary& summary = result_.summary;
  summary.events = static_cast<long>(result_.events.size());
  const StepCounters counters = formulation_->counters();
  summary.steps = before_.steps + counters.steps;
  summary.rejected = before_.rejected + counters.rejected;
  summary.jacobians = before_.jacobians + counters.jacobians;
  const Cost stepping = cost() - cost_before_ - recording_;
  summary.evaluations = before_.evaluations + stepping.evaluations + counters.evaluations;
  summary.refactorisations =
      before_.refactorisations + stepping.refactorisations + counters.factors.refactorisations;
  summary.fresh_factorisations =
      before_.fresh_factorisations + stepping.fresh + counters.factors.fresh;
  summary.recording_evaluations = before_.recording_evaluations + recording_.evaluations;
  summary.last_step = formulation_->last_step();
  summary.wall_time =
      wall_time_before_ + std::chrono::duration<double>(Clock::now() - began_).count();
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
  const SimulationOptions options{
      .until = c->until,
      .relative_tolerance = c->relative_tolerance,
      .formulation = c->formulation,
      .samples = c->samples,
      .length_scale = c->scales.length,
      .time_scale = c->scales.time,
      .baumgarte_rate = c->baumgarte_rate,
      .spectral_radius = c->spectral_radius,
      .checkpoints = {.folder = folder, .every = c->every, .every_events = c->every_events},
      .observer = std::move(observer)};
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
