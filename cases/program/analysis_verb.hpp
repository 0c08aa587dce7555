// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the verbs of analyses share: `yoke kinematics CASE`, `inverse-dynamics`, `equilibrium`,
// `modes`.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

#include <yoke/cases/program/request.hpp>
#include <yoke/cases/program/verb.hpp>

namespace yoke::cases {

struct AnalysisOptions {
  RequestOptions request;
  std::string duration = "1s";  // of a motion
  std::string format = "text";
  bool allow_neutral = false;  // of an equilibrium
};

/// The verb with CASE, --set, --law, -o, --format, and what `more` adds; it runs `analyse` on the
/// model of the case.
void add_analysis_verb(
    CLI::App& app, Action& action, const char* name, const char* description,
    const std::function<void(CLI::App&, AnalysisOptions&)>& more,
    const std::function<int(const Model&, const RunRequest&, const AnalysisOptions&)>& analyse);

/// --duration and --samples, of a verb that follows a motion.
void add_motion_options(CLI::App& verb, AnalysisOptions& options);
/// Writes the result to -o, or results/CASE-VERB, prints what it came to and returns the exit code.
int report_motion(const Result& result, const RunRequest& request, const AnalysisOptions& options);
double duration_of(const AnalysisOptions& options);

}  // namespace yoke::cases
