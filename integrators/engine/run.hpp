// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// One run: a state that moves, what is recorded of it, and the formulation that moves it. The
// engine of Simulation.
//
// The formulation makes steps as long as it likes. The run shows a time that may be inside the
// last of them: what is behind it has been recorded, what is ahead of it has not happened yet. So
// where the run is stopped to be looked at changes nothing in it. Looks have equations of their own
// (`look_`), because the factors that those of the run reuse belong to its history.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/engine/run_watch.hpp>
#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/run/checkpoint_schedule.hpp>
#include <yoke/integrators/run/cost.hpp>
#include <yoke/integrators/run/event_dispatch.hpp>
#include <yoke/integrators/run/event_locator.hpp>
#include <yoke/integrators/run/impasse_watch.hpp>
#include <yoke/integrators/run/rows/sampling.hpp>
#include <yoke/integrators/run/stall_detector.hpp>
#include <yoke/integrators/simulation.hpp>

namespace yoke {

class Run {
 public:
  /// `options` must outlive the run.
  Run(const Model& model, const State& start, const SimulationOptions& options);
  /// Goes on from a checkpoint.
  Run(const Model& model, const Checkpoint& checkpoint, const SimulationOptions& options);
  /// A copy of another run, as it is where that one is shown.
  Run(Run& original, const SimulationOptions& options);
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// Who sees each step from now on; must outlive the run. Before begin().
  void watch(RunWatch& watch) { watch_ = &watch; }
  /// Once, before all that follows. What a user's function throws from here on ends the run.
  void begin();
  double time() const { return t_shown_; }  // [s]
  bool ended() const { return ended_; }
  const Summary& summary() const { return result_.summary; }
  const std::vector<EventRecord>& events() const { return result_.events; }
  /// To `t` [s], not before time(); false if the run has ended before.
  bool advance_to(double t);
  /// To the end of the step that time() is in, or of the next one; false if there is none.
  bool step();
  /// To the end; leaves nothing of the result behind.
  Result finish_run();
  /// The result up to time().
  Result result_so_far();

  /// The state at time(), projected, with accelerations; valid until the run goes on.
  const State& shown();
  /// The columns of the samples at time().
  const Table& outputs();
  const Table& columns();  // of outputs()
  /// A changeable parameter, from time() on. Throws ModelError if it may not have the value.
  void set_parameter(std::size_t index, double value);
  double parameter(std::size_t index) const;

  Snapshot snapshot();
  /// Throws ModelError.
  void restore(const Snapshot& snapshot);

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
  bool make_step();
  bool complete_step();
  void show(double t);
  void end();
  bool restart_if_disturbed();
  double next_sample() const;
  bool take_samples_due();
  bool reach_samples(double t, bool at_event);
  bool restart_at_sample(double t);
  void guarded(const std::function<void()>& f);
  bool observe(double t);
  void record_samples_up_to(double t);
  void record_in_contact(const StepSpan& step);
  void record(const std::function<Outcome()>& rows);
  void record_singular_position(const SingularPosition& position);
  double locate_events(Step step);
  void start_formulation(bool loads_only = false);
  bool handle_events(double t);
  bool restart_at_event(double t);
  bool reaches_end(double t);
  void check_restart();
  void calc_look();
  void settle();
  void disturb();
  void drive(const std::vector<double>& values);
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
  void note_steps();
  void summarise();
  void stop(Stop why, std::string reason);
  bool fail(std::string reason);

  /// What looks at the run from outside need; made with the first of them.
  struct Look {
    explicit Look(const Model& model);
    Dynamics dynamics;
    State state;
    bool known = false;  // is `state` that of the time shown?
    Result row;          // one row of its samples
    Recorder recorder;
    bool recorded = false;
  };

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
  double largest_independence_ = 0.0;  // of the constraints, seen so far
  ImpasseWatch impasse_;
  bool stopped_ = false;
  bool ended_ = false;
  double t_shown_;          // [s]
  bool ahead_ = false;      // the formulation is: a step is not completed
  double t_ahead_ = 0.0;    // [s] its end
  double t_behind_ = 0.0;   // [s] where that step began
  double t_sample_ = 0.0;   // [s] the next time at which controllers sample; not passed by a step
  bool disturbed_ = false;  // state_ is not what the formulation has: it starts from there
  bool stale_ = false;      // state_ has not the accelerations of its parameters
  bool stiffness_changed_ = false;
  std::unique_ptr<Look> look_;
  RunWatch* watch_ = nullptr;
};

}  // namespace yoke
