// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/program/maps/map_options.hpp>

#include <fmt/format.h>

#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

constexpr long most_points = 100'000'000;

std::size_t checked_count(const char* option, long n, long least) {
  if (n < least || n > most_points)
    throw ModelError(fmt::format("{} {}: accepted are {} to {}", option, n, least, most_points));
  return static_cast<std::size_t>(n);
}

double checked_duration(const std::string& text) {
  if (text.empty()) return 0.0;
  const double duration = parse_quantity("--duration", Quantity::time, text);
  require_positive("--duration " + text, "time", duration, "s");
  return duration;
}

std::string map_command(const MapOptions& o, const std::string& verb, const std::string& more) {
  std::string text = fmt::format("yoke {} {}", verb, quoted(o.run.case_name));
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) text += fmt::format(" {} {}", name, quoted(value));
  };
  for (const std::string& setting : o.run.settings) add("--set", setting);
  add("--law", o.law);
  add("--friction", o.run.friction);
  add("--at", o.at);
  text += more;
  add("--x", o.x);
  add("--y", o.y);
  for (const std::string& column : o.run.columns) add("--columns", column);
  text += fmt::format(" --discard {} --points {}", o.discard, o.points);
  add("--duration", o.duration);
  text += fmt::format(" --rtol {}", o.run.relative_tolerance);
  add("--formulation", o.run.formulation);
  return text;
}

}  // namespace

void add_map_options(CLI::App& verb, MapOptions& o, bool with_x) {
  add_case_options(verb, o.run);
  verb.add_option("--at", o.at,
                  "When points are taken: every:TIME or every:PARAMETER (a time, or a frequency in "
                  "Hz), phase:DRIVER=ANGLE, event:ELEMENT.KIND, plane:COLUMN=VALUE; of the last "
                  "and of phase with :rising, :falling or :both behind it")
      ->type_name("SECTION");
  if (with_x)
    verb.add_option("--x", o.x, "Column to the right in the picture; default the first")
        ->type_name("COLUMN");
  verb.add_option("--y", o.y, "Column upwards in the picture")->type_name("COLUMN");
  verb.add_option("--columns", o.run.columns,
                  "Columns of the table; default: positions and velocities of the bodies that no "
                  "driver moves")
      ->type_name("COLUMNS")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--discard", o.discard, "Points of the transient that are left out")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--points", o.points, "Points that are kept")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--duration", o.duration,
                  "Simulated time of one run at most; default: that of the case for each point")
      ->type_name("TIME");
  verb.add_option("--law", o.law, "Contact law; default: the case's first")->type_name("LAW");
  verb.add_option("--friction", o.run.friction, "Friction in every contact")->type_name("FRICTION");
  verb.add_option("-o,--output", o.run.output, "Folder for the results")->type_name("DIR");
  verb.add_flag("--no-plots", o.run.no_plots, "Do not draw the picture");
  verb.add_flag("-q,--quiet", o.run.quiet, "No progress, no summary: print what goes wrong alone");
}

MapRequest map_request(const Case& c, const MapOptions& o, const std::string& verb,
                       const std::string& more) {
  RequestOptions checked = o.run;
  checked.columns.clear();
  checked.friction.clear();
  const RunRequest run = make_request(c, checked);
  return {.settings = o.run.settings,
          .law = o.law,
          .friction = o.run.friction,
          .at = o.at,
          .x = o.x,
          .y = o.y,
          .columns = o.run.columns,
          .discard = checked_count("--discard", o.discard, 0),
          .points = checked_count("--points", o.points, 1),
          .duration = checked_duration(o.duration),
          .relative_tolerance = o.run.relative_tolerance,
          .formulation = run.formulation,
          .output = o.run.output.empty() ? std::filesystem::path("results") / verb / c.name
                                         : std::filesystem::path(o.run.output),
          .jobs = run.jobs,
          .plots = !o.run.no_plots,
          .quiet = o.run.quiet,
          .command = map_command(o, verb, more)};
}

}  // namespace yoke::cases
