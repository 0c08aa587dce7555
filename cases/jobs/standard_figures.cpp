// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/standard_figures.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace yoke::cases {

namespace {

using Path = std::filesystem::path;
using Texts = std::vector<std::string>;

constexpr std::size_t most_lines = 8;      // of one panel: more are not told apart
constexpr std::size_t most_rows = 20001;   // of the data of a contact
constexpr std::size_t motion_rows = 4001;  // of all other data

// Colours that differ for colour-blind readers too (Okabe and Ito).
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                "#e69f00", "#56b4e9", "#000000", "#a0a000"};

/// A name as text between double quotes of gnuplot.
std::string gnuplot_text(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

std::string style(std::size_t i) {
  return fmt::format("with lines lc rgb '{}' lw 1.3 dt {}", colours[i % colours.size()],
                     i / colours.size() + 1);
}

std::string plot(const Texts& parts) {
  return fmt::format("  plot {}\n", fmt::join(parts, ", \\\n       "));
}

/// "contact.csv" of a run that is not the only one is "contact-LAW.csv".
std::string data_file(const char* stem, const DrawnRun& run) {
  return run.folder.empty() ? fmt::format("{}.csv", stem)
                            : fmt::format("{}-{}.csv", stem, run.folder);
}

// ---- what is drawn of a run

double range_of(const Table& samples, const std::string& column) {
  const Eigen::VectorXd values = samples[column];
  return values.maxCoeff() - values.minCoeff();
}

/// The element names of columns that end with `suffix`, in the order of the table.
Texts owners(const Table& samples, std::string_view suffix) {
  Texts names;
  for (const std::string& column : samples.names())
    if (column.ends_with(suffix)) names.push_back(column.substr(0, column.size() - suffix.size()));
  return names;
}

/// At most `most_lines` of the names, those of the largest values, in their order.
template <class Value>
Texts largest(const Texts& names, const Value& value) {
  if (names.size() <= most_lines) return names;
  std::vector<double> values;
  for (const std::string& name : names) values.push_back(value(name));
  std::vector<double> sorted = values;
  std::ranges::sort(sorted, std::greater<>());
  Texts kept;
  for (std::size_t i = 0; i < names.size() && kept.size() < most_lines; ++i)
    if (values[i] >= sorted[most_lines - 1]) kept.push_back(names[i]);
  return kept;
}

Texts bodies_of(const Table& samples) {
  return largest(owners(samples, ".alpha_rad_per_s2"), [&](const std::string& body) {
    return range_of(samples, body + ".x_m") + range_of(samples, body + ".y_m");
  });
}

double peak_of(const Table& samples, const std::string& joint, const char* what) {
  return samples[joint + what].cwiseAbs().maxCoeff();
}

/// Joints that carry a force or a moment, above the rounding of the largest force at the farthest
/// body.
Texts joints_of(const Table& samples, bool moment) {
  Texts names;
  double force = 0.0, reach = 0.0;
  for (const std::string& column : samples.names()) {
    const auto largest_of = [&](double most) {
      return std::max(most, samples[column].cwiseAbs().maxCoeff());
    };
    if (column.ends_with(".x_m") || column.ends_with(".y_m")) reach = largest_of(reach);
    if (column.ends_with(".fx_N") || column.ends_with(".fy_N")) force = largest_of(force);
  }
  const double rounding = 1e-12 * force * (moment ? reach : 1.0);
  for (const std::string& joint : owners(samples, ".moment_N_m")) {
    if (!samples.has(joint + ".fx_N")) continue;
    const double peak =
        moment ? peak_of(samples, joint, ".moment_N_m")
               : std::max(peak_of(samples, joint, ".fx_N"), peak_of(samples, joint, ".fy_N"));
    if (peak > rounding) names.push_back(joint);
  }
  return largest(names, [&](const std::string& joint) {
    return moment ? peak_of(samples, joint, ".moment_N_m")
                  : std::hypot(peak_of(samples, joint, ".fx_N"), peak_of(samples, joint, ".fy_N"));
  });
}

/// Where equations are dependent for an instant, reactions that are not unique grow without bound
/// close by and would hide all others: the axis then ends at twice what 99 % of the rows stay below.
double force_top_of(const LawRun& run, const Texts& joints) {
  if (run.summary.singular_positions.empty() || joints.empty()) return 0.0;
  std::vector<double> most(run.samples.rows(), 0.0);  // of all joints
  for (const std::string& joint : joints) {
    const auto fx = run.samples[joint + ".fx_N"], fy = run.samples[joint + ".fy_N"];
    for (std::size_t i = 0; i < most.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      most[i] = std::max(most[i], std::hypot(fx[row], fy[row]));
    }
  }
  std::ranges::sort(most);
  const double usual = most[(most.size() - 1) * 99 / 100];
  return most.back() > 4.0 * usual ? 2.0 * usual : 0.0;
}

constexpr std::array body_quantities = {"x_m",        "y_m",        "angle_rad",
                                        "vx_m_per_s", "vy_m_per_s", "omega_rad_per_s"};

/// Quantities that no body changes beyond rounding of the largest one; not drawn.
Texts still_quantities(const Table& samples, const Texts& bodies) {
  Texts names;
  for (const char* quantity : body_quantities) {
    const bool moves = std::ranges::any_of(bodies, [&](const std::string& body) {
      const Eigen::VectorXd values = samples[body + "." + quantity];
      return values.maxCoeff() - values.minCoeff() > 1e-12 * values.cwiseAbs().maxCoeff();
    });
    if (!moves) names.emplace_back(quantity);
  }
  return names;
}

/// The terms of the energy ledger that are not zero throughout.
Texts energies_of(const Table& samples) {
  Texts names;
  for (const char* name : {"kinetic", "potential", "stored", "dissipated", "work"})
    if (samples[std::string(name) + "_J"].cwiseAbs().maxCoeff() > 0.0) names.emplace_back(name);
  return names;
}

/// The columns of the table that the figures use, with the magnitude of each joint's force.
void write_motion(const Table& samples, const DrawnRun& drawn, const Path& path) {
  std::vector<std::size_t> columns{samples.index("t_s")};
  std::vector<std::pair<std::size_t, std::size_t>> forces;
  std::string text = "t_s";
  const auto add = [&](const std::string& name) {
    columns.push_back(samples.index(name));
    text += "," + name;
  };
  for (const std::string& body : drawn.bodies)
    for (const char* quantity : body_quantities) add(body + "." + quantity);
  for (const std::string& joint : drawn.moments) add(joint + ".moment_N_m");
  for (const std::string& energy : drawn.energies) add(energy + "_J");
  add("balance_J");
  for (const std::string& joint : drawn.forces) {
    forces.emplace_back(samples.index(joint + ".fx_N"), samples.index(joint + ".fy_N"));
    text += "," + joint + ".force_N";
  }
  const std::size_t every = std::max<std::size_t>(1, (samples.rows() - 1) / (motion_rows - 1));
  for (std::size_t i = 0; i < samples.rows(); i += every) {
    char separator = '\n';
    const auto append = [&](double value) {
      fmt::format_to(std::back_inserter(text), "{}{:.7g}", separator, value);
      separator = ',';
    };
    for (const std::size_t j : columns) append(samples.value(i, j));
    for (const auto& [x, y] : forces) append(std::hypot(samples.value(i, x), samples.value(i, y)));
  }
  write_text(path, text);
}

/// x and y of the bodies whose path is drawn. Returns what they fill, with a margin.
PathBox write_paths(const Table& samples, const Texts& paths, const Path& path) {
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  std::string text = "t_s";
  std::vector<std::size_t> columns{samples.index("t_s")};
  for (const std::string& body : paths)
    for (const int axis : {0, 1}) {
      const std::string column = body + (axis == 0 ? ".x_m" : ".y_m");
      const Eigen::VectorXd values = samples[column];
      low[axis] = std::min(low[axis], values.minCoeff());
      high[axis] = std::max(high[axis], values.maxCoeff());
      columns.push_back(samples.index(column));
      text += "," + column;
    }
  const std::size_t every = std::max<std::size_t>(1, (samples.rows() - 1) / (motion_rows - 1));
  for (std::size_t i = 0; i < samples.rows(); i += every)
    for (std::size_t j = 0; j < columns.size(); ++j)
      fmt::format_to(std::back_inserter(text), "{}{:.7g}", j == 0 ? '\n' : ',',
                     samples.value(i, columns[j]));
  write_text(path, text);
  constexpr double margin = 1.1, flattest = 0.25, highest = 1.2;
  double width = margin * (high[0] - low[0]), height = margin * (high[1] - low[1]);
  width = std::max({width, height / highest, 1e-12});
  height = std::max(height, flattest * width);
  const double x = 0.5 * (low[0] + high[0]), y = 0.5 * (low[1] + high[1]);
  return {x - 0.5 * width, x + 0.5 * width, y - 0.5 * height, y + 0.5 * height};
}

/// Those of the largest forces, as many as are told apart; without those that never touched, if any
/// did.
std::vector<ContactRecord> drawn_contacts(const LawRun& run) {
  std::vector<ContactRecord> kept = run.contacts;
  if (run.peak_force() > 0.0)
    std::erase_if(kept, [](const ContactRecord& c) { return c.peak_force == 0.0; });
  Texts names;
  for (const ContactRecord& c : kept) names.push_back(c.element);
  names = largest(names, [&](const std::string& name) {
    return std::ranges::find(kept, name, &ContactRecord::element)->peak_force;
  });
  std::erase_if(kept, [&](const ContactRecord& c) {
    return std::ranges::find(names, c.element) == names.end();
  });
  return kept;
}

/// Force and penetration of every contact that is drawn.
void write_contacts(const LawRun& run, const std::vector<ContactRecord>& drawn, const Path& path) {
  const Table& samples = run.samples;
  std::string text = "t_s";
  std::vector<std::pair<std::size_t, std::size_t>> columns;
  for (const ContactRecord& c : drawn) {
    columns.emplace_back(samples.index(c.element + ".normal_force_N"),
                         samples.index(c.element + ".penetration_m"));
    text += fmt::format(",{0}.normal_force_N,{0}.penetration_um", c.element);
  }
  const std::size_t time = samples.index("t_s");
  const std::size_t every = std::max<std::size_t>(1, (samples.rows() - 1) / (most_rows - 1));
  // The largest of the rows that one stands for: peaks of short impacts stay.
  const auto largest_of = [&](std::size_t first, std::size_t column) {
    double most = samples.value(first, column);
    for (std::size_t i = first + 1; i < std::min(first + every, samples.rows()); ++i)
      most = std::max(most, samples.value(i, column));
    return most;
  };
  for (std::size_t i = 0; i < samples.rows(); i += every) {
    fmt::format_to(std::back_inserter(text), "\n{:.9g}", samples.value(i, time));
    for (const auto& [force, penetration] : columns)
      fmt::format_to(std::back_inserter(text), ",{:.7g},{:.7g}", largest_of(i, force),
                     1e6 * std::max(0.0, largest_of(i, penetration)));
  }
  write_text(path, text);
}

/// The contact in which the largest force was recorded, from onset to release.
void write_hardest(const LawRun& run, const Path& path) {
  const Table& samples = run.samples;
  std::string text = "t_s,penetration_um,force_N";
  const auto hardest = std::ranges::max_element(run.contacts, {}, &ContactRecord::peak_force);
  const auto force = samples[hardest->element + ".normal_force_N"];
  const auto penetration = samples[hardest->element + ".penetration_m"];
  const auto t = samples["t_s"];
  Eigen::Index peak = 0;
  force.maxCoeff(&peak);
  for (const ContactSpell& spell : contact_spells(run, t[0], t[t.size() - 1], hardest->element)) {
    const auto first = static_cast<Eigen::Index>(spell.first);
    const auto last = static_cast<Eigen::Index>(spell.last);
    if (peak < first || peak >= last) continue;
    // A contact that lasts is thinned; the loop starts and ends at nothing.
    const Eigen::Index every = std::max<Eigen::Index>(1, (last - first) / 4000);
    text += fmt::format("\n{:.9g},0,0", t[first]);
    for (Eigen::Index i = first; i < last; i += every)
      text += fmt::format("\n{:.9g},{:.7g},{:.7g}", t[i], 1e6 * penetration[i], force[i]);
    text += fmt::format("\n{:.9g},0,0", t[last - 1]);
  }
  write_text(path, text);
}

/// "orbit-1.csv": the points of each line of a portrait.
std::string portrait_file(const Portrait& portrait, std::size_t line, const DrawnRun& run) {
  return data_file(fmt::format("{}-{}", portrait.name, line + 1).c_str(), run);
}

void write_portraits(const LawRun& run, DrawnRun& drawn, const Path& folder) {
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

// ---- figures

constexpr const char* time_axis = "  set xlabel 'time [s]'\n";

/// A title over a figure; print has it in the caption.
std::string heading(const Sheet& sheet, const std::string& title) {
  return sheet.print() ? "" : fmt::format("  set title {} noenhanced\n", gnuplot_text(title));
}

std::string multiplot_title(const Sheet& sheet, const std::string& title) {
  return sheet.print() ? "" : fmt::format(" title {} noenhanced", gnuplot_text(title));
}

/// Panels one above the other over the time, each with a label and lines.
struct Panel {
  std::string label;  // "[m]"
  Texts lines;
  Texts names{};     // of the lines, if other panels may have the same
  double top = 0.0;  // of an axis that starts at 0; 0: chosen by the lines
};

/// [pixels] A name of this many characters with its sample of line.
double key_width(std::size_t characters) { return 50.0 + 8.0 * static_cast<double>(characters); }

constexpr double key_line = 19.0;  // [pixels]

/// [pixels] Margins beside the panels in print.
constexpr double print_left = 92.0, print_right = 18.0;

/// Where lines are named: beside the panels, below them in rows, or by each panel inside.
struct Legend {
  enum class Place { beside, below, inside } place = Place::inside;
  double width = 0.0;       // [pixels] of the longest name
  std::size_t columns = 1;  // below

  Legend(const Sheet& sheet, const std::vector<Panel>& all, bool outside) {
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
  bool below() const { return place == Place::below; }
  /// [pixels] Rows for the names of a panel.
  double height(const Panel& panel) const {
    const std::size_t rows = (panel.names.size() + columns - 1) / columns;
    return below() ? key_line * static_cast<double>(rows) : 0.0;
  }
};

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

/// `outside`: lines are named beside or below the panels, once if they are the same in all; else each
/// panel names its own inside.
Figure panel_figure(const Sheet& sheet, const std::string& name, const std::string& title,
                    const std::vector<Panel>& all, bool outside = true) {
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
            plot(all[i].lines) + (all[i].top > 0.0 ? "  set autoscale y\n" : "");
  }
  return {.name = name,
          .title = title,
          .width = sheet.width,
          .height = static_cast<int>(page.height),
          .body = body + "  unset multiplot",
          .sheet = sheet};
}

/// One line of a panel: a column of a file, by its name.
std::string line(const std::string& file, const std::string& column, const std::string& title,
                 std::size_t i) {
  return fmt::format("{} using \"t_s\":{} title {} {}", gnuplot_text(file), gnuplot_text(column),
                     gnuplot_text(title), style(i));
}

Panel body_panel(const DrawnRun& run, const std::string& label, const char* quantity) {
  Panel panel{label, {}, run.bodies};
  for (std::size_t i = 0; i < run.bodies.size(); ++i)
    panel.lines.push_back(
        line(data_file("motion", run), run.bodies[i] + "." + quantity, run.bodies[i], i));
  return panel;
}

Figure energy_figure(const Sheet& sheet, const DrawnRun& run, const std::string& title) {
  const std::string file = data_file("motion", run);
  Panel terms{"energy [J]", {}}, balance{"balance [J]", {}, {"error of the balance"}};
  for (const std::string& energy : run.energies) {
    terms.names.push_back(energy == "stored" ? "stored in contacts" : energy);
    terms.lines.push_back(line(file, energy + "_J", terms.names.back(), terms.lines.size()));
  }
  balance.lines.push_back(line(file, "balance_J", balance.names.front(), terms.lines.size()));
  return panel_figure(sheet, "energy", title, {terms, balance});
}

/// A panel for each law, all with the same axis: bouncing curves on one axis hide each other.
Figure law_panels(const Sheet& sheet, const std::string& name, const std::string& title,
                  const std::string& label, const std::vector<DrawnRun>& runs, const char* column) {
  std::vector<Panel> all;
  for (const DrawnRun& run : runs) {
    Panel panel{label, {}};
    std::size_t i = 0;
    for (const ContactRecord& c : run.contacts) {
      const std::string text = runs.size() == 1           ? c.element
                               : run.contacts.size() == 1 ? run.law
                                                          : run.law + ": " + c.element;
      panel.lines.push_back(line(data_file("contact", run), c.element + column, text, i++));
    }
    all.push_back(panel);
  }
  Figure figure = panel_figure(sheet, name, title, all, false);
  // The largest value of all laws bounds every panel.
  std::string range = "  top = 0\n";
  for (const DrawnRun& run : runs)
    for (const ContactRecord& c : run.contacts)
      range +=
          fmt::format("  stats {} using {} nooutput; top = STATS_max > top ? STATS_max : top\n",
                      gnuplot_text(data_file("contact", run)), gnuplot_text(c.element + column));
  if (sheet.print()) range += "  if (top > 0) { set ytics round_step(top/4) }\n";
  // Room for the names above the peaks.
  const std::size_t names = runs.front().contacts.size();
  figure.body = range +
                fmt::format("  set yrange [0:top > 0 ? {:.2f}*top : 1]\n",
                            names > 1 ? 1.1 + 0.09 * static_cast<double>(names) : 1.05) +
                figure.body;
  return figure;
}

/// Paths of bodies, y over x, both on one scale; a ring where each starts.
Figure path_figure(const Sheet& sheet, const DrawnRun& run, const std::string& title) {
  const std::string file = data_file("path", run);
  Texts lines;
  for (std::size_t i = 0; i < run.paths.size(); ++i) {
    const std::string& body = run.paths[i];
    const std::string columns =
        fmt::format("{} using {}:{}", gnuplot_text(file), gnuplot_text(body + ".x_m"),
                    gnuplot_text(body + ".y_m"));
    lines.push_back(fmt::format("{} title {} {}", columns, gnuplot_text(body), style(i)));
    lines.push_back(fmt::format("{} every ::0::0 notitle with points lc rgb '{}' pt 6 ps 1.5",
                                columns, colours[i % colours.size()]));
  }
  const PathBox& box = run.path_box;
  std::vector<Panel> named = {{"", {}, run.paths}};
  const Legend legend(sheet, named, true);
  const double width = sheet.print() ? sheet.width : 1000.0, left = 90.0,
               right = legend.below() ? 16.0 : std::max(legend.width, 0.18 * width),
               above = sheet.print() ? 14.0 : 50.0, below = 60.0 + legend.height(named.front());
  const double inner = (width - left - right) * (box.y_high - box.y_low) / (box.x_high - box.x_low);
  const double height = above + below + inner;
  return {.name = "path",
          .title = title,
          .width = static_cast<int>(width),
          .height = static_cast<int>(height),
          .body = heading(sheet, title) +
                  fmt::format(
                      "  set key noenhanced {}\n  set size ratio -1\n"
                      "  set margins screen {:.4f}, screen {:.4f}, screen {:.4f}, screen {:.4f}\n"
                      "  set xrange [{:.6g}:{:.6g}]; set yrange [{:.6g}:{:.6g}]\n"
                      "  set xlabel 'x [m]'; set ylabel 'y [m]'\n{}",
                      legend.below()
                          ? fmt::format("at screen 0.5,{:.4g} bottom center horizontal maxcols {}",
                                        2.0 / height, legend.columns)
                          : "outside right top",
                      left / width, 1.0 - right / width, below / height, 1.0 - above / height,
                      box.x_low, box.x_high, box.y_low, box.y_high, plot(lines)),
          .sheet = sheet};
}

Figure hysteresis(const Sheet& sheet, const std::vector<DrawnRun>& runs, const std::string& title) {
  Texts lines;
  for (std::size_t i = 0; i < runs.size(); ++i)
    lines.push_back(fmt::format("{} using \"penetration_um\":\"force_N\" title {} {}",
                                gnuplot_text(data_file("hardest", runs[i])),
                                gnuplot_text(runs[i].law.empty() ? "contact" : runs[i].law),
                                style(i)));
  return {
      .name = "hysteresis",
      .title = title,
      .width = sheet.print() ? sheet.width : 1000,
      .height = (sheet.print() ? sheet.width * 7 / 10 : 700) + 20 * static_cast<int>(runs.size()),
      .body = heading(sheet, title) +
              "  set key noenhanced below left vertical maxcols 1\n"
              "  set xlabel 'penetration [µm]'; set ylabel 'contact force [N]'\n"
              "  set xrange [0:*]; set yrange [0:*]\n" +
              plot(lines),
      .sheet = sheet};
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
      lines.push_back(fmt::format("{} using 1:2 title {} {}", file, gnuplot_text(all[i].name),
                                  all[i].dots ? fmt::format("with points lc rgb '{}' pt 7 ps 0.6",
                                                            colours[i % colours.size()])
                                              : style(i)));
    }
    plots += fmt::format("  set title {} noenhanced\n{}{}", gnuplot_text(run.law),
                         all.size() == 1 ? "  unset key\n" : "", plot(lines));
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

DrawnRun write_standard_data(const LawRun& run, const Path& folder, const Texts& paths) {
  DrawnRun drawn{.law = run.law, .folder = run.folder, .contacts = drawn_contacts(run)};
  if (run.samples.rows() < 2) return drawn;
  make_output_folder(folder);
  drawn.bodies = bodies_of(run.samples);
  drawn.still = still_quantities(run.samples, drawn.bodies);
  drawn.paths = paths;
  drawn.forces = joints_of(run.samples, false);
  drawn.moments = joints_of(run.samples, true);
  drawn.force_top = force_top_of(run, drawn.forces);
  drawn.energies = energies_of(run.samples);
  write_motion(run.samples, drawn, folder / data_file("motion", drawn));
  if (!paths.empty())
    drawn.path_box = write_paths(run.samples, paths, folder / data_file("path", drawn));
  write_portraits(run, drawn, folder);
  if (run.contacts.empty()) return drawn;
  write_contacts(run, drawn.contacts, folder / data_file("contact", drawn));
  write_hardest(run, folder / data_file("hardest", drawn));
  return drawn;
}

std::vector<Figure> standard_figures(const std::string& case_name,
                                     const std::vector<DrawnRun>& runs, const Sheet& sheet) {
  const DrawnRun& first = runs.front();
  const auto title = [&](const std::string& what) {
    return case_name + ": " + what + (first.law.empty() ? "" : ", " + first.law);
  };
  std::vector<Figure> figures;
  const auto add = [&](const std::string& name, const std::string& what,
                       const std::vector<Panel>& all) {
    figures.push_back(panel_figure(sheet, name, title(what), all));
  };
  if (!first.paths.empty()) figures.push_back(path_figure(sheet, first, title("paths")));
  const auto bodies = [&](const std::string& name, const std::string& what,
                          std::initializer_list<std::array<const char*, 2>> quantities) {
    std::vector<Panel> all;
    for (const auto& [label, quantity] : quantities)
      if (std::ranges::find(first.still, quantity) == first.still.end())
        all.push_back(body_panel(first, label, quantity));
    if (!first.bodies.empty() && !all.empty()) add(name, what, all);
  };
  bodies("motion", "motion of the bodies",
         {{"x [m]", "x_m"}, {"y [m]", "y_m"}, {"angle [rad]", "angle_rad"}});
  bodies("velocities", "velocities of the bodies",
         {{"v_x [m/s]", "vx_m_per_s"},
          {"v_y [m/s]", "vy_m_per_s"},
          {"omega [rad/s]", "omega_rad_per_s"}});
  std::vector<Panel> reactions;
  const auto joints = [&](const Texts& names, const std::string& label, const char* column) {
    if (names.empty()) return;
    Panel panel{label, {}, names};
    for (std::size_t i = 0; i < names.size(); ++i)
      panel.lines.push_back(line(data_file("motion", first), names[i] + column, names[i], i));
    reactions.push_back(panel);
  };
  joints(first.forces, first.force_top > 0.0 ? "force [N], peaks cut" : "force [N]", ".force_N");
  if (!reactions.empty()) reactions.back().top = first.force_top;
  joints(first.moments, "moment [N m]", ".moment_N_m");
  if (!reactions.empty()) add("reactions", "reactions of the joints", reactions);
  figures.push_back(energy_figure(sheet, first, title("energy")));
  if (!first.contacts.empty()) {
    figures.push_back(law_panels(sheet, "contact_force", case_name + ": contact force", "[N]", runs,
                                 ".normal_force_N"));
    figures.push_back(law_panels(sheet, "penetration", case_name + ": penetration", "[µm]", runs,
                                 ".penetration_um"));
    figures.push_back(hysteresis(sheet, runs, case_name + ": the contact with the largest force"));
  }
  for (std::size_t i = 0; i < first.portraits.size(); ++i)
    figures.push_back(portrait_figure(sheet, case_name, runs, i));
  return figures;
}

}  // namespace yoke::cases
