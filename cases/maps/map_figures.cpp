// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/maps/map_figures.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include <yoke/cases/jobs/figure_parts.hpp>
#include <yoke/cases/maps/section_choice.hpp>

namespace yoke::cases {

namespace {

/// Of attractors; the first are told apart by everybody.
constexpr std::array<const char*, 10> map_colours{"#4477aa", "#ee6677", "#228833", "#ccbb44",
                                                  "#66ccee", "#aa3377", "#bbbbbb", "#994455",
                                                  "#997700", "#6699cc"};
constexpr const char* colour_of_unbounded = "#222222";

std::string labels(const std::string& title, const std::string& x, const std::string& y) {
  return fmt::format(
      "  set title {} noenhanced\n  set xlabel {} noenhanced\n  set ylabel {} noenhanced\n",
      gnuplot_text(title), gnuplot_text(x), gnuplot_text(y));
}

std::string direction_part(const std::string& column, std::size_t i, const char* direction) {
  return fmt::format(
      "'../bifurcation.csv' using (strcol('direction') eq '{0}' ? column('value') : NaN)"
      ":(column({1})) title '{0}' with points lc rgb '{2}' pt 7 ps 0.25",
      direction, gnuplot_text(column), map_colours[i]);
}

std::string axis_text(const StudyAxis& axis) {
  return axis.unit.empty() ? axis_label(axis.name) : fmt::format("{} [{}]", axis.name, axis.unit);
}

std::string attractor_title(const Basins& map, std::size_t a) {
  const Attractor& found = map.attractors[a];
  const double share =
      100.0 * static_cast<double>(found.starts) / static_cast<double>(map.attractor.size());
  return found.period > 0 ? fmt::format("{}: period {}, {:.1f} %", a + 1, found.period, share)
                          : fmt::format("{}: no period, {:.1f} %", a + 1, share);
}

const char* colour_of(std::size_t attractor) { return map_colours[attractor % map_colours.size()]; }

/// Between the values of an axis, on average.
double spacing(const StudyAxis& axis) {
  if (axis.values.size() < 2) return 1.0;
  const auto [low, high] = std::ranges::minmax(axis.values);
  return (high - low) / static_cast<double>(axis.values.size() - 1);
}

/// Half a cell beyond the outermost starts.
std::string cell_range(const char* name, const StudyAxis& axis) {
  const auto [low, high] = std::ranges::minmax(axis.values);
  return fmt::format("  set {} [{:.10g}:{:.10g}]\n", name, low - 0.5 * spacing(axis),
                     high + 0.5 * spacing(axis));
}

}  // namespace

Figure poincare_figure(const std::string& title, const std::string& x, const std::string& y) {
  return {.name = "poincare",
          .title = title,
          .width = 900,
          .height = 760,
          .body = labels(title, axis_label(x), axis_label(y)) +
                  fmt::format("  plot '../poincare.csv' using (column({})):(column({})) notitle "
                              "with points lc rgb '{}' pt 7 ps 0.4",
                              gnuplot_text(x), gnuplot_text(y), map_colours[0])};
}

Figure bifurcation_figure(const std::string& title, const std::string& label,
                          const std::string& column, bool forward, bool backward) {
  std::vector<std::string> parts;
  if (forward) parts.push_back(direction_part(column, 0, "forward"));
  if (backward) parts.push_back(direction_part(column, 1, "backward"));
  return {.name = "bifurcation",
          .title = title,
          .width = 1200,
          .height = 760,
          .body = labels(title, label, axis_label(column)) +
                  (parts.size() == 1 ? "  unset key\n" : "") + plot_of(parts)};
}

Figure basins_figure(const std::string& title, const Basins& map) {
  const StudyPoints& grid = map.study.points;
  const auto part = [&](int attractor, const std::string& name, const char* colour) {
    return fmt::format(
        "'../basins.csv' using (column('attractor') == {} ? column({}) : NaN):(column({}))"
        ":({:.10g}):({:.10g}) title {} with boxxyerror fs solid 1 noborder lc rgb '{}'",
        attractor, gnuplot_text(grid.axes()[0].name), gnuplot_text(grid.axes()[1].name),
        0.5 * spacing(grid.axes()[0]), 0.5 * spacing(grid.axes()[1]), gnuplot_text(name), colour);
  };
  std::vector<std::string> parts;
  for (std::size_t a = 0; a < map.attractors.size(); ++a)
    parts.push_back(part(static_cast<int>(a) + 1, attractor_title(map, a), colour_of(a)));
  if (std::ranges::count(map.attractor, static_cast<int>(basin_unbounded)) > 0)
    parts.push_back(part(0, "unbounded", colour_of_unbounded));
  if (parts.empty()) parts.push_back("NaN notitle");
  return {.name = "basins",
          .title = title,
          .width = 1100,
          .height = 800,
          .body = labels(title, axis_text(grid.axes()[0]), axis_text(grid.axes()[1])) +
                  "  set key noenhanced\n" + cell_range("xrange", grid.axes()[0]) +
                  cell_range("yrange", grid.axes()[1]) + plot_of(parts)};
}

}  // namespace yoke::cases
