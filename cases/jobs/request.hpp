// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a user asks of a case, checked and in SI units.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <yoke/cases/choices/parameters.hpp>
#include <yoke/cases/jobs/plot.hpp>
#include <yoke/cases/results/output_table.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke::cases {

struct RunRequest {
  Parameters parameters;
  std::vector<std::string> laws;  // specifications; empty: a case without a choice of laws
  std::filesystem::path output;   // folder for the results
  int samples = 4001;             // rows of tables, uniform in time, both ends
  OutputChoice choice{};          // what of them is written, and how
  double most_gibibytes = 4.0;    // tables that would take more are kept only as far as asked for
  double relative_tolerance = 1e-10;  // impacts amplify errors
  std::string formulation = "automatic";
  bool plots = true;
  std::vector<Sheet> sheets{on_screen};     // that figures are drawn on
  bool films = false;                       // of animations
  bool report = false;                      // report.html
  std::string command{};                    // that asks for this, as a user would type it
  int jobs = 1;                             // runs at a time
  bool quiet = false;                       // print failures alone
  bool verify = false;                      // run again by another formulation and compare
  std::optional<double> spectral_radius{};  // of generalised-alpha; none: its default
  int order = 0;                            // of explicit Runge-Kutta steps; 0: what costs less
  std::string linear_solver = "automatic";
  double checkpoint_every = 0.0;  // [s] simulated time; 0: none by time
  long checkpoint_events = 0;     // 0: none at events
  bool resume = false;            // continue from the checkpoints in `output`
};

/// The options of simulate() for one run of a request that lasts until `until` [s], records
/// `samples` rows and keeps its checkpoints in `folder`.
SimulationOptions simulation_options(const RunRequest& request, double until, int samples,
                                     const std::filesystem::path& folder);

/// How a job ended.
enum class RunStatus { completed, failed, interrupted };

}  // namespace yoke::cases
