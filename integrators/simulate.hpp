// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Runs a model in time. The user chooses a formulation by name and gives a tolerance, never a step.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/core/model.hpp>
#include <yoke/core/result.hpp>

namespace yoke {

/// Progress of a run, passed to the observer after every accepted step.
struct Progress {
  double t = 0.0;                  // [s]
  double fraction = 0.0;           // of the requested time, 0 to 1
  long steps = 0;                  // accepted so far
  long events = 0;                 // handled so far
  const Result* so_far = nullptr;  // samples and events until t; its summary is of no use yet
};

/// Where and when a run writes checkpoints: at simulated times or events, never by wall-clock time.
/// At each checkpoint the run restarts its integrator, so a resumed run gives the same bits as an
/// uninterrupted one. The schedule is therefore part of the result. More than a million by time are
/// refused; a schedule that would take long to write is warned of, see SimulationOptions::warning.
struct Checkpoints {
  std::filesystem::path folder{};  // needs a schedule, and a schedule needs it; empty: none
  double every = 0.0;              // [s] simulated time from one to the next; 0: not by time
  long every_events = 0;           // restarts at events from one to the next; 0: not by events
  bool resume = false;             // continue from the last one in the folder, if there is one
};

/// Scales and rates of 0 are chosen from the model; negative ones are rejected.
struct SimulationOptions {
  double until = 0.0;                     // [s] end time, > start time
  double relative_tolerance = 1e-8;       // 1e-13 to 1e-2
  std::string formulation = "automatic";  // or a name of formulations()
  int samples = 1001;                     // rows, uniform in time, both ends; 0 or >= 2
  /// Rows besides, in Result::contact_samples, that show each contact whole however short it is: 0
  /// is none; n >= 1 a row at its onset and at the end of each of the next n steps, of every second
  /// of the n steps after those, of every fourth of the 2 n after those, and so on; and rows at its
  /// events and where its force or its penetration is larger than ever before in it.
  int contact_rows = 0;
  /// Columns of the samples that are kept, by patterns with * and ? ("link 7.*"), besides the time;
  /// empty: all. What a large model has fills the memory.
  std::vector<std::string> columns{};
  double length_scale = 0.0;     // [m] error weight of positions
  double time_scale = 0.0;       // [s] of velocities: length / time
  double baumgarte_rate = 0.0;   // [1/s] gain after Baumgarte, see docs/numerics.md
  double spectral_radius = 0.8;  // 0 to 0.999, formulation generalised-alpha only
  int order = 0;                 // of explicit Runge-Kutta steps: 5, 7; 0: what costs less
  /// What solves for accelerations and multipliers: blocks (along the graph of the joints), range-klu,
  /// klu (the saddle matrix); automatic takes what costs less. See docs/numerics.md.
  std::string linear_solver = "automatic";
  Checkpoints checkpoints{};  // none unless given
  /// Called at every accepted step; returning false stops the run as interrupted, with what was
  /// computed so far.
  std::function<bool(const Progress&)> observer{};
  /// Called with what a user should know before the run goes on, a sentence each: so far that the
  /// checkpoints will take long to write.
  std::function<void(const std::string&)> warning{};
};

/// Integrates `model` from its start pose (assembled first) or from `start`.
/// Throws ModelError for options out of range, an unknown formulation, a start that cannot be
/// assembled. Result::summary reports whatever happens later, with the results up to then.
Result simulate(const Model& model, const SimulationOptions& options);
Result simulate(const Model& model, const State& start, const SimulationOptions& options);

/// Continues a run from the last checkpoint in `folder` to its original end. Throws
/// ModelError if there is none, if it is damaged, or of another model.
Result resume(const Model& model, const std::filesystem::path& folder,
              std::function<bool(const Progress&)> observer = {});

/// The consistent state a run starts from: positions and velocities on the constraints,
/// accelerations, multipliers, contacts touching or not. Throws ModelError naming the worst
/// equation.
State assembled_state(const Model& model);

/// Name and description of a formulation, the index of its equations and the family of its method;
/// verify() uses the latter two to choose an independent formulation.
struct FormulationNote {
  std::string_view name;         // as SimulationOptions::formulation takes it
  std::string_view description;  // a line
  int index = 1;                 // of its equations
  std::string_view family;       // of its method
  int order = 5;                 // highest
};
/// All there are, in the order of docs/numerics.md.
std::vector<FormulationNote> formulations();

}  // namespace yoke
