// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The rows that show a contact whole, however short it is beside the time from sample to sample:
// SimulationOptions::contact_rows.
#pragma once

#include <vector>

#include <yoke/integrators/run/rows/contact_peaks.hpp>

namespace yoke {

/// One step of a formulation, as far as nothing happened in it.
struct StepSpan {
  double from = 0.0, to = 0.0;  // [s]
  double end = 0.0;             // [s] where its last row goes: `to`, or just before an event there
  bool at_event = false;
};

/// When rows are due within the steps of a contact.
class ContactRows {
 public:
  /// `wanted`: SimulationOptions::contact_rows.
  ContactRows(const Dynamics& dynamics, int wanted);
  bool wanted() const { return wanted_ > 0; }
  /// Does something touch?
  bool counts() const { return wanted() && touching_ > 0; }
  /// Counts from here, whatever touches.
  void start(const State& state);
  /// At a restart: has a contact begun? Then it counts from here.
  bool begins(const State& state);
  /// [s] Rising times of the rows that are due in a step, in which `scratch` has the memory and the
  /// parameters. The system is left bound to it. Valid until the next call.
  const std::vector<double>& due_in(const StepSpan& step, System& system, Formulation& formulation,
                                    State& scratch);

 private:
  bool is_due();

  int wanted_;
  std::ptrdiff_t touching_ = 0;  // contacts
  long steps_ = 0;               // since the last of them began
  ContactPeaks peaks_;
  std::vector<double> times_;
};

}  // namespace yoke
