// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the standard figures are made of, and their kinds: of the motion, of the contacts, and the
// portraits of a case. Each kind writes the data of a run, notes in DrawnRun what is drawn, and makes
// its figures of that.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/cases/jobs/standard_figures.hpp>

namespace yoke::cases {

// ---- of gnuplot

/// A name as text between double quotes.
std::string gnuplot_text(std::string_view name);
/// Colour and dashes of line i of a plot.
std::string line_style(std::size_t i);
/// Of points in the same colour.
std::string line_colour(std::size_t i);
/// The command that plots these.
std::string plot_of(const std::vector<std::string>& parts);
/// "contact.csv" of a run that is not the only one is "contact-LAW.csv".
std::string data_file(const char* stem, const DrawnRun& run);

// ---- panels

/// Panels one above the other over the time, each with a label and lines.
struct Panel {
  std::string label;  // "[m]"
  std::vector<std::string> lines;
  std::vector<std::string> names{};  // of the lines, if other panels may have the same
  double top = 0.0;                  // of an axis that starts at 0; 0: chosen by the lines
};

/// One line of a panel: a column of a file, by its name.
std::string panel_line(const std::string& file, const std::string& column, const std::string& title,
                       std::size_t i);

/// `outside`: lines are named beside or below the panels, once if they are the same in all; else each
/// panel names its own inside.
Figure panel_figure(const Sheet& sheet, const std::string& name, const std::string& title,
                    const std::vector<Panel>& all, bool outside = true);

/// A title over a figure; print has it in the caption.
std::string heading(const Sheet& sheet, const std::string& title);
std::string multiplot_title(const Sheet& sheet, const std::string& title);

/// [pixels] Margins beside the panels in print.
constexpr double print_left = 92.0, print_right = 18.0;

/// Where lines are named: beside the panels, below them in rows, or by each panel inside.
struct Legend {
  enum class Place { beside, below, inside } place = Place::inside;
  double width = 0.0;       // [pixels] of the longest name
  std::size_t columns = 1;  // below

  Legend(const Sheet& sheet, const std::vector<Panel>& all, bool outside);
  bool below() const { return place == Place::below; }
  /// [pixels] Rows for the names of a panel.
  double height(const Panel& panel) const;
};

constexpr std::size_t most_lines = 8;  // of one panel: more are not told apart

/// At most `most_lines` of the names, those of the largest values, in their order.
std::vector<std::string> largest_of(const std::vector<std::string>& names,
                                    const std::function<double(const std::string& name)>& value);

// ---- the kinds

void write_motion_data(const LawRun& run, const std::filesystem::path& folder,
                       const std::vector<std::string>& paths, DrawnRun& drawn);
/// Of the first run.
std::vector<Figure> motion_figures(const std::string& case_name, const DrawnRun& run,
                                   const Sheet& sheet);

void write_contact_data(const LawRun& run, const std::filesystem::path& folder, DrawnRun& drawn);
/// None without contacts.
std::vector<Figure> contact_figures(const std::string& case_name, const std::vector<DrawnRun>& runs,
                                    const Sheet& sheet);

void write_portrait_data(const LawRun& run, const std::filesystem::path& folder, DrawnRun& drawn);
std::vector<Figure> portrait_figures(const std::string& case_name,
                                     const std::vector<DrawnRun>& runs, const Sheet& sheet);

}  // namespace yoke::cases
