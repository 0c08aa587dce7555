// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The figures of the paper's section 4 (11 to 16) from the last revolution of each run, the exact
// law of Johnson beside its fits, and the mechanism to scale, still and moving.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <yoke/cases/paper/figures/case_figures.hpp>
#include <yoke/cases/scotch_yoke.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

using namespace scotch_yoke_data;
using Path = std::filesystem::path;

constexpr double degree = std::numbers::pi / 180.0;

// ---- data files ----

/// A text of comma-separated rows.
class Rows {
 public:
  explicit Rows(std::string header) : text_(std::move(header)) {}
  template <class... X>
  void add(X... values) {
    fmt::format_to(std::back_inserter(text_), "\n{}",
                   fmt::join({fmt::format("{:.7g}", static_cast<double>(values))...}, ","));
  }
  void blank() { text_ += "\n"; }
  void write(const Path& path) const { write_text(path, text_); }

 private:
  std::string text_;
};

/// Rows of the last revolution.
struct Window {
  std::size_t first = 0, last = 0;
  double angle = 0.0;  // [rad] relative crank angle at its start
};

Window last_revolution(const Table& rows, const ScotchYoke& choices) {
  const Eigen::VectorXd t = rows["t_s"], angle = rows["crank_angle_relative_rad"];
  const double start = choices.last_revolution_start();
  const auto first = std::lower_bound(t.begin(), t.end(), start * (1.0 - 1e-12)) - t.begin();
  return {.first = static_cast<std::size_t>(first), .last = rows.rows(), .angle = angle[first]};
}

void write_revolution(const LawRun& run, const ScotchYoke& choices, const Path& folder) {
  Rows rows(
      "angle_deg,force_N,penetration_um,slider_x_mm,slider_v_m_per_s,slider_a_m_per_s2,"
      "deviation_um");
  const Table& rows_of_run = run.all_motion();
  const auto angle = rows_of_run["crank_angle_relative_rad"], force = rows_of_run["normal_force_N"],
             penetration = rows_of_run["penetration_m"], x = rows_of_run["slider_x_m"],
             v = rows_of_run["slider_v_m_per_s"], a = rows_of_run["slider_a_m_per_s2"],
             omega = rows_of_run["crank_speed_rad_per_s"];
  const Window window = last_revolution(rows_of_run, choices);
  for (std::size_t row = window.first; row < window.last; ++row) {
    const auto i = static_cast<Eigen::Index>(row);
    const IdealMotion ideal =
        ideal_scotch_yoke(choices.crank_length, choices.start_angle + angle[i], omega[i]);
    rows.add((angle[i] - window.angle) / degree, force[i], 1e6 * std::max(0.0, penetration[i]),
             1e3 * x[i], v[i], a[i], 1e6 * (x[i] - ideal.x));
  }
  rows.write(folder / (run.folder + ".csv"));
}

void write_rigid(const ScotchYoke& choices, const Path& folder) {
  Rows rows("angle_deg,force_N,slider_x_mm,slider_v_m_per_s,slider_a_m_per_s2");
  for (int i = 0; i <= 720; ++i) {
    const double angle = 0.5 * i;
    const IdealMotion m =
        ideal_scotch_yoke(choices.crank_length, choices.start_angle + angle * degree, speed);
    rows.add(angle, std::abs(m.force), 1e3 * m.x, m.v, m.a);
  }
  rows.write(folder / "rigid.csv");
}

/// The outer wall, by the name of it in a slot along an arc or along a spline.
bool is_outer(std::string_view region) { return region == "outer" || region == "right"; }

/// The contact that begins with the pin's landing on the outer wall: one contact and rebound,
/// at nearly the same speed for every law. False if there is none.
bool write_loop(const LawRun& run, const ScotchYoke& choices, const Path& folder) {
  const auto spells =
      contact_spells(run, run.all(), choices.last_revolution_start(), choices.end_time());
  const auto landing = std::ranges::find_if(spells, [](const ContactSpell& s) {
    return s.crossed && is_outer(s.region) && s.last > s.first;
  });
  if (landing == spells.end()) return false;
  const auto force = run.all()["slot.normal_force_N"],
             penetration = run.all()["slot.penetration_m"];
  Rows rows("penetration_um,force_N");
  rows.add(0.0, 0.0);
  for (std::size_t row = landing->first; row < landing->last; ++row) {
    const auto i = static_cast<Eigen::Index>(row);
    rows.add(1e6 * penetration[i], force[i]);
  }
  rows.add(0.0, 0.0);
  rows.write(folder / ("loop-" + run.folder + ".csv"));
  return true;
}

// ---- curves ----

struct Style {
  std::string_view law;
  const char* title;
  const char* color;
  bool dashed = false;  // exact laws, over the colour of their fit
};

// Colours that differ for colour-blind readers too (Okabe and Ito).
constexpr Style styles[] = {
    {"table11-lankarani-nikravesh", "Lankarani-Nikravesh", "#d55e00"},
    {"table11-radzimovsky", "Radzimovsky", "#0072b2"},
    {"table11-johnson", "Johnson (fit)", "#009e73"},
    {"table11-goldsmith", "Goldsmith", "#cc79a7"},
    {"table11-esdu-78035", "ESDU 78035", "#e69f00"},
    {"johnson", "Johnson (exact)", "#000000", true},
    {"table11-johnson-10mm", "Johnson (fit), K x 10", "#56b4e9"},
    {"johnson-10mm", "Johnson (exact), L = 10 mm", "#000000", true},
};
constexpr const char* rigid_curve = "title 'no clearance' with lines lc rgb '#a0a0a0' lw 2.5";

// A law of the catalogue goes by the name of its folder and takes the colours in turn.
struct CurveStyle {
  std::string title, color;
  bool dashed = false;
};

CurveStyle style_of(const std::string& law, std::size_t place = 0) {
  const auto found = std::ranges::find(styles, law, &Style::law);
  if (found != std::end(styles)) return {found->title, found->color, found->dashed};
  return {law, styles[place % std::size(styles)].color, false};
}

struct Curves {
  std::string_view columns;
  int every = 1;
  std::string_view prefix = "";
  bool dashes = true;
};

/// Plot elements, one per law: 'LAW.csv' every N using ... title ... with lines ...
std::vector<std::string> curves(const std::vector<std::string>& laws, const Curves& how) {
  std::vector<std::string> parts;
  for (const std::string& law : laws) {
    const CurveStyle style = style_of(law, parts.size());
    parts.push_back(fmt::format(
        "'{}{}.csv' every {} using {} title \"{}\" noenhanced with lines lc rgb '{}' lw 1.2 dt {}",
        how.prefix, law, how.every, how.columns, style.title, style.color,
        style.dashed && how.dashes ? 2 : 1));
  }
  return parts;
}

std::string plot(std::vector<std::string> parts) {
  return fmt::format("  plot {}", fmt::join(parts, ", \\\n       "));
}

std::string with_rigid(std::vector<std::string> parts, std::string_view columns) {
  parts.insert(parts.begin(), fmt::format("'rigid.csv' using {} {}", columns, rigid_curve));
  return plot(std::move(parts));
}

/// Tics every `step` degrees, half as many where the sheet is narrow.
std::string angle_axis(const Sheet& sheet, double from, double to, int step, bool numbers = true) {
  return fmt::format("  set xrange [{:g}:{:g}]; set xtics {} format '{}'; set mxtics 3\n{}", from,
                     to, sheet.narrow() ? 2 * step : step, numbers ? "%g" : "",
                     !numbers ? ""
                     : sheet.narrow()
                         ? "  set xlabel 'crank angle in the revolution [deg]'\n"
                         : "  set xlabel 'crank angle from the start of the revolution [deg]'\n");
}

/// A title over a figure; print has it in the caption.
std::string heading(const Sheet& sheet, const std::string& title) {
  return sheet.print() ? "" : fmt::format("  set title '{}'\n", title);
}

/// Margins around panels, in pixels, and the title.
std::string multiplot(const Sheet& sheet, std::size_t panels, double height, double right,
                      double bottom, const std::string& title) {
  const double left = sheet.print() ? 92.0 : 108.0, top = sheet.print() ? 14.0 : 50.0;
  return fmt::format(
      "  set multiplot layout {},1 margins {:.4g},{:.4g},{:.4g},{:.4g} spacing 0,{:.3g}{}\n",
      panels, left / sheet.width, 1.0 - right / sheet.width, bottom / height, 1.0 - top / height,
      14.0 / height, sheet.print() ? "" : fmt::format(" title '{}'", title));
}

/// One plot; where the legend is below, it takes rows of its own.
Figure plain_figure(const Sheet& sheet, const std::string& name, const std::string& title,
                    std::string body, std::size_t laws, int screen_width = 1200) {
  const int rows = sheet.narrow() ? 20 * static_cast<int>(laws + 1) : 0;
  return {.name = name,
          .title = title,
          .width = sheet.print() ? sheet.width : screen_width,
          .height = (sheet.narrow()  ? 290
                     : sheet.print() ? 450
                                     : 700) +
                    rows,
          .body = std::move(body),
          .sheet = sheet};
}

// ---- figures ----

using Laws = std::vector<std::string>;

Figure figure11(const Sheet& sheet, const Laws& laws) {
  return plain_figure(
      sheet, "figure11", "Contact force over the last revolution (Figure 11 of the paper)",
      angle_axis(sheet, 0, 360, 30) + heading(sheet, "Contact force over one revolution") +
          "  set ylabel 'contact force [N]'; set yrange [0:*]\n" +
          with_rigid(curves(laws, {"1:2", 4}), "1:2"),
      laws.size());
}

// The same, one law above the other: five bouncing curves on one axis hide each other.
Figure figure11_panels(const Sheet& sheet, const Laws& laws) {
  const std::size_t n = laws.size();
  const double height = (sheet.print() ? 110.0 : 170.0) * static_cast<double>(n) + 80.0;
  std::string body = fmt::format(
                         "  set xrange [*:*]; set yrange [*:*]; top = 0\n"
                         "  do for [law in '{}'] {{ stats law.'.csv' using 2 nooutput; "
                         "top = STATS_max > top ? STATS_max : top }}\n",
                         fmt::join(laws, " ")) +
                     multiplot(sheet, n, height, std::max(20.0, 0.02 * sheet.width), 60.0,
                               "Contact force over one revolution (grey: no clearance)") +
                     angle_axis(sheet, 0, 360, 30, false) +
                     (sheet.print() ? "  set yrange [0:1.3*top]; set ytics round_step(top/4)\n"
                                    : "  set yrange [0:1.05*top]\n") +
                     "  unset key\n";
  for (std::size_t i = 0; i < n; ++i) {
    if (i + 1 == n) body += angle_axis(sheet, 0, 360, 30);
    body += fmt::format(
        "  set ylabel '[N]'; set label 1 \"{}\" at graph 0.5,0.88 center front noenhanced\n{}\n",
        style_of(laws[i]).title,
        with_rigid(curves({laws[i]}, {.columns = "1:2", .every = 4, .dashes = false}), "1:2"));
  }
  return {.name = "figure11_panels",
          .title = "Contact force, a panel for each law",
          .width = sheet.width,
          .height = static_cast<int>(height),
          .body = body + "  unset multiplot",
          .sheet = sheet};
}

Figure figure12(const Sheet& sheet, const Laws& laws) {
  return plain_figure(
      sheet, "figure12", "Penetration over the last revolution (Figure 12 of the paper)",
      angle_axis(sheet, 0, 360, 30) + heading(sheet, "Penetration over one revolution") +
          "  set ylabel 'penetration [µm]'; set yrange [0:*]\n" + plot(curves(laws, {"1:3", 4})),
      laws.size());
}

Figure figure13(const Sheet& sheet, const Laws& laws) {
  return plain_figure(sheet, "figure13",
                      "Penetration after the pin has changed walls (Figure 13 of the paper)",
                      angle_axis(sheet, 90, 180, 10) +
                          heading(sheet, "Penetration after the pin has landed on the inner wall") +
                          "  set ylabel 'penetration [µm]'; set yrange [0:*]; set mxtics 5\n" +
                          plot(curves(laws, {"1:3", 2})),
                      laws.size());
}

Figure figure14(const Sheet& sheet, const Laws& laws) {
  return plain_figure(sheet, "figure14",
                      "Contact force in the impact section (Figure 14 of the paper)",
                      angle_axis(sheet, 0, 100, 10) +
                          heading(sheet, "Contact force in the impact section, until 100 deg") +
                          "  set ylabel 'contact force [N]'; set yrange [0:*]; set mxtics 5\n" +
                          with_rigid(curves(laws, {"1:2", 2}), "1:2"),
                      laws.size());
}

Figure figure15(const Sheet& sheet, const Laws& laws) {
  return plain_figure(sheet, "figure15",
                      "Hysteresis of one contact and rebound (Figure 15 of the paper)",
                      heading(sheet, "One contact and rebound: landing on the outer wall") +
                          "  set xlabel 'penetration [µm]'; set ylabel 'contact force [N]'\n"
                          "  set xrange [0:*]; set yrange [0:*]\n" +
                          plot(curves(laws, {"1:2", 1, "loop-"})),
                      laws.size(), 1000);
}

Figure figure16(const Sheet& sheet, const Laws& laws) {
  // A narrow sheet has the legend below.
  const double rows = sheet.narrow() ? 20.0 * static_cast<double>(laws.size() + 1) : 0.0;
  const double height = sheet.narrow() ? 700.0 + rows : sheet.print() ? 800.0 : 1200.0;
  std::string body = multiplot(sheet, 4, height,
                               sheet.narrow()  ? 18.0
                               : sheet.print() ? 225.0
                                               : 240.0,
                               62.0 + rows, "Slider: position, velocity, acceleration") +
                     angle_axis(sheet, 0, 360, 30, false);
  if (sheet.narrow())
    body += fmt::format("  set key at screen 0.5,{:.4g} bottom center maxcols 1\n", 2.0 / height);
  const auto panel = [&](const char* label, const std::string& what) {
    body += fmt::format("  set ylabel \"{}\"\n{}\n", label, what);
  };
  panel("position [mm]", with_rigid(curves(laws, {"1:4", 4}), "1:3"));
  body += "  unset key\n";
  panel(sheet.print() ? "deviation [µm]" : "position minus that\\nwithout clearance [µm]",
        plot(curves(laws, {"1:7", 4})));
  panel("velocity [m/s]", with_rigid(curves(laws, {"1:5", 4}), "1:4"));
  body += angle_axis(sheet, 0, 360, 30);
  panel(sheet.print() ? "accel. [m/s^2]" : "acceleration [m/s^2]",
        with_rigid(curves(laws, {"1:6", 4}), "1:5"));
  return {.name = "figure16",
          .title = "Motion of the slider (Figure 16 of the paper)",
          .width = sheet.width,
          .height = static_cast<int>(height),
          .body = body + "  unset multiplot",
          .sheet = sheet};
}

Figure johnson_figure(const Sheet& sheet) {
  const double height = sheet.narrow() ? 460.0 : sheet.print() ? 600.0 : 900.0;
  std::string body = multiplot(sheet, 2, height, std::max(18.0, 0.03 * sheet.width), 70.0,
                               "Johnson, exact and as Table 11 fits it") +
                     angle_axis(sheet, 90, 180, 10, false) +
                     "  set ylabel 'contact force [N]'; set yrange [0:*]; set mxtics 5\n" +
                     (sheet.narrow() ? "  set offsets 0,0,graph 0.45,0\n" : "");
  const auto panel = [&](const char* name, const std::vector<std::string>& laws, int every) {
    body += fmt::format("  set key inside right top title '{}'\n", name) +
            plot(curves(laws, {"1:2", every})) + "\n";
  };
  panel("K as printed; L = 1 mm", {"table11-johnson", "johnson"}, 2);
  body += angle_axis(sheet, 90, 180, 10);
  panel("K times 10; L = 10 mm", {"table11-johnson-10mm", "johnson-10mm"}, 1);
  return {.name = "johnson",
          .title = "Johnson's law and its fit",
          .width = sheet.width,
          .height = static_cast<int>(height),
          .body = body + "  unset multiplot",
          .sheet = sheet};
}

// ---- the mechanism ----

/// Outline of a slot of this half-width around the centreline, as seen from the arc's centre [mm].
Rows slot_outline(double width) {
  Rows rows("x_mm,y_mm");
  const double half = arc_angle / 2.0;
  const auto arc = [&](double cx, double cy, double radius, double from, double to) {
    for (int i = 0; i <= 60; ++i) {
      const double angle = from + (to - from) * i / 60.0;
      rows.add(1e3 * (cx + radius * std::cos(angle)), 1e3 * (cy + radius * std::sin(angle)));
    }
  };
  const auto end = [&](double direction) {
    return Vec2{arc_radius * std::cos(direction), arc_radius * std::sin(direction)};
  };
  const double begin = pi - half, finish = pi + half;
  arc(0, 0, arc_radius + width, begin, finish);
  arc(end(finish).x(), end(finish).y(), width, finish, finish + pi);
  arc(0, 0, arc_radius - width, finish, begin);
  arc(end(begin).x(), end(begin).y(), width, begin + pi, begin + 2.0 * pi);
  return rows;
}

/// Poses to draw the mechanism in: 90 in a revolution, at equal distances in time.
void write_frames(const LawRun& run, const ScotchYoke& choices, const Path& folder) {
  Rows rows("pin_x_mm,pin_y_mm,slider_x_mm,angle_deg,force_x_N,force_y_N");
  const auto angle = run.motion()["crank_angle_relative_rad"], x = run.motion()["slider_x_m"],
             force = run.motion()["normal_force_N"];
  const std::size_t region = run.motion().index("region");
  const Window window = last_revolution(run.motion(), choices);
  for (int frame = 0; frame < 90; ++frame) {
    const std::size_t row =
        window.first + (window.last - 1 - window.first) * static_cast<std::size_t>(frame) / 90;
    const auto i = static_cast<Eigen::Index>(row);
    const Vec2 pin = rotate(choices.start_angle + angle[i], {choices.crank_length, 0.0});
    const Vec2 away = (pin - Vec2{x[i], 0.0}).normalized();
    const Vec2 push = (is_outer(run.motion().text(row, region)) ? 1.0 : -1.0) * force[i] * away;
    rows.add(1e3 * pin.x(), 1e3 * pin.y(), 1e3 * x[i], (angle[i] - window.angle) / degree, push.x(),
             push.y());
  }
  rows.write(folder / "frames.csv");
}

// Draws frame number i; the force on the slider is an arrow of 1 mm per 40 N.
constexpr const char* draw_frame =
    R"(  stats 'frames.csv' every ::(i+1)::(i+1) using 1 name 'A' nooutput; px = A_min
  stats 'frames.csv' every ::(i+1)::(i+1) using 2 name 'A' nooutput; py = A_min
  stats 'frames.csv' every ::(i+1)::(i+1) using 3 name 'A' nooutput; sx = A_min
  stats 'frames.csv' every ::(i+1)::(i+1) using 4 name 'A' nooutput; deg = A_min
  stats 'frames.csv' every ::(i+1)::(i+1) using 5 name 'A' nooutput; fx = A_min / 40
  stats 'frames.csv' every ::(i+1)::(i+1) using 6 name 'A' nooutput; fy = A_min / 40
  set object 1 circle at sx-30,51.96 size 4.5 fillcolor rgb "#40566e" fillstyle solid front
  set object 2 circle at sx-30,-51.96 size 4.5 fillcolor rgb "#40566e" fillstyle solid front
  set object 3 circle at px,py size 7.9 fillcolor rgb "#d55e00" fillstyle solid border lc rgb "#803800" front
  set object 4 circle at 0,0 size 3 fillcolor rgb "#404040" fillstyle solid front
  set arrow 1 from 0,0 to px,py nohead linewidth 6 linecolor rgb "#606060" front
  set arrow 2 from px,py to px+fx,py+fy linewidth 2.5 linecolor rgb "#009e73" front
  set arrow 3 from -72,82 to 112,82 nohead linewidth 5 linecolor rgb "#c8c8c8" back
  set arrow 4 from -72,-82 to 112,-82 nohead linewidth 5 linecolor rgb "#c8c8c8" back
  set arrow 5 from sx-30,65 to sx-30,82 nohead linewidth 6 linecolor rgb "#40566e" back
  set arrow 6 from sx-30,-65 to sx-30,-82 nohead linewidth 6 linecolor rgb "#40566e" back
  set label 9 "1 kg" at sx-14,51.96 front
)";

constexpr const char* plot_frame =
    R"(  plot [-75:115] [-90:90] 'plate.csv' using ($1+sx):2 with filledcurves closed fillcolor rgb "#dfe6ee" notitle, \
       'plate.csv' using ($1+sx):2 with lines lc rgb "#40566e" notitle, \
       'slot.csv' using ($1+sx):2 with filledcurves closed fillcolor rgb "#ffffff" notitle, \
       'slot.csv' using ($1+sx):2 with lines lc rgb "#40566e" notitle
)";

constexpr const char* mechanism_axes = R"(  set size ratio -1
  unset key; unset grid; set xlabel "x [mm]"; set ylabel "y [mm]"; set xtics 25; set ytics 25
)";

Figure mechanism_figure(const Sheet& sheet, const ScotchYoke& choices) {
  const double R = 1e3 * arc_radius;
  return {.name = "mechanism",
          .title = "The mechanism to scale, at the start of the revolution",
          .width = sheet.print() ? sheet.width : 1000,
          .height = sheet.print() ? sheet.width : 980,
          .body = std::string(mechanism_axes) + "  i = 0\n" + draw_frame +
                  heading(sheet, fmt::format(
                                     "Scotch-yoke, to scale: crank {:.4g} mm, slot radius {:g} "
                                     "mm, walls {:g} and {:g} mm, pin radius {:g} mm (gap {:g} mm)",
                                     1e3 * choices.crank_length, R, R - 1e3 * half_width,
                                     R + 1e3 * half_width, 1e3 * pin_radius,
                                     std::round(1e6 * gap) / 1e3)) +
                  "  set label 2 'crank pivot' at -5,0 right front\n"
                  "  set label 3 'slider guided along x' at -70,77 front\n"
                  "  set label 4 'inner wall' at sx-44,0 front\n"
                  "  set label 5 'outer wall' at sx-60,45 right front\n" +
                  plot_frame,
          .sheet = sheet};
}

Figure animation() {
  return {.name = "mechanism_moving",
          .title = "The mechanism over one revolution",
          .width = 560,
          .height = 560,
          .body = std::string(mechanism_axes) + "do for [i=0:89] {\n" + draw_frame +
                  "  set title sprintf('%.0f deg; green: contact force, 40 N per mm', deg)\n" +
                  plot_frame + "}",
          .animated = true};
}

bool have(const std::vector<LawRun>& runs, std::string_view law) {
  return std::ranges::find(runs, law, &LawRun::folder) != runs.end();
}

}  // namespace

std::vector<Figure> scotch_yoke_figures(const Case&, const RunRequest& request,
                                        const std::vector<LawRun>& runs, const Path& folder) {
  const ScotchYoke choices(request.parameters);
  if (choices.slot == ScotchYoke::Slot::ideal) return {};  // the figures are about contacts
  make_output_folder(folder);
  std::vector<std::string> laws, loops;
  for (const LawRun& run : runs) {
    write_revolution(run, choices, folder);
    if (run.folder.ends_with("-10mm")) continue;  // they have a figure of their own
    laws.push_back(run.folder);
    if (write_loop(run, choices, folder)) loops.push_back(run.folder);
  }
  write_rigid(choices, folder);
  slot_outline(half_width).write(folder / "slot.csv");
  slot_outline(half_width + 5e-3).write(folder / "plate.csv");
  write_frames(runs.front(), choices, folder);

  std::vector<Figure> figures{animation()};
  const bool shows_details = choices.revolutions >= 0.5;  // they lie in the first 180 deg
  const bool both_johnsons = have(runs, "table11-johnson") && have(runs, "johnson") &&
                             have(runs, "table11-johnson-10mm") && have(runs, "johnson-10mm");
  for (const Sheet& sheet : request.sheets) {
    const auto add = [&](auto... figure) { (figures.push_back(figure(sheet, laws)), ...); };
    figures.push_back(mechanism_figure(sheet, choices));
    if (!laws.empty()) add(figure11, figure11_panels, figure12, figure16);
    if (!loops.empty()) figures.push_back(figure15(sheet, loops));
    if (!laws.empty() && shows_details) add(figure13, figure14);
    if (both_johnsons && shows_details) figures.push_back(johnson_figure(sheet));
  }
  return figures;
}

}  // namespace yoke::cases
