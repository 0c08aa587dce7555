// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke run CASE: the job of a case, with its parameters set by name.
#include <memory>

#include <yoke/cases/jobs/job.hpp>
#include <yoke/cases/paper/figures/case_figures.hpp>
#include <yoke/cases/program/request.hpp>
#include <yoke/cases/program/verb.hpp>

namespace yoke::cases {

void add_run_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("run", "Run a case and write its results");
  auto options = std::make_shared<RequestOptions>();
  add_case_options(*verb, *options);
  add_output_options(*verb, *options);
  verb->callback([verb, options, &action] {
    action = [verb, options] {
      settle_paper(*options);
      if (options->help) return print_help(*verb, *options);
      const Case& c = find_case(options->case_name);
      const RunRequest request = make_request(c, *options);
      save_options(*options, request.output);
      return exit_code(run_case(c, request, paper_figures(c.name)));
    };
  });
}

}  // namespace yoke::cases
