// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The yoke program. Verbs are in verb_*.cpp. Those of cases/program/studies/ are in a program of
// their own, yoke-studies, which this one calls: who runs a case need not compile them.
#include <yoke/cases/program/yoke.hpp>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <yoke/cases/program/program.hpp>

namespace yoke::cases {

namespace {

void add_verbs(CLI::App& app, Action& action) {
  add_run_verb(app, action);
  add_sweep_verb(app, action);
  add_poincare_verb(app, action);
  add_bifurcation_verb(app, action);
  add_basins_verb(app, action);
  add_orbit_verb(app, action);
  add_lyapunov_verb(app, action);
  add_resume_verb(app, action);
  add_view_verb(app, action);
  add_report_verb(app, action);
  add_compare_verb(app, action);
  add_check_verb(app, action);
  add_kinematics_verb(app, action);
  add_inverse_dynamics_verb(app, action);
  add_equilibrium_verb(app, action);
  add_modes_verb(app, action);
  add_law_verb(app, action);
  add_impact_verb(app, action);
  add_list_verb(app, action);
  add_fmu_verb(app, action);
  add_new_verb(app, action);
  add_completion_verb(app, action);
  add_man_verb(app, action);
  for (const StudyVerb& verb : study_verbs) app.add_subcommand(verb.name, verb.description);
}

/// Becomes the program yoke-studies, which lies beside this one. Returns only if that fails.
int call_studies(char** argv) {
  std::error_code unknown;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::string studies = (self.parent_path() / "yoke-studies").string();
  execv(studies.c_str(), argv);
  std::fprintf(stderr,
               "yoke: cannot start '%s' (%s), which has the verb '%s'; build it with './dev build' "
               "or install it beside yoke\n",
               studies.c_str(), std::strerror(errno), argv[1]);
  return exit_failed;
}

}  // namespace

int run_yoke(int argc, char** argv) {
  const bool study = argc > 1 && std::ranges::any_of(study_verbs, [&](const StudyVerb& verb) {
                       return std::string_view(argv[1]) == verb.name;
                     });
  return study ? call_studies(argv) : run_program(argc, argv, add_verbs);
}

}  // namespace yoke::cases
