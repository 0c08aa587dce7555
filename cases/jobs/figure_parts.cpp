// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/figure_parts.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

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

/// [pixels] A name of this many characters with its sample of line.
double key_width(std::size_t characters) { return 50.0 + 8.0 * static_cast<double>(characters); }

constexpr double key_line = 19.0;  // [pixels]

}  // namespace

std::string heading(const Sheet& sheet, const std::string& title) {
  return sheet.print() ? "" : fmt::format("  set title {} noenhanced\n", gnuplot_text(title));
}

std::string multiplot_title(const Sheet& sheet, const std::string& title) {
  return sheet.print() ? "" : fmt::format(" title {} noenhanced", gnuplot_text(title));
}

Legend::Legend(const Sheet& sheet, const std::vector<Panel>& all, bool outside) {
  if (!outside) return;
  std::size_t longest = 0;
  for (const Panel& panel : all)
    for (const std::string& name : panel.names) longest = std::max(longest, name.size());
  width = key_width(longest);
  const bool beside = !sheet.print() || (!sheet.narrow() && width <= 0.3 * sheet.width);
  place = beside ? Place::beside : Place::below;
  // gnuplot makes no more columns than fit under the plot.
  const double room = sheet.width - print_left - print_right;
  columns = static_cast<std::size_t>(std::max(1.0, std::floor(room / width)));
}

double Legend::height(const Panel& panel) const {
  const std::size_t rows = (panel.names.size() + columns - 1) / columns;
  return below() ? key_line * static_cast<double>(rows) : 0.0;
}

namespace {

/// A panel whose lines have the names of the one above needs none.
bool names_again(const std::vector<Panel>& all, std::size_t i) {
  return i > 0 && all[i].names == all[i - 1].names;
}

/// Margins around all panels and what they enclose [pixels].
struct PanelLayout {
  double left, right, top, bottom, height;

  PanelLayout(const Sheet& sheet, const std::vector<Panel>& all, const Legend& legend)
      : left(sheet.print() ? print_left : 132.0),
        right(legend.place == Legend::Place::beside
                  ? std::max(legend.width + 12.0, 0.2 * sheet.width)
              : sheet.print() ? print_right
                              : 0.03 * sheet.width),
        top(sheet.print() ? 14.0 : 50.0),
        bottom(legend.below()  ? 66.0
               : sheet.print() ? 58.0
                               : 70.0) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!names_again(all, i)) bottom += legend.height(all[i]);
    double panel = all.size() > 3 ? 170.0 : 270.0;
    if (sheet.print()) {
      panel = all.size() > 6 ? 100.0 : all.size() > 3 ? 140.0 : 180.0;
      if (legend.place == Legend::Place::inside)  // room for all names
        panel = std::max(panel, 60.0 + key_line * static_cast<double>(all.front().lines.size()));
    }
    height = top + bottom + panel * static_cast<double>(all.size());
  }
};

/// The named lines of panel `i`, in its place.
std::string panel_key(const std::vector<Panel>& all, std::size_t i, const Legend& legend,
                      double height) {
  if (legend.place == Legend::Place::inside) return "";
  if (names_again(all, i)) return "  unset key\n";
  if (!legend.below()) return i > 0 ? "  set key on\n" : "";
  double above_bottom = 2.0;
  for (std::size_t k = i + 1; k < all.size(); ++k)
    if (!names_again(all, k)) above_bottom += legend.height(all[k]);
  return fmt::format("  set key on at screen 0.5,{:.4g} bottom center horizontal maxcols {}\n",
                     above_bottom / height, legend.columns);
}

}  // namespace

std::string panel_line(const std::string& file, const std::string& column, const std::string& title,
                       std::size_t i) {
  return fmt::format("{} using \"t_s\":{} title {} {}", gnuplot_text(file), gnuplot_text(column),
                     gnuplot_text(title), line_style(i));
}

Figure panel_figure(const Sheet& sheet, const std::string& name, const std::string& title,
                    const std::vector<Panel>& all, bool outside) {
  const Legend legend(sheet, all, outside);
  const PanelLayout page(sheet, all, legend);
  const auto share = [](double part, double whole) { return part / whole; };
  std::string body = fmt::format(
      "  set multiplot layout {},1 margins {:.4g},{:.4g},{:.4g},{:.4g} spacing 0,{:.3g}{}\n"
      "  set key noenhanced; set xtics format ''; unset xlabel; set autoscale xfix\n",
      all.size(), share(page.left, sheet.width), 1.0 - share(page.right, sheet.width),
      share(page.bottom, page.height), 1.0 - share(page.top, page.height),
      sheet.print() ? 16.0 / page.height : 0.02, multiplot_title(sheet, title));
  if (!outside) body += "  set key inside top right opaque\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i + 1 == all.size()) body += fmt::format("  set xtics format '%g'\n{}", time_axis);
    body += panel_key(all, i, legend, page.height) +
            fmt::format("  set ylabel {} noenhanced\n", gnuplot_text(all[i].label)) +
            (all[i].top > 0.0 ? fmt::format("  set yrange [0:{:.3g}]\n", all[i].top) : "") +
            plot_of(all[i].lines) + (all[i].top > 0.0 ? "  set autoscale y\n" : "");
  }
  return {.name = name,
          .title = title,
          .width = sheet.width,
          .height = static_cast<int>(page.height),
          .body = body + "  unset multiplot",
          .sheet = sheet};
}

}  // namespace yoke::cases
