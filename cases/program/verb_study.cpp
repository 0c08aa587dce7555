// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke study CASE: tests what is claimed about a mechanism and prints a Markdown document.
#include <memory>

#include <yoke/cases/program/request.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

void add_study_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "study", "Test what is claimed about a case; prints Markdown, for docs/CASE.md");
  auto options = std::make_shared<RequestOptions>();
  add_case_options(*verb, *options);
  verb->callback([verb, options, &action] {
    action = [verb, options] {
      if (options->help) return print_help(*verb, *options);
      const Case& c = find_case(options->case_name);
      if (!c.study) throw ModelError(fmt::format("case '{}' has no study", c.name));
      return exit_code(c.study(make_request(c, *options)));
    };
  });
}

}  // namespace yoke::cases
