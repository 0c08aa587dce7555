// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Figures, drawn by gnuplot. Each is a script that stays beside its pictures and its data, so that
// a user can change it and run it again: cd DIR/plots && gnuplot figure11.gp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace yoke::cases {

/// What a figure is drawn on. Figures are laid out in pixels of a screen, on which text has 11 points;
/// in print all is scaled so that text has 8 points.
struct Sheet {
  const char* name = "";     // "single": the files are called NAME-single.png; "" on the screen
  double millimetres = 0.0;  // width in print
  int width = 1200;          // [pixels] to lay figures out in

  bool print() const { return millimetres > 0.0; }
  /// Too narrow for a legend beside a plot.
  bool narrow() const { return width < 600; }
};

/// 84 and 174 mm are the columns of most journals; 11 points on the screen are 14.67 pixels, and 8 in
/// print 2.82 mm.
inline constexpr Sheet on_screen{}, single_column{"single", 84.0, 437},
    double_column{"double", 174.0, 904};

/// One picture. The body is what comes between `set output` and the end of a gnuplot script; it
/// reads files relative to the folder of the plots and may not contain here-documents.
struct Figure {
  std::string name;   // "figure11" becomes figure11.gp, .png, .svg
  std::string title;  // first line of the script
  int width = 1200;   // [pixels]
  int height = 700;
  std::string body;
  bool animated = false;  // one .gif instead
  Sheet sheet = on_screen;
};

/// Writes the scripts into `folder` and runs gnuplot on each, `jobs` at a time. On the screen a figure
/// is PNG and SVG, in print also PDF; with `films` animations are MP4 and WebM besides GIF, if ffmpeg is
/// installed. Returns one or two sentences for the user: where the pictures are, or why there are none
/// and what to do.
std::string draw_figures(const std::vector<Figure>& figures, const std::filesystem::path& folder,
                         int jobs, bool films = false);

}  // namespace yoke::cases
