// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke completion SHELL: a script that completes verbs, options, cases.
#include <fmt/format.h>

#include <memory>
#include <string>

#include <yoke/cases/program/help/help.hpp>
#include <yoke/cases/program/verb.hpp>

namespace yoke::cases {

void add_completion_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("completion", "Print completion for a shell: bash, zsh");
  auto shell = std::make_shared<std::string>();
  verb->add_option("SHELL", *shell, "bash or zsh")->required();
  verb->callback([&app, shell, &action] {
    action = [&app, shell] {
      fmt::print("{}", completion_script(app, *shell));
      return exit_ok;
    };
  });
}

}  // namespace yoke::cases
