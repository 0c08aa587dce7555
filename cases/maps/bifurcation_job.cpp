// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include <yoke/cases/jobs/progress.hpp>
#include <yoke/cases/maps/map_axis.hpp>
#include <yoke/cases/maps/map_figures.hpp>
#include <yoke/cases/maps/map_results.hpp>
#include <yoke/cases/maps/maps.hpp>
#include <yoke/core/output/csv_file.hpp>

namespace yoke::cases {

namespace {

/// The axis of a diagram is a parameter.
MapAxis diagram_axis(const Case& c, const std::string& vary) {
  if (vary.empty())
    throw ModelError("--vary: which parameter? accepted is NAME=LOW:HIGH:N or NAME=A,B,C");
  MapAxis axis = parse_map_axis(c, "--vary", vary);
  if (!axis.column.empty())
    throw ModelError(fmt::format("--vary {}: accepted is a parameter of the case", vary));
  return axis;
}

void write_periods(const std::filesystem::path& path, const Bifurcation& map) {
  CsvFile file(path);
  for (const char* name : {"value", "direction", "points", "period", "reason"}) file.cell(name);
  file.end_line();
  for (const BifurcationRow& row : map.rows) {
    file.cell(row.value);
    file.cell(row.backward ? "backward" : "forward");
    file.cell(static_cast<double>(row.points));
    file.cell(static_cast<double>(row.period));
    file.cell(std::string_view(row.reason));
    file.end_line();
  }
  file.finish();
}

/// Stretches of one period, "0.1 to 0.2: period 1".
void print_periods(const Bifurcation& map, std::size_t points) {
  constexpr std::size_t most_lines = 12;
  std::size_t lines = 0;
  for (std::size_t i = 0; i < map.rows.size();) {
    std::size_t end = i + 1;
    while (end < map.rows.size() && map.rows[end].period == map.rows[i].period &&
           map.rows[end].backward == map.rows[i].backward)
      ++end;
    if (++lines > most_lines) {
      fmt::print("  ... periods.csv has them all\n");
      return;
    }
    fmt::print("  {:<9} {:.6g}{}: {}\n", map.rows[i].backward ? "backward" : "forward",
               map.rows[i].value,
               end - i > 1 ? fmt::format(" to {:.6g}", map.rows[end - 1].value) : "",
               period_text(map.rows[i].period, points));
    i = end;
  }
}

void print_failures(const Bifurcation& map) {
  constexpr std::size_t most_lines = 5;
  std::size_t lines = 0;
  for (const BifurcationRow& row : map.rows)
    if (!row.reason.empty() && ++lines <= most_lines)
      fmt::print(stderr, "yoke: at {:.6g}: {}\n", row.value, row.reason);
  if (lines > most_lines) fmt::print(stderr, "yoke: and {} more\n", lines - most_lines);
}

void print_bifurcation(const Case& c, const BifurcationRequest& request, const MapAxis& axis,
                       const Bifurcation& map) {
  print_failures(map);
  if (request.map.quiet) return;
  fmt::print("{}: {} over {} values of {}, {} points\n", c.name, request.map.at,
             axis.axis.values.size(), axis.axis.name, map.points.rows());
  print_periods(map, request.map.points);
}

}  // namespace

RunStatus run_bifurcation(const Case& c, const BifurcationRequest& request) {
  const MapAxis axis = diagram_axis(c, request.vary);
  std::map<double, std::size_t> places;
  for (std::size_t i = 0; i < axis.axis.values.size(); ++i) places[axis.axis.values[i]] = i;
  const ModelOfParameter model = [&](double value) {
    return sectioned_model(c, request.map, axis.settings_at(places.at(value)));
  };
  double longest = 0.0;  // [s] run of the case at any of the values
  for (std::size_t i = 0; i < axis.axis.values.size(); ++i) {
    model(axis.axis.values[i]);  // says what is wrong before the first
    std::vector<std::string> settings = request.map.settings;
    settings.push_back(axis.settings[i]);
    longest = std::max(longest, c.duration(Parameters(c.parameters, settings)));
  }
  BifurcationOptions options{.map = map_options(c, request.map, model(axis.axis.values.front())),
                             .continuation = request.continuation,
                             .jobs = request.map.jobs,
                             .stop = [] { return interrupted(); }};
  if (request.map.duration == 0.0 && options.map.duration > 0.0)
    options.map.duration = static_cast<double>(request.map.discard + request.map.points) * longest;
  options.map.run.observer = [](const Progress&) { return !interrupted(); };
  MapProgress line(!request.map.quiet);
  options.observer = [&](std::size_t done, std::size_t total) { line.report(done, total); };
  const Bifurcation map = bifurcation(model, axis.axis.values, options);
  line.clear();
  make_output_folder(request.map.output);
  map.points.write_csv(request.map.output / "bifurcation.csv");
  write_periods(request.map.output / "periods.csv", map);
  const std::string label = axis.axis.unit.empty()
                                ? axis.axis.name
                                : fmt::format("{} [{}]", axis.axis.name, axis.axis.unit);
  const auto has = [&](bool backward) {
    return std::ranges::any_of(map.rows, [&](const auto& row) { return row.backward == backward; });
  };
  const std::string column = request.map.y.empty() ? options.map.columns.front() : request.map.y;
  const std::string plots =
      draw_map(request.map,
               bifurcation_figure(fmt::format("{}: {}", c.name, request.map.at), label, column,
                                  has(false), has(true)),
               map.points.rows());
  print_bifurcation(c, request, axis, map);
  if (!request.map.quiet) print_files(request.map, "bifurcation.csv, periods.csv", plots);
  if (!map.complete) return RunStatus::interrupted;
  const bool none = std::ranges::all_of(map.rows, [](const auto& row) { return row.points == 0; });
  return none ? RunStatus::failed : RunStatus::completed;
}

}  // namespace yoke::cases
