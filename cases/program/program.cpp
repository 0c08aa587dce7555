// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/program/program.hpp>

#include <cstdio>
#include <exception>
#include <string>

#include <yoke/cases/jobs/progress.hpp>
#include <yoke/cases/program/help/help.hpp>
#include <yoke/core/version.hpp>

namespace yoke::cases {

namespace {

int run(int argc, char** argv, const std::function<void(CLI::App&, Action&)>& add_verbs) {
  CLI::App app("Yoke, a planar multibody engine", "yoke");
  app.set_version_flag("--version", std::string("yoke ") + yoke::version);
  app.require_subcommand(1);
  Action action;
  add_verbs(app, action);
  add_help_texts(app);
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
    message += nearest_meant(app, {argv + 1, argv + argc});
    std::fprintf(stderr, "yoke: %s%s try 'yoke --help'\n", message.c_str(),
                 message.ends_with('?') ? "" : ";");
    return exit_usage;
  }
  catch_signals();
  return action();
}

}  // namespace

int run_program(int argc, char** argv, const std::function<void(CLI::App&, Action&)>& add_verbs) {
  try {
    return run(argc, argv, add_verbs);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "yoke: %s\n", error.what());
    return exit_failed;
  }
}

}  // namespace yoke::cases
