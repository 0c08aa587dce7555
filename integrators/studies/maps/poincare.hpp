// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A Poincare section: what a run is at each point of a section, when the transient is over.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <yoke/core/result.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/integrators/studies/maps/section.hpp>

namespace yoke {

/// What is taken of a run, and how long.
struct PoincareOptions {
  std::vector<std::string> columns{};  // of the samples; empty: free_coordinates()
  std::size_t discard = 100;           // points of the transient that are left out
  std::size_t points = 400;            // kept, >= 1
  /// [s] The run lasts no longer than this, whatever points it has by then. 0: of Section::every alone,
  /// as long as it takes.
  double duration = 0.0;
  /// Points are the same if no column differs by more than this part of its range over the run, the
  /// transient included, or a hundred times what the tolerance of the run allows.
  double period_tolerance = 1e-3;
  SimulationOptions run{.samples = 0};          // until, samples and contact_rows do not count
  std::function<bool(std::size_t)> observer{};  // how many points so far; false: no more
};

/// The points, and what became of the run.
struct Poincare {
  Table points;  // t_s and the columns; at events of contacts also speed_m_per_s and penetration_m
  std::vector<double> range{};  // of each column of `points`, the transient included
  std::size_t discarded = 0;    // points of the transient
  std::size_t period =
      0;  // after how many points they repeat; 0: not within half of those there are
  bool complete = false;  // as many as were asked for
  std::string reason{};   // why not, a sentence
  State last{};       // at the last point of all, consistent; that of the start if there is none
  Summary summary{};  // of the run
};

/// Runs `model`, to which the section has been added, from its start or from `start`. Throws ModelError for
/// what is wrong before the run: options, columns, a section that the model does not have. Whatever
/// happens later, the points until then are there.
Poincare poincare(const Model& model, const Section& section, const PoincareOptions& options);
Poincare poincare(const Model& model, const State& start, const Section& section,
                  const PoincareOptions& options);

/// The smallest k <= rows / 2 such that every row is that k rows before within the tolerances, one for each
/// column and < 0 for one that does not count; 0: none. Angles ("..angle_rad") are the same up to turns.
std::size_t period_of(const Table& rows, const std::vector<double>& tolerances);

/// The state at which a run of another model goes on: bodies and elements of the same name keep positions,
/// velocities and states of their own; time, parameters and all else are those of `to`, a start of
/// `to_model`. Contacts are found anew, so one that lasts counts as begun there.
State carried_over(const Model& from_model, const State& from, const Model& to_model, State to);

/// [s] The time at which the driven coordinates of `state` are those that the drivers of `model` prescribe,
/// from `t` on by Newton's method; `t` if it is not found.
double time_of_drivers(const Model& model, const State& state, double t);

}  // namespace yoke
