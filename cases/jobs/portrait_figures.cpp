// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/figure_parts.hpp>

#include <fmt/format.h>

namespace yoke::cases {

namespace {

/// "orbit-1.csv": the points of each line of a portrait.
std::string portrait_file(const Portrait& portrait, std::size_t line, const DrawnRun& run) {
  return data_file(fmt::format("{}-{}", portrait.name, line + 1).c_str(), run);
}

/// A portrait of each run, side by side with the same axes.
Figure portrait_figure(const Sheet& sheet, const std::string& case_name,
                       const std::vector<DrawnRun>& runs, std::size_t which) {
  const Portrait& portrait = runs.front().portraits[which];
  const std::string title = case_name + ": " + portrait.title;
  const std::size_t most = sheet.narrow() ? (runs.size() > 3 ? 2 : 1) : 3,
                    columns = std::min(runs.size(), most),
                    rows = (runs.size() + columns - 1) / columns;
  std::string reach = "  xl = yl = 1e300; xh = yh = -1e300\n", plots;
  for (const DrawnRun& run : runs) {
    if (which >= run.portraits.size()) continue;
    Texts lines;
    const std::vector<PortraitLine>& all = run.portraits[which].lines;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string file = gnuplot_text(portrait_file(portrait, i, run));
      reach += fmt::format(
          "  stats {} using 1:2 nooutput\n"
          "  xl = STATS_min_x < xl ? STATS_min_x : xl; xh = STATS_max_x > xh ? STATS_max_x : xh\n"
          "  yl = STATS_min_y < yl ? STATS_min_y : yl; yh = STATS_max_y > yh ? STATS_max_y : yh\n",
          file);
      lines.push_back(fmt::format(
          "{} using 1:2 title {} {}", file, gnuplot_text(all[i].name),
          all[i].dots ? fmt::format("with points lc rgb '{}' pt 7 ps 0.6", line_colour(i))
                      : line_style(i)));
    }
    plots += fmt::format("  set title {} noenhanced\n{}{}", gnuplot_text(run.law),
                         all.size() == 1 ? "  unset key\n" : "", plot_of(lines));
  }
  const int across = static_cast<int>(columns), down = static_cast<int>(rows);
  int width = across == 1 ? 800 : 80 + 520 * across, height = across == 1 ? 760 : 90 + 540 * down;
  if (sheet.print()) {
    width = sheet.width;
    height = down * (across == 1 && !sheet.narrow() ? width * 7 / 10 : width / across + 20);
  }
  return {
      .name = portrait.name,
      .title = title,
      .width = width,
      .height = height,
      .body = reach + fmt::format("  dx = 0.05*(xh - xl) + 1e-12*abs(xh); dy = 0.05*(yh - yl) + "
                                  "1e-12*abs(yh)\n"
                                  "  set xrange [xl - dx:xh + dx]; set yrange [yl - dy:yh + dy]\n"
                                  "  set multiplot layout {},{}{}\n"
                                  "  set key noenhanced below center horizontal\n  set bmargin 6\n"
                                  "  set xlabel {} noenhanced; set ylabel {} noenhanced\n{}{}"
                                  "  unset multiplot",
                                  rows, columns, multiplot_title(sheet, title),
                                  gnuplot_text(portrait.x_label), gnuplot_text(portrait.y_label),
                                  portrait.equal_scales ? "  set size ratio -1\n" : "", plots),
      .sheet = sheet};
}

}  // namespace

void write_portrait_data(const LawRun& run, const std::filesystem::path& folder, DrawnRun& drawn) {
  drawn.portraits = run.portraits;
  for (Portrait& portrait : drawn.portraits)
    for (std::size_t i = 0; i < portrait.lines.size(); ++i) {
      std::string text = "x,y";
      for (const Vec2& p : portrait.lines[i].points)
        fmt::format_to(std::back_inserter(text), "\n{:.7g},{:.7g}", p.x(), p.y());
      write_text(folder / portrait_file(portrait, i, drawn), text);
      portrait.lines[i].points.clear();
    }
}

std::vector<Figure> portrait_figures(const std::string& case_name,
                                     const std::vector<DrawnRun>& runs, const Sheet& sheet) {
  std::vector<Figure> figures;
  for (std::size_t i = 0; i < runs.front().portraits.size(); ++i)
    figures.push_back(portrait_figure(sheet, case_name, runs, i));
  return figures;
}

}  // namespace yoke::cases
