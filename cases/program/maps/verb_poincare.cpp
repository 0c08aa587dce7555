// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke poincare CASE --at SECTION: the points of a section.
#include <memory>

#include <yoke/cases/maps/maps.hpp>
#include <yoke/cases/program/maps/map_options.hpp>
#include <yoke/cases/program/verb.hpp>

namespace yoke::cases {

void add_poincare_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "poincare", "Take the points of a Poincare section of a case and draw them");
  auto options = std::make_shared<MapOptions>();
  add_map_options(*verb, *options, true);
  verb->callback([verb, options, &action] {
    action = [verb, options] {
      if (options->run.help) return print_help(*verb, options->run);
      const Case& c = find_case(options->run.case_name);
      return exit_code(run_poincare(c, map_request(c, *options, "poincare", "")));
    };
  });
}

}  // namespace yoke::cases
