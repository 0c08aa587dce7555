// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke study CASE: tests what is claimed about a mechanism and prints a Markdown document; of cases
// without a study of their own, until when formulations agree.
#include <memory>

#include <yoke/cases/paper/scotch_yoke_study.hpp>
#include <yoke/cases/program/request.hpp>
#include <yoke/cases/program/studies/agreement_study.hpp>
#include <yoke/cases/program/studies/geneva_study.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

int study(const RequestOptions& options, bool agreement) {
  const Case& c = find_case(options.case_name);
  if (agreement) return exit_code(study_agreement(c, make_request(c, options)));
  if (c.name == "scotch_yoke") return exit_code(study_scotch_yoke(make_request(c, options)));
  if (c.name == "geneva") return exit_code(study_geneva(make_request(c, options)));
  return exit_code(study_agreement(c, make_request(c, options)));
}

}  // namespace

void add_study_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(study_verbs[0].name, study_verbs[0].description);
  auto options = std::make_shared<RequestOptions>();
  add_case_options(*verb, *options);
  auto agreement = std::make_shared<bool>(false);
  verb->add_flag(
      "--agreement", *agreement,
      "Until when formulations agree; what is printed of cases without a study of their own");
  verb->callback([verb, options, agreement, &action] {
    action = [verb, options, agreement] {
      if (options->help) return print_help(*verb, *options);
      return study(*options, *agreement);
    };
  });
}

}  // namespace yoke::cases
