// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/figure_parts.hpp>

#include <fmt/ranges.h>

#include <array>

namespace yoke::cases {

namespace {

// Colours that differ for colour-blind readers too (Okabe and Ito).
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                "#e69f00", "#56b4e9", "#000000", "#a0a000"};

}  // namespace

std::string gnuplot_text(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

std::string line_colour(std::size_t i) { return colours[i % colours.size()]; }

std::string line_style(std::size_t i) {
  return fmt::format("with lines lc rgb '{}' lw 1.3 dt {}", line_colour(i), i / colours.size() + 1);
}

std::string plot_of(const std::vector<std::string>& parts) {
  return fmt::format("  plot {}\n", fmt::join(parts, ", \\\n       "));
}

std::string data_file(const char* stem, const DrawnRun& run) {
  return run.folder.empty() ? fmt::format("{}.csv", stem)
                            : fmt::format("{}-{}.csv", stem, run.folder);
}

std::vector<std::string> largest_of(const std::vector<std::string>& names,
                                    const std::function<double(const std::string& name)>& value) {
  if (names.size() <= most_lines) return names;
  std::vector<double> values;
  for (const std::string& name : names) values.push_back(value(name));
  std::vector<double> sorted = values;
  std::ranges::sort(sorted, std::greater<>());
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < names.size() && kept.size() < most_lines; ++i)
    if (values[i] >= sorted[most_lines - 1]) kept.push_back(names[i]);
  return kept;
}

namespace {

constexpr const char* time_axis = "  set xlabel 'time [s]'\n";

constexpr double bottom_margin = 70.0, top_margin = 50.0;  // [pixels]

double panel_height(std::size_t panels) {
  return top_margin + bottom_margin + (panels > 3 ? 170.0 : 270.0) * static_cast<double>(panels);
}

std::string panels(const std::string& title, const std::vector<Panel>& all, bool legend) {
  std::string body = fmt::format(
      "  set multiplot layout {},1 margins 0.11,{},{:.4g},{:.4g} spacing 0,0.02 title {} noenhanced\n"
      "  set key noenhanced; set xtics format ''; unset xlabel; set autoscale xfix\n",
      all.size(), legend ? 0.8 : 0.97, bottom_margin / panel_height(all.size()),
      1.0 - top_margin / panel_height(all.size()), gnuplot_text(title));
  if (!legend) body += "  set key inside top right opaque\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i + 1 == all.size()) body += fmt::format("  set xtics format '%g'\n{}", time_axis);
    if (legend && i > 0 && all[i].names == all[i - 1].names) body += "  unset key\n";
    body += fmt::format("  set ylabel {} noenhanced\n", gnuplot_text(all[i].label)) +
            (all[i].top > 0.0 ? fmt::format("  set yrange [0:{:.3g}]\n", all[i].top) : "") +
            plot_of(all[i].lines) + (all[i].top > 0.0 ? "  set autoscale y\n" : "");
  }
  return body + "  unset multiplot";
}

}  // namespace

std::string panel_line(const std::string& file, const std::string& column, const std::string& title,
                       std::size_t i) {
  return fmt::format("{} using \"t_s\":{} title {} {}", gnuplot_text(file), gnuplot_text(column),
                     gnuplot_text(title), line_style(i));
}

Figure panel_figure(const std::string& name, const std::string& title,
                    const std::vector<Panel>& all, bool legend) {
  return {.name = name,
          .title = title,
          .height = static_cast<int>(panel_height(all.size())),
          .body = panels(title, all, legend)};
}

}  // namespace yoke::cases
