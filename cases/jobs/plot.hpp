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

/// One picture. The body is what comes between `set output` and the end of a gnuplot script; it
/// reads files relative to the folder of the plots and may not contain here-documents.
struct Figure {
  std::string name;   // "figure11" becomes figure11.gp, .png, .svg
  std::string title;  // first line of the script
  int width = 1200;   // [pixels]
  int height = 700;
  std::string body;
  bool animated = false;  // one .gif instead
};

/// For the screen, or for print as well: PDF 174 mm wide, the width of a page of two columns, and
/// animations as MP4 too where ffmpeg is installed.
enum class Figures { screen, paper };

/// Writes the scripts into `folder` and runs gnuplot on each, `jobs` at a time. Returns one or two
/// sentences for the user: where the pictures are, or why there are none and what to do.
std::string draw_figures(const std::vector<Figure>& figures, const std::filesystem::path& folder,
                         int jobs, Figures kind = Figures::screen);

}  // namespace yoke::cases
