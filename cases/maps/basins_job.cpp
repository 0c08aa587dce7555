// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <fmt/format.h>

#include <algorithm>

#include <yoke/cases/jobs/progress.hpp>
#include <yoke/cases/maps/map_axis.hpp>
#include <yoke/cases/maps/map_figures.hpp>
#include <yoke/cases/maps/map_results.hpp>
#include <yoke/cases/maps/maps.hpp>
#include <yoke/core/output/csv_file.hpp>

namespace yoke::cases {

namespace {

std::vector<MapAxis> grid_axes(const Case& c, const std::vector<std::string>& typed) {
  if (typed.size() != 2)
    throw ModelError(
        fmt::format("--grid: {} axes; there must be two, each NAME=LOW:HIGH:N", typed.size()));
  std::vector<MapAxis> axes;
  for (const std::string& text : typed) axes.push_back(parse_map_axis(c, "--grid", text));
  return axes;
}

void write_attractors(const std::filesystem::path& path, const Basins& map) {
  CsvFile file(path);
  for (const char* name : {"attractor", "period", "starts", "first"}) file.cell(name);
  for (const std::string& name : map.columns) file.cell(std::string_view("mean." + name));
  for (const std::string& name : map.columns) file.cell(std::string_view("scatter." + name));
  file.end_line();
  for (std::size_t a = 0; a < map.attractors.size(); ++a) {
    const Attractor& found = map.attractors[a];
    for (const std::size_t n : {a + 1, found.period, found.starts, found.first})
      file.cell(static_cast<double>(n));
    for (const double x : found.mean) file.cell(x);
    for (const double x : found.scatter) file.cell(x);
    file.end_line();
  }
  file.finish();
}

void print_basins(const Case& c, const BasinRequest& request, const Basins& map) {
  const StudyProgress& p = map.study.progress;
  if (p.failed > 0) {
    const auto failed = std::ranges::find(map.study.rows, PointState::failed, &StudyRow::state);
    fmt::print(stderr, "yoke: {} of {} starts failed, the first (start {}): {}\n", p.failed,
               p.total, failed->point, failed->reason);
  }
  if (request.map.quiet) return;
  fmt::print("{}: {} of starts, {} done ({} from before), {} failed, {:.1f} s\n", c.name,
             map.study.points.origin(), p.done, p.reused, p.failed, p.elapsed);
  constexpr std::size_t most_lines = 10;
  for (std::size_t a = 0; a < std::min(map.attractors.size(), most_lines); ++a) {
    const Attractor& found = map.attractors[a];
    fmt::print("  attractor {:<3} {:>5.1f} % of starts, {}\n", a + 1,
               100.0 * static_cast<double>(found.starts) / static_cast<double>(p.total),
               period_text(found.period, request.map.points));
  }
  if (map.attractors.size() > most_lines)
    fmt::print("  ... {} attractors in all: attractors.csv\n", map.attractors.size());
  const auto unbounded = std::ranges::count(map.attractor, static_cast<int>(basin_unbounded));
  if (unbounded > 0) fmt::print("  unbounded     {} starts\n", unbounded);
}

}  // namespace

RunStatus run_basins(const Case& c, const BasinRequest& request) {
  const std::vector<MapAxis> axes = grid_axes(c, request.grid);
  const std::size_t down = axes[1].axis.values.size();
  const ModelOfStart model = [&](const StudyPoint& point) {
    const std::size_t i = point.index() / down, j = point.index() % down;
    std::vector<std::string> settings = axes[0].settings_at(i);
    for (const std::string& s : axes[1].settings_at(j)) settings.push_back(s);
    SectionedModel made = sectioned_model(c, request.map, settings);
    for (const MapAxis& axis : axes)
      if (!axis.column.empty())
        set_start(made.model, made.start, axis.column, point[axis.axis.name]);
    return made;
  };
  const StudyPoints grid = grid_points({axes[0].axis, axes[1].axis});
  BasinOptions options{.map = map_options(c, request.map, model(StudyPoint(grid, 0)))};
  options.map.run.observer = [](const Progress&) { return !interrupted(); };
  StudyProgressLine line(!request.map.quiet);
  options.study = {.jobs = request.map.jobs,
                   .folder = request.map.output,
                   .identity = request.map.command,
                   .observer = [&](const StudyProgress& progress) { line.report(progress); },
                   .stop = [] { return interrupted(); }};
  make_output_folder(request.map.output);
  const Basins map = basins(model, grid, options);
  line.clear();
  map.table().write_csv(request.map.output / "basins.csv");
  write_attractors(request.map.output / "attractors.csv", map);
  const std::string plots = draw_map(
      request.map, basins_figure(fmt::format("{}: basins, {}", c.name, request.map.at), map),
      map.study.progress.done);
  print_basins(c, request, map);
  if (!request.map.quiet) print_files(request.map, "basins.csv, attractors.csv", plots);
  if (!map.study.complete) return RunStatus::interrupted;
  return map.study.progress.failed == map.study.progress.total ? RunStatus::failed
                                                               : RunStatus::completed;
}

}  // namespace yoke::cases
