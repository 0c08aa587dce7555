// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The yoke program. Verbs are in verb_*.cpp, cases in files of their own.
#include <cstdio>
#include <exception>

#include <yoke/cases/jobs/progress.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/version.hpp>

namespace {

using namespace yoke::cases;

int run(int argc, char** argv) {
  CLI::App app("Yoke, a planar multibody engine", "yoke");
  app.set_version_flag("--version", std::string("yoke ") + yoke::version);
  app.require_subcommand(1);
  Action action;
  add_run_verb(app, action);
  add_resume_verb(app, action);
  add_check_verb(app, action);
  add_kinematics_verb(app, action);
  add_inverse_dynamics_verb(app, action);
  add_equilibrium_verb(app, action);
  add_modes_verb(app, action);
  add_study_verb(app, action);
  add_validate_verb(app, action);
  add_law_verb(app, action);
  add_impact_verb(app, action);
  add_reproduce_verb(app, action);
  add_list_verb(app, action);
  if (argc == 1) {
    std::fputs(app.help().c_str(), stdout);
    return exit_usage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    std::string message = error.what();
    if (message == "A subcommand is required") message = "what to do? 'yoke VERB ...'";
    std::fprintf(stderr, "yoke: %s; try 'yoke --help'\n", message.c_str());
    return exit_usage;
  }
  catch_signals();
  return action();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "yoke: %s\n", error.what());
    return exit_failed;
  }
}
