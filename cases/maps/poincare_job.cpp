// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <fmt/format.h>

#include <yoke/cases/jobs/progress.hpp>
#include <yoke/cases/maps/map_figures.hpp>
#include <yoke/cases/maps/map_results.hpp>
#include <yoke/cases/maps/maps.hpp>

namespace yoke::cases {

namespace {

void print_poincare(const Case& c, const MapRequest& request, const Section& section,
                    const Poincare& map) {
  if (!map.complete) fmt::print(stderr, "yoke: {}\n", map.reason);
  if (request.quiet) return;
  fmt::print("{}: {} points at {} ({} before left out), {}\n", c.name, map.points.rows(),
             section.text(), map.discarded, period_text(map.period, map.points.rows()));
  print_ranges(map.points, 0);
}

}  // namespace

RunStatus run_poincare(const Case& c, const MapRequest& request) {
  const SectionedModel at = sectioned_model(c, request, {});
  PoincareOptions options = map_options(c, request, at);
  MapProgress line(!request.quiet);
  options.observer = [&](std::size_t points) {
    line.report(points, options.discard + options.points);
    return !interrupted();
  };
  options.run.observer = [](const Progress&) { return !interrupted(); };
  const Poincare map = poincare(at.model, at.start, at.section, options);
  line.clear();
  make_output_folder(request.output);
  map.points.write_csv(request.output / "poincare.csv");
  write_text(request.output / "summary.json", to_json(map.summary));
  const std::string x = request.x.empty() ? options.columns.front() : request.x,
                    y = !request.y.empty()           ? request.y
                        : options.columns.size() > 3 ? options.columns[3]
                                                     : options.columns.back();
  const std::string plots =
      draw_map(request, poincare_figure(fmt::format("{}: {}", c.name, at.section.text()), x, y),
               map.points.rows());
  print_poincare(c, request, at.section, map);
  if (!request.quiet) print_files(request, "poincare.csv, summary.json", plots);
  if (interrupted()) return RunStatus::interrupted;
  return map.complete ? RunStatus::completed : RunStatus::failed;
}

}  // namespace yoke::cases
