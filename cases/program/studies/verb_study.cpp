// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke study CASE: tests what is claimed about a mechanism and prints a Markdown document.
#include <memory>

#include <yoke/cases/paper/scotch_yoke_study.hpp>
#include <yoke/cases/program/request.hpp>
#include <yoke/cases/program/studies/geneva_study.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

int study(const RequestOptions& options) {
  const Case& c = find_case(options.case_name);
  if (c.name == "scotch_yoke") return exit_code(study_scotch_yoke(make_request(c, options)));
  if (c.name == "geneva") return exit_code(study_geneva(make_request(c, options)));
  throw ModelError(
      fmt::format("case '{}' has no study; 'scotch_yoke' and 'geneva' have one", c.name));
}

}  // namespace

void add_study_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(study_verbs[0].name, study_verbs[0].description);
  auto options = std::make_shared<RequestOptions>();
  add_case_options(*verb, *options);
  verb->callback([verb, options, &action] {
    action = [verb, options] {
      if (options->help) return print_help(*verb, *options);
      return study(*options);
    };
  });
}

}  // namespace yoke::cases
