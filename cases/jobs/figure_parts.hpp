// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the standard figures are made of, and their kinds: of the motion, of the contacts, and the
// portraits of a case. Each kind writes the data of a run, notes in DrawnRun what is drawn, and makes
// its figures of that.
#pragma once

#include <algorithm>
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

/// `legend`: lines are named beside the panels, once if they are the same in all; else each panel
/// names its own inside.
Figure panel_figure(const std::string& name, const std::string& title,
                    const std::vector<Panel>& all, bool legend = true);

constexpr std::size_t most_lines = 8;  // of one panel: more are not told apart

/// At most `most_lines` of the names, those of the largest values, in their order.
std::vector<std::string> largest_of(const std::vector<std::string>& names,
                                    const std::function<double(const std::string& name)>& value);

// ---- the kinds

void write_motion_data(const LawRun& run, const std::filesystem::path& folder,
                       const std::vector<std::string>& paths, DrawnRun& drawn);
/// Of the first run.
std::vector<Figure> motion_figures(const std::string& case_name, const DrawnRun& run);

void write_contact_data(const LawRun& run, const std::filesystem::path& folder, DrawnRun& drawn);
/// None without contacts.
std::vector<Figure> contact_figures(const std::string& case_name,
                                    const std::vector<DrawnRun>& runs);

void write_portrait_data(const LawRun& run, const std::filesystem::path& folder, DrawnRun& drawn);
std::vector<Figure> portrait_figures(const std::string& case_name,
                                     const std::vector<DrawnRun>& runs);

}  // namespace yoke::cases
