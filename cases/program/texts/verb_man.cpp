// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke man: the man page, of the same texts as the help.
#include <fmt/format.h>

#include <yoke/cases/program/help/help.hpp>
#include <yoke/cases/program/verb.hpp>

namespace yoke::cases {

void add_man_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("man", "Print the man page yoke(1)");
  verb->callback([&app, &action] {
    action = [&app] {
      fmt::print("{}", man_page(app));
      return exit_ok;
    };
  });
}

}  // namespace yoke::cases
