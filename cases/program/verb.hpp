// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A verb of the program: `yoke VERB ...`. Each lives in a file of its own, verb_NAME.cpp, and has
// one line in yoke.cpp. It adds its subcommand to the parser and sets `action` to what shall happen
// when the user has chosen it.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace yoke::cases {

/// Exit codes of the program.
enum Exit : int { exit_ok = 0, exit_failed = 1, exit_usage = 2, exit_interrupted = 130 };

/// What the program does once the command line is understood; returns the exit code.
using Action = std::function<int()>;

void add_run_verb(CLI::App& app, Action& action);
void add_sweep_verb(CLI::App& app, Action& action);
void add_poincare_verb(CLI::App& app, Action& action);
void add_bifurcation_verb(CLI::App& app, Action& action);
void add_basins_verb(CLI::App& app, Action& action);
void add_orbit_verb(CLI::App& app, Action& action);
void add_lyapunov_verb(CLI::App& app, Action& action);
void add_resume_verb(CLI::App& app, Action& action);
void add_view_verb(CLI::App& app, Action& action);
void add_report_verb(CLI::App& app, Action& action);
void add_compare_verb(CLI::App& app, Action& action);
void add_law_verb(CLI::App& app, Action& action);
void add_impact_verb(CLI::App& app, Action& action);
void add_check_verb(CLI::App& app, Action& action);
void add_kinematics_verb(CLI::App& app, Action& action);
void add_inverse_dynamics_verb(CLI::App& app, Action& action);
void add_equilibrium_verb(CLI::App& app, Action& action);
void add_modes_verb(CLI::App& app, Action& action);
void add_list_verb(CLI::App& app, Action& action);
void add_fmu_verb(CLI::App& app, Action& action);
void add_new_verb(CLI::App& app, Action& action);
void add_completion_verb(CLI::App& app, Action& action);
void add_man_verb(CLI::App& app, Action& action);

/// The verbs of the program yoke-studies.
struct StudyVerb {
  const char* name;
  const char* description;
};
inline constexpr StudyVerb study_verbs[] = {
    {"study", "Test what is said about a case, or until when formulations agree; prints Markdown"},
    {"validate", "Measure the engine against reference solutions; prints Markdown"},
    {"reproduce", "Reproduce the paper's tables and figures of the contact laws"},
};
void add_study_verb(CLI::App& app, Action& action);
void add_validate_verb(CLI::App& app, Action& action);
void add_reproduce_verb(CLI::App& app, Action& action);

}  // namespace yoke::cases
