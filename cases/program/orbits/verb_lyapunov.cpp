// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke lyapunov CASE: its largest Lyapunov exponents.
#include <memory>

#include <yoke/cases/orbits/orbit_job.hpp>
#include <yoke/cases/program/request.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

/// As they were typed.
struct ExponentOptions {
  RequestOptions run;
  std::string until, transient = "0s", interval;
  int exponents = 1;
};

void add_options(CLI::App& verb, ExponentOptions& o) {
  add_case_options(verb, o.run);
  verb.add_option("--law", o.run.laws, "Contact law; default: the case's first")
      ->type_name("LAW")
      ->allow_extra_args(false);
  verb.add_option("--friction", o.run.friction, "Friction in every contact")->type_name("FRICTION");
  verb.add_option("--until", o.until, "End of the run; default: that of the case")
      ->type_name("TIME");
  verb.add_option("--transient", o.transient, "What of it does not count, at the beginning")
      ->type_name("TIME")
      ->capture_default_str();
  verb.add_option("--interval", o.interval,
                  "Between orthonormalisations; default: a thousandth of the run")
      ->type_name("TIME");
  verb.add_option("--exponents", o.exponents, "How many, the largest; 0: all")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("-o,--output", o.run.output, "Folder for the results")->type_name("DIR");
  verb.add_flag("--no-plots", o.run.no_plots, "Do not draw pictures");
  verb.add_flag("-q,--quiet", o.run.quiet, "Print what goes wrong alone");
}

int run(const ExponentOptions& o) {
  const Case& c = find_case(o.run.case_name);
  RunRequest request = make_request(c, o.run);
  if (o.run.output.empty()) request.output = "results/lyapunov/" + c.name;
  const std::string law = o.run.laws.empty() && o.run.friction.empty() ? "" : request.laws.front();
  const Model model = make_model(c, request.parameters, law);
  const auto time = [](const char* option, const std::string& text) {
    return text.empty() ? 0.0 : parse_quantity(option, Quantity::time, text);
  };
  const LyapunovOptions options{
      .until = o.until.empty() ? c.duration(request.parameters) : time("--until", o.until),
      .transient = time("--transient", o.transient),
      .interval = time("--interval", o.interval),
      .exponents = o.exponents};
  return exit_code(run_lyapunov(c.name, model, request, options));
}

}  // namespace

void add_lyapunov_verb(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("lyapunov", "Measure the largest Lyapunov exponents of a case");
  auto options = std::make_shared<ExponentOptions>();
  options->run.relative_tolerance = 1e-9;
  add_options(*verb, *options);
  verb->callback([verb, options, &action] {
    action = [verb, options] {
      return options->run.help ? print_help(*verb, options->run) : run(*options);
    };
  });
}

}  // namespace yoke::cases
