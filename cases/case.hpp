// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a case is: a mechanism with named parameters and a job that runs it. A new case is one file
// with a function that returns its Case, and one line in registry.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/cases/parameters.hpp>
#include <yoke/core/model.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke::cases {

/// What the user asked for on the command line.
struct RunRequest {
  Parameters parameters;
  std::vector<std::string> laws;      // chosen by name; empty: all of the case
  std::filesystem::path output;       // folder for the results
  int samples = 4001;                 // rows of motion.csv, uniform in time, both ends
  double relative_tolerance = 1e-10;  // impacts amplify errors
  std::string formulation;
  bool plots = true;
  int jobs = 1;                             // runs at a time
  bool verify = false;                      // run again by another formulation and compare
  std::optional<double> spectral_radius{};  // of generalised-alpha; none: its default
  double checkpoint_every = 0.0;            // [s] simulated time; 0: none by time
  long checkpoint_events = 0;               // 0: none at events
  bool resume = false;                      // go on from the checkpoints in `output`
};

/// What simulate() is to be told for one run of a request that writes into `folder`.
SimulationOptions simulation_options(const RunRequest& request, double until, int samples,
                                     const std::filesystem::path& folder);

/// How a job ended.
enum class RunStatus { completed, failed, interrupted };

struct LawNote {
  std::string name;
  std::string description;
};

struct Case {
  std::string name;
  std::string description;  // one line
  std::vector<CaseParameter> parameters;
  std::vector<LawNote> laws;  // contact laws the job runs; may be empty
  std::filesystem::path default_output;

  /// The mechanism, with one of the laws.
  std::function<Model(const Parameters&, std::string_view law)> model;
  /// Runs the job, writes the results and prints a table of them.
  std::function<RunStatus(const RunRequest&)> run;
  /// Optional: tests what is claimed about the mechanism and prints a Markdown document.
  std::function<RunStatus(const RunRequest&)> study{};
};

/// All cases. Adding one is a line in registry.cpp.
const std::vector<Case>& case_registry();

/// Throws ModelError that lists the cases.
const Case& find_case(std::string_view name);

/// The names among `laws`, in the order of the case and without repetition; all if `laws` is empty.
/// Throws ModelError for a name the case does not know.
std::vector<std::string> choose_laws(const Case& c, const std::vector<std::string>& laws);

}  // namespace yoke::cases
