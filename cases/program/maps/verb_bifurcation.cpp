// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke bifurcation CASE --vary NAME=LOW:HIGH:N --at SECTION: the points of a section over a parameter.
#include <memory>

#include <yoke/cases/maps/maps.hpp>
#include <yoke/cases/program/maps/map_options.hpp>
#include <yoke/cases/program/verb.hpp>

namespace yoke::cases {

namespace {

struct DiagramOptions {
  MapOptions map{.discard = 200, .points = 100};
  std::string vary;
  bool both = false, backward = false, restart = false;
};

Continuation continuation_of(const DiagramOptions& o) {
  return o.both       ? Continuation::both
         : o.backward ? Continuation::backward
         : o.restart  ? Continuation::afresh
                      : Continuation::forward;
}

}  // namespace

void add_bifurcation_verb(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("bifurcation", "Draw the points of a section of a case over a parameter");
  auto options = std::make_shared<DiagramOptions>();
  add_map_options(*verb, options->map, false);
  verb->add_option("--vary", options->vary,
                   "The parameter: NAME=LOW:HIGH:N, NAME=LOW:HIGH:N:log, NAME=A,B,C")
      ->type_name("NAME=VALUES")
      ->allow_extra_args(false);
  CLI::Option* both = verb->add_flag(
      "--both", options->both, "Forward and backward, the state carried on: shows hysteresis");
  CLI::Option* backward = verb->add_flag("--backward", options->backward,
                                         "From the last value to the first, the state carried on");
  CLI::Option* restart = verb->add_flag("--restart", options->restart,
                                        "Every value from the start of the case, --jobs at a time");
  both->excludes(backward)->excludes(restart);
  backward->excludes(restart);
  verb->callback([verb, options, &action] {
    action = [verb, options] {
      if (options->map.run.help) return print_help(*verb, options->map.run);
      const Case& c = find_case(options->map.run.case_name);
      return exit_code(
          run_bifurcation(c, {.map = map_request(c, options->map, "bifurcation",
                                                 " --vary " + cases::quoted(options->vary)),
                              .vary = options->vary,
                              .continuation = continuation_of(*options)}));
    };
  });
}

}  // namespace yoke::cases
