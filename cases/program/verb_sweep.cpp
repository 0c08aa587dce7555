// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke sweep CASE --vary NAME=LOW:HIGH:N ...: the case at many points.
#include <fmt/format.h>

#include <memory>

#include <yoke/cases/program/request.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/cases/sweep/mpi_ranks.hpp>
#include <yoke/cases/sweep/sweep.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

/// The options of the sweep as they were typed; those of each run beside them.
struct SweepOptions {
  RequestOptions run;
  SweepChoice choice;
  long random = 0, sobol = 0, seed = 1;
  std::vector<std::string> measures;
  std::string turn;
  bool keep_runs = false;
};

void add_point_options(CLI::App& verb, SweepOptions& o) {
  verb.add_option(
          "--vary", o.choice.vary,
          "What varies: a parameter, law, friction, rtol, formulation, spectral-radius, or a word "
          "in braces in --law; NAME=LOW:HIGH:N, NAME=LOW:HIGH:N:log, NAME=A,B,C; several make a "
          "grid")
      ->type_name("NAME=VALUES")
      ->allow_extra_args(false);
  verb.add_flag("--log", o.choice.logarithmic, "Divide ranges evenly in their logarithm");
  verb.add_option(
          "--random", o.random,
          "In place of the grid N random points of its box; the numbers of points of ranges do "
          "not count then")
      ->type_name("N");
  verb.add_option("--seed", o.seed, "Of the random points: the same seed, the same points")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--sobol", o.sobol, "The same with the first N points of Sobol's sequence")
      ->type_name("N");
  verb.add_option("--list", o.choice.list,
                  "Points of a CSV file: names in the first line, then values as typed")
      ->type_name("FILE");
}

void add_result_options(CLI::App& verb, SweepOptions& o) {
  verb.add_option("--law", o.choice.law,
                  "Contact law of all points; default: the case's first. Words in braces may vary: "
                  "--law 'hertz+flores:e={e}' --vary e=0.5:0.9:9")
      ->type_name("LAW");
  verb.add_option("--friction", o.choice.friction, "Friction in every contact, likewise")
      ->type_name("FRICTION");
  verb.add_option("--measure", o.measures,
                  "A column of the table: COLUMN:max, :min, :range, :mean, :rms, :final, or "
                  "COLUMN:at=TIME; repeatable")
      ->type_name("COLUMN:WHAT")
      ->allow_extra_args(false);
  verb.add_option("--turn", o.turn,
                  "The column whose angle counts turns; default: of the bodies that drivers move")
      ->type_name("COLUMN");
  verb.add_option("--from", o.run.from,
                  "Contacts, energy and measures count from this time on, for instance 0.5s")
      ->type_name("TIME");
  verb.add_option("--samples", o.run.samples, "Rows of each run, uniform in time, at least")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("-o,--output", o.run.output,
                  "Folder for the results; the same command goes on there")
      ->type_name("DIR");
  verb.add_flag("--keep-runs", o.keep_runs,
                "Keep results and report of each run, in DIR/runs/; large");
  verb.add_flag("--no-report", o.run.no_report, "Do not write report.html");
  verb.add_flag("-q,--quiet", o.run.quiet, "No progress, no summary: print what goes wrong alone");
}

void check_count(const CLI::App& verb, const char* option, long n) {
  if (verb.count(option) > 0 && (n < 1 || n > static_cast<long>(most_study_points)))
    throw ModelError(fmt::format("{} {}: accepted are 1 to {}", option, n, most_study_points));
}

/// One point's options: those of all, and what varies.
RequestOptions options_at(const Case& c, const RequestOptions& all, const SweepSetting& setting) {
  RequestOptions own = all;
  own.settings.insert(own.settings.end(), setting.parameters.begin(), setting.parameters.end());
  if (!setting.formulation.empty()) own.formulation = setting.formulation;
  if (!setting.spectral_radius.empty()) own.spectral_radius = setting.spectral_radius;
  if (!setting.rtol.empty())
    own.relative_tolerance = parse_quantity("rtol", Quantity::number, setting.rtol);
  // Without contacts at this point there is no law to choose.
  const Parameters parameters(c.parameters, own.settings);
  if (!c.contact.walls || c.contact.walls(parameters).empty()) return own;
  own.laws = {setting.law.empty() ? base_law_name(c.contact) : setting.law};
  own.friction = setting.friction;
  return own;
}

std::string command_of(const SweepOptions& o) {
  std::string text = "yoke sweep " + quoted(o.run.case_name);
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) text += fmt::format(" {} {}", name, quoted(value));
  };
  for (const std::string& setting : o.run.settings) add("--set", setting);
  for (const std::string& vary : o.choice.vary) add("--vary", vary);
  if (o.choice.logarithmic) text += " --log";
  if (o.random > 0) text += fmt::format(" --random {} --seed {}", o.random, o.seed);
  if (o.sobol > 0) text += fmt::format(" --sobol {}", o.sobol);
  add("--list", o.choice.list);
  add("--law", o.choice.law);
  add("--friction", o.choice.friction);
  for (const std::string& measure : o.measures) add("--measure", measure);
  add("--turn", o.turn);
  add("--from", o.run.from);
  const RequestOptions defaults;
  if (o.run.relative_tolerance != defaults.relative_tolerance)
    text += fmt::format(" --rtol {}", o.run.relative_tolerance);
  add("--formulation", o.run.formulation);
  if (o.run.samples != defaults.samples) text += fmt::format(" --samples {}", o.run.samples);
  return text + (o.keep_runs ? " --keep-runs" : "");
}

/// By the names of the options, for who compares two sweeps.
nlohmann::ordered_json typed_options(const SweepOptions& o) {
  return {{"--set", o.run.settings},
          {"--vary", o.choice.vary},
          {"--log", o.choice.logarithmic},
          {"--random", o.random},
          {"--sobol", o.sobol},
          {"--list", o.choice.list},
          {"--seed", o.seed},
          {"--law", o.choice.law},
          {"--friction", o.choice.friction},
          {"--measure", o.measures},
          {"--turn", o.turn},
          {"--from", o.run.from},
          {"--rtol", o.run.relative_tolerance},
          {"--formulation", o.run.formulation},
          {"--samples", o.run.samples},
          {"--keep-runs", o.keep_runs}};
}

SweepRequest sweep_request(const Case& c, SweepOptions& o) {
  SweepRequest request{.choice = o.choice};
  request.choice.random = static_cast<std::size_t>(o.random);
  request.choice.sobol = static_cast<std::size_t>(o.sobol);
  request.choice.seed = static_cast<std::uint64_t>(o.seed);
  if (c.contact.laws.empty() && !(o.choice.law.empty() && o.choice.friction.empty()))
    throw ModelError(fmt::format("--{} {}: case '{}' has no contact laws to choose from",
                                 o.choice.law.empty() ? "friction" : "law",
                                 o.choice.law.empty() ? o.choice.friction : o.choice.law, c.name));
  RequestOptions of_runs = o.run;  // --from is of the sweep: a kept run has all its rows
  of_runs.from.clear();
  request.request_of = [&c, of_runs](const SweepSetting& setting) {
    return make_request(c, options_at(c, of_runs, setting));
  };
  request.measures = o.measures;
  request.turn = o.turn;
  if (!o.run.from.empty()) request.from = parse_quantity("--from", Quantity::time, o.run.from);
  request.output = o.run.output.empty() ? std::filesystem::path("results/sweep") / c.name
                                        : std::filesystem::path(o.run.output);
  request.keep_runs = o.keep_runs;
  request.report = !o.run.no_report;
  request.jobs = o.run.jobs;
  request.quiet = o.run.quiet;
  request.command = command_of(o);
  request.typed = typed_options(o);
  return request;
}

/// Under mpirun on all of its ranks; else on threads.
int sweep_on_ranks(const Case& c, SweepOptions& o) {
  MpiRanks ranks;
  try {
    SweepRequest request = sweep_request(c, o);
    if (ranks.size() > 1) request.executor = ranks.executor(o.run.jobs);
    request.leads = ranks.rank() == 0;
    return exit_code(run_sweep(c, request));
  } catch (const ModelError&) {
    if (ranks.rank() == 0) throw;
    return exit_failed;  // rank 0 says the same
  }
}

}  // namespace

void add_sweep_verb(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("sweep", "Run a case at many points and write a table of what came out");
  auto options = std::make_shared<SweepOptions>();
  add_case_options(*verb, options->run);
  add_point_options(*verb, *options);
  add_result_options(*verb, *options);
  verb->callback([verb, options, &action] {
    action = [verb, options] {
      if (options->run.help) return print_help(*verb, options->run);
      const Case& c = find_case(options->run.case_name);
      if (options->seed < 0)
        throw ModelError(fmt::format("--seed {}: must be at least 0", options->seed));
      check_count(*verb, "--random", options->random);
      check_count(*verb, "--sobol", options->sobol);
      return sweep_on_ranks(c, *options);
    };
  });
}

}  // namespace yoke::cases
