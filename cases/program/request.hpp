// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The command line of a verb that works on a case: CASE, --set, -o, --law, --samples, --rtol ...
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/cases/jobs/request.hpp>

namespace yoke::cases {

/// The options as they were typed.
struct RequestOptions {
  std::string case_name;
  std::vector<std::string> settings;
  std::string output;
  std::vector<std::string> laws;
  std::string friction{};
  int samples = 4001;
  double relative_tolerance = 1e-10;
  std::string formulation;
  int jobs = 0;
  bool no_plots = false;
  bool no_report = false;
  std::string paper;  // "single", "double", "both"; "": no figures for print
  bool verify = false;
  bool quiet = false;
  std::string checkpoint;       // simulated time between checkpoints, "0.01s"; "": none by time
  long checkpoint_events = 0;   // 0: none by events
  std::string spectral_radius;  // "": its default
  long order = 0;               // of explicit Runge-Kutta steps; 0: what costs less
  std::string linear_solver = "automatic";
  std::string format = "csv";
  std::vector<std::string> columns{};  // patterns; empty: all
  long every = 1;                      // rows
  std::string from{};                  // simulated time; "": the start
  bool events_only = false;
  bool help = false;
};

/// What every verb that works on a case takes: CASE, --set, --rtol, --formulation, --jobs, --help.
void add_case_options(CLI::App& verb, RequestOptions& options);
/// What a verb that writes results takes besides: -o, --law, --samples, --no-plots, --paper, --no-report, --verify,
/// --checkpoint, --checkpoint-events, --spectral-radius, --linear-solver, --format, --columns, --every, --from, --events-only, --quiet.
void add_output_options(CLI::App& verb, RequestOptions& options);

/// The case in `run --paper CASE`, where it stands in the place of the optional word.
void settle_paper(RequestOptions& options);

/// A word as a shell takes it, in quotes where it needs them.
std::string quoted(const std::string& word);

/// What was typed, of what decides what a run computes and writes.
nlohmann::ordered_json to_json(const RequestOptions& options);
/// Keeps what was typed in FOLDER/run.json, so that `yoke resume FOLDER` can go on.
void save_options(const RequestOptions& options, const std::filesystem::path& folder);
/// What was typed. Throws ModelError if the folder holds no such file or a damaged one.
RequestOptions load_options(const std::filesystem::path& folder);

/// Checks everything that can be checked before the first step. Throws ModelError.
RunRequest make_request(const Case& c, const RequestOptions& options);

/// Help of the verb, with the parameters and laws of the case if one was named.
int print_help(const CLI::App& verb, const RequestOptions& options);

int exit_code(RunStatus status);

}  // namespace yoke::cases
