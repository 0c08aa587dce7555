// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke basins CASE --grid X=LOW:HIGH:N --grid Y=LOW:HIGH:N --at SECTION: where each start leads.
#include <memory>

#include <yoke/cases/maps/maps.hpp>
#include <yoke/cases/program/maps/map_options.hpp>
#include <yoke/cases/program/verb.hpp>

namespace yoke::cases {

namespace {

struct BasinVerbOptions {
  MapOptions map{.discard = 100, .points = 24};
  std::vector<std::string> grid;
};

}  // namespace

void add_basins_verb(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("basins", "Draw which attractor each start of a grid leads to");
  auto options = std::make_shared<BasinVerbOptions>();
  add_map_options(*verb, options->map, false);
  verb->add_option(
          "--grid", options->grid,
          "Twice: a parameter of the case that sets the start, or a coordinate or velocity of "
          "a body there, BODY.vx_m_per_s=LOW:HIGH:N in SI units")
      ->type_name("NAME=LOW:HIGH:N")
      ->allow_extra_args(false);
  verb->callback([verb, options, &action] {
    action = [verb, options] {
      if (options->map.run.help) return print_help(*verb, options->map.run);
      const Case& c = find_case(options->map.run.case_name);
      std::string more;
      for (const std::string& text : options->grid) more += " --grid " + cases::quoted(text);
      return exit_code(run_basins(
          c, {.map = map_request(c, options->map, "basins", more), .grid = options->grid}));
    };
  });
}

}  // namespace yoke::cases
