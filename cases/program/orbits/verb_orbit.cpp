// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke orbit CASE: a periodic orbit by shooting, and its Floquet multipliers.
#include <memory>

#include <yoke/cases/orbits/orbit_job.hpp>
#include <yoke/cases/program/request.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

/// As they were typed.
struct OrbitOptions {
  RequestOptions run;
  std::string period, settle = "0s", coordinate;
  int turns = 0;
  bool autonomous = false, keep_angles = false;
  double tolerance = PeriodicOrbitOptions().tolerance;
};

void add_options(CLI::App& verb, OrbitOptions& o) {
  add_case_options(verb, o.run);
  verb.add_option("--law", o.run.laws, "Contact law; default: the case's first")
      ->type_name("LAW")
      ->allow_extra_args(false);
  verb.add_option("--friction", o.run.friction, "Friction in every contact")->type_name("FRICTION");
  verb.add_option(
          "--period", o.period,
          "Of the orbit: a multiple of the period of what drives it, or with --autonomous a "
          "guess; for instance 0.5s")
      ->type_name("TIME");
  verb.add_option("--turns", o.turns, "In its place this many turns of the driven crank")
      ->type_name("N");
  verb.add_flag("--autonomous", o.autonomous,
                "Nothing depends on time: the period is sought too, from --period on");
  verb.add_option("--settle", o.settle, "Run this long before, towards what attracts")
      ->type_name("TIME")
      ->capture_default_str();
  verb.add_option("--tolerance", o.tolerance,
                  "How near the motion must come to its start, in scales of the model")
      ->type_name("X")
      ->capture_default_str();
  verb.add_flag("--no-turns", o.keep_angles, "Bodies may not have turned by whole turns");
  verb.add_option("--coordinate", o.coordinate,
                  "Of the phase portrait: BODY.x, BODY.y, BODY.angle; default: the fastest")
      ->type_name("NAME");
  verb.add_option("--samples", o.run.samples, "Rows of orbit.csv, uniform in time")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("-o,--output", o.run.output, "Folder for the results")->type_name("DIR");
  verb.add_flag("--no-plots", o.run.no_plots, "Do not draw pictures");
  verb.add_flag("-q,--quiet", o.run.quiet, "Print what goes wrong alone");
}

double period_of(const OrbitOptions& o, const Model& model) {
  if (o.period.empty() == (o.turns == 0))
    throw ModelError(o.turns == 0 ? "orbit: give --period TIME or --turns N"
                                  : "orbit: give either --period or --turns, not both");
  return o.turns != 0 ? period_of_turns(model, o.turns)
                      : parse_quantity("--period", Quantity::time, o.period);
}

int run(const OrbitOptions& o) {
  const Case& c = find_case(o.run.case_name);
  RunRequest request = make_request(c, o.run);
  if (o.run.output.empty()) request.output = "results/orbit/" + c.name;
  const std::string law = o.run.laws.empty() && o.run.friction.empty() ? "" : request.laws.front();
  const Model model = make_model(c, request.parameters, law);
  const PeriodicOrbitOptions options{.period = period_of(o, model),
                                     .autonomous = o.autonomous,
                                     .settle = parse_quantity("--settle", Quantity::time, o.settle),
                                     .tolerance = o.tolerance,
                                     .whole_turns = !o.keep_angles};
  return exit_code(run_orbit(c.name, model, request, options, o.coordinate));
}

}  // namespace

void add_orbit_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "orbit", "Find a periodic orbit of a case, its Floquet multipliers and stability");
  auto options = std::make_shared<OrbitOptions>();
  options->run.samples = 1001;
  add_options(*verb, *options);
  verb->callback([verb, options, &action] {
    action = [verb, options] {
      return options->run.help ? print_help(*verb, options->run) : run(*options);
    };
  });
}

}  // namespace yoke::cases
