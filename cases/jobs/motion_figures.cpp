// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/figure_parts.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace yoke::cases {

namespace {

constexpr std::size_t motion_rows = 4001;  // of the data

using Path = std::filesystem::path;
using Texts = std::vector<std::string>;

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

Texts bodies_of(const Table& samples) {
  return largest_of(owners(samples, ".alpha_rad_per_s2"), [&](const std::string& body) {
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
  return largest_of(names, [&](const std::string& joint) {
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

/// Quantities that no body changes beyond rounding of the largest one, or beside the same along the other
/// axis; not drawn.
Texts still_quantities(const Table& samples, const Texts& bodies) {
  constexpr double beside = 1e-7;
  Texts names;
  for (const char* quantity : body_quantities) {
    std::string other = quantity;  // "y_m" of "x_m"
    for (char& axis : other)
      if (axis == 'x' || axis == 'y') {
        axis = axis == 'x' ? 'y' : 'x';
        break;
      }
    double along_other = 0.0;
    for (const std::string& body : bodies)
      along_other = std::max(along_other, range_of(samples, body + "." + other));
    if (other == quantity) along_other = 0.0;
    const bool moves = std::ranges::any_of(bodies, [&](const std::string& body) {
      const Eigen::VectorXd values = samples[body + "." + quantity];
      const double range = values.maxCoeff() - values.minCoeff();
      return range > 1e-12 * values.cwiseAbs().maxCoeff() && range > beside * along_other;
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

Panel body_panel(const DrawnRun& run, const std::string& label, const char* quantity) {
  Panel panel{label, {}, run.bodies};
  for (std::size_t i = 0; i < run.bodies.size(); ++i)
    panel.lines.push_back(
        panel_line(data_file("motion", run), run.bodies[i] + "." + quantity, run.bodies[i], i));
  return panel;
}

Figure energy_figure(const Sheet& sheet, const DrawnRun& run, const std::string& title) {
  const std::string file = data_file("motion", run);
  Panel terms{"energy [J]", {}}, balance{"balance [J]", {}, {"error of the balance"}};
  for (const std::string& energy : run.energies) {
    terms.names.push_back(energy == "stored" ? "stored in contacts" : energy);
    terms.lines.push_back(panel_line(file, energy + "_J", terms.names.back(), terms.lines.size()));
  }
  balance.lines.push_back(panel_line(file, "balance_J", balance.names.front(), terms.lines.size()));
  return panel_figure(sheet, "energy", title, {terms, balance});
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
    lines.push_back(fmt::format("{} title {} {}", columns, gnuplot_text(body), line_style(i)));
    lines.push_back(fmt::format("{} every ::0::0 notitle with points lc rgb '{}' pt 6 ps 1.5",
                                columns, line_colour(i)));
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
                      box.x_low, box.x_high, box.y_low, box.y_high, plot_of(lines)),
          .sheet = sheet};
}

}  // namespace

void write_motion_data(const LawRun& run, const std::filesystem::path& folder,
                       const std::vector<std::string>& paths, DrawnRun& drawn) {
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
}

std::vector<Figure> motion_figures(const std::string& case_name, const DrawnRun& first,
                                   const Sheet& sheet) {
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
      panel.lines.push_back(panel_line(data_file("motion", first), names[i] + column, names[i], i));
    reactions.push_back(panel);
  };
  joints(first.forces, first.force_top > 0.0 ? "force [N], peaks cut" : "force [N]", ".force_N");
  if (!reactions.empty()) reactions.back().top = first.force_top;
  joints(first.moments, "moment [N m]", ".moment_N_m");
  if (!reactions.empty()) add("reactions", "reactions of the joints", reactions);
  figures.push_back(energy_figure(sheet, first, title("energy")));
  return figures;
}

}  // namespace yoke::cases
