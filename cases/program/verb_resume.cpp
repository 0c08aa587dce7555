// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke resume DIR: goes on with a run that was interrupted or killed, from its last checkpoints.
// What has no checkpoint yet is run from its start.
#include <memory>
#include <string>

#include <yoke/cases/jobs/job.hpp>
#include <yoke/cases/paper/figures/case_figures.hpp>
#include <yoke/cases/program/request.hpp>
#include <yoke/cases/program/verb.hpp>

namespace yoke::cases {

void add_resume_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "resume", "Resume a run that was interrupted or killed, from its last checkpoint");
  auto folder = std::make_shared<std::string>();
  verb->add_option("DIR", *folder, "The folder 'yoke run ... --checkpoint TIME -o DIR' writes to")
      ->required();
  verb->callback([folder, &action] {
    action = [folder] {
      const RequestOptions options = load_options(*folder);
      const Case& c = find_case(options.case_name);
      RunRequest request = make_request(c, options);
      request.resume = true;
      return exit_code(run_case(c, request, paper_figures(c.name)));
    };
  });
}

}  // namespace yoke::cases
