// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/rows/sampling.hpp>

#include <algorithm>
#include <limits>

#include <yoke/integrators/run/constraint_summary.hpp>
#include <yoke/integrators/run/failure_messages.hpp>

namespace yoke {

double sample_time(long i, long samples, double start, double until) {
  if (i == samples - 1) return until;
  return start + (until - start) * (static_cast<double>(i) / static_cast<double>(samples - 1));
}

namespace {

constexpr double largest_drift = 1e4;  // in units of the tolerance; a step errs by about one

}  // namespace

RunSamples::RunSamples(Dynamics& dynamics, Result& result, const SimulationOptions& options,
                       double begin)
    : dynamics_(dynamics),
      result_(result),
      options_(options),
      recorder_(dynamics, result, static_cast<std::size_t>(std::max(options.samples, 0)),
                options.columns),
      contact_rows_(dynamics, options.contact_rows),
      begin_(begin) {
  if (contact_rows_.wanted()) result.contact_samples = result.samples.every(1);
  result.events.reserve(1024);
}

void RunSamples::resume(const Recorder::Ledger& ledger, long next) {
  recorder_.resume(ledger);
  next_ = next;
}

void RunSamples::go_back(const State& state, double initial_energy) {
  Recorder::Ledger ledger = recorder_.ledger();
  ledger.initial = initial_energy;
  recorder_.resume(ledger);
  const auto forget = [&](Table& table) {
    std::size_t rows = table.rows();
    while (rows > 0 && table.value(rows - 1, 0) > state.t) --rows;
    table.keep(rows);
  };
  forget(result_.samples);
  if (contact_rows_.wanted()) forget(result_.contact_samples);
  contact_rows_.start(state);
  const std::size_t rows = result_.samples.rows();
  const bool has_row = rows > 0 && result_.samples.value(rows - 1, 0) == state.t;
  next_ = 0;
  while (next_time() < state.t || (has_row && next_time() == state.t)) ++next_;
}

double RunSamples::next_time() const {
  if (next_ >= options_.samples) return std::numeric_limits<double>::infinity();
  return sample_time(next_, options_.samples, begin_, options_.until);
}

Outcome RunSamples::record_up_to(double t, Formulation& formulation, State& scratch) {
  Outcome outcome;
  for (; outcome && next_time() <= t; ++next_)
    outcome = record_at(next_time(), formulation, scratch, result_.samples);
  return outcome;
}

Outcome RunSamples::record_in_contact(const StepSpan& step, Formulation& formulation,
                                      State& scratch) {
  Outcome outcome;
  for (const double t : contact_rows_.due_in(step, dynamics_.system(), formulation, scratch))
    if (outcome) outcome = record_at(t, formulation, scratch, result_.contact_samples);
  return outcome;
}

Outcome RunSamples::record_at(double t, Formulation& formulation, State& scratch, Table& table) {
  formulation.sample(t, scratch);
  if (Outcome outcome = measure_drift(scratch); !outcome) return outcome;
  if (!dynamics_.project(scratch)) return {false, not_projected_equation(dynamics_, t)};
  recorder_.record(scratch, table);
  return {};
}

void RunSamples::record_restart(const State& state) {
  if (contact_rows_.begins(state)) recorder_.record(state, result_.contact_samples);
  if (next_time() == state.t) {
    recorder_.record(state);
    ++next_;
  } else {
    recorder_.check(state);
  }
}

void RunSamples::record_end(const State& state) {
  if (options_.samples > 0) recorder_.record(state);
}

// A formulation after Baumgarte follows a driver that jumps by a motion of its own; projection
// would then put the mechanism somewhere else.
Outcome RunSamples::measure_drift(const State& state) {
  note_drift(dynamics_, state, result_.summary);
  const double tolerance = options_.relative_tolerance;
  if (dynamics_.worst_residual() <= largest_drift * tolerance) return {};
  return {false, drifted(dynamics_, state.t, tolerance)};
}

}  // namespace yoke
