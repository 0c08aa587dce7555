// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The samples of a run: when they are taken, uniformly and at both ends, and taking them from the
// dense output of its steps.
#pragma once

#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/run/recorder.hpp>
#include <yoke/integrators/run/rows/contact_rows.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke {

/// Time [s] of sample i of `samples`, uniform from `start` to `until`, both ends included.
double sample_time(long i, long samples, double start, double until);

class RunSamples {
 public:
  /// Of a run from `begin` [s]; adds the columns of the model to `result` and reserves its rows.
  RunSamples(Dynamics& dynamics, Result& result, const SimulationOptions& options, double begin);
  /// `state` (projected, with its accelerations) is the zero of the energy ledger.
  void start(const State& state) { recorder_.start(state); }
  /// Goes on with sample `next`.
  void resume(const Recorder::Ledger& ledger, long next);
  const Recorder::Ledger& ledger() const { return recorder_.ledger(); }
  void set_ledger(const Recorder::Ledger& ledger) { recorder_.resume(ledger); }
  /// Forgets rows behind `state`, where the run goes on with `initial_energy` [J] in its ledger; or
  /// leaves out those before it.
  void go_back(const State& state, double initial_energy);
  long next() const { return next_; }
  /// [s] Time of the next sample; infinity if there is none left.
  double next_time() const;
  ContactRows& contact_rows() { return contact_rows_; }

  /// Records what is due until `t` [s] in the last step of `formulation`. `scratch` has the memory
  /// and the parameters of that step; the system is left bound to it.
  Outcome record_up_to(double t, Formulation& formulation, State& scratch);
  /// Records the rows within contacts that are due in the step, likewise.
  Outcome record_in_contact(const StepSpan& step, Formulation& formulation, State& scratch);
  /// Records a state (projected) at which the integrator starts: a row if a sample is due there.
  void record_restart(const State& state);
  /// The row with which a run that is ended by an event ends.
  void record_end(const State& state);
  /// How far the integrator has left the constraints.
  Outcome measure_drift(const State& state);

 private:
  Outcome record_at(double t, Formulation& formulation, State& scratch, Table& table);

  Dynamics& dynamics_;
  Result& result_;
  const SimulationOptions& options_;
  Recorder recorder_;
  ContactRows contact_rows_;
  double begin_;
  long next_ = 0;  // number of the next sample
};

}  // namespace yoke
