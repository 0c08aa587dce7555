// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/orbits/orbit_job.hpp>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include <yoke/cases/jobs/figure_parts.hpp>
#include <yoke/cases/jobs/progress.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

constexpr double fast_enough = 1e-9;  // [m/s] of a coordinate that is worth a picture

/// "ball.y" and its rate by the names of their columns.
struct Coordinate {
  std::string position, rate;
};

constexpr std::array<std::array<const char*, 3>, 3> coordinates = {
    {{"x", ".x_m", ".vx_m_per_s"},
     {"y", ".y_m", ".vy_m_per_s"},
     {"angle", ".angle_rad", ".omega_rad_per_s"}}};

/// The one asked for, or whose rate changes most: of positions, else of angles.
Coordinate portrait_of(const Model& model, const Table& samples, const std::string& asked) {
  Coordinate best;
  double widest = fast_enough;
  for (const Body& body : model.bodies()) {
    for (const auto& [name, position, rate] : coordinates) {
      const Coordinate here{body.name + position, body.name + rate};
      if (!samples.has(here.position)) continue;
      if (body.name + "." + name == asked) return here;
      const Eigen::VectorXd v = samples[here.rate];
      const double range = v.maxCoeff() - v.minCoeff();
      const bool angle = here.position.ends_with("_rad");
      const bool have = best.position.ends_with("_m");
      if (angle && have) continue;
      if (range > (have == !angle ? widest : fast_enough)) best = here, widest = range;
    }
  }
  if (!asked.empty())
    throw ModelError(fmt::format(
        "--coordinate {}: accepted is BODY.x, BODY.y or BODY.angle of a body of the case", asked));
  return best;
}

std::size_t column(const Table& table, const std::string& name) { return table.index(name) + 1; }

Figure phase_figure(const std::string& title, const Table& samples, const Coordinate& c) {
  return {
      .name = "orbit",
      .title = title + ": the orbit",
      .width = 900,
      .height = 700,
      .body = fmt::format(
          "set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n{}",
          gnuplot_text(title + ": the orbit"), gnuplot_text(c.position), gnuplot_text(c.rate),
          plot_of({fmt::format("'orbit.csv' every ::1 using {}:{} {}", column(samples, c.position),
                               column(samples, c.rate), line_style(0)),
                   fmt::format("'orbit.csv' every ::1::1 using {}:{} with points pt 7 ps 1 {} "
                               "title 'start'",
                               column(samples, c.position), column(samples, c.rate),
                               "lc rgb '" + line_colour(1) + "'")}))};
}

Figure multiplier_figure(const std::string& title, const PeriodicOrbit& orbit) {
  double range = 1.15;
  bool any = false, any_trivial = false;
  for (const FloquetMultiplier& m : orbit.multipliers) {
    range = std::max(range, 1.15 * std::abs(m.value));
    (m.trivial ? any_trivial : any) = true;
  }
  const auto points = [](const char* kind, std::size_t colour, const char* name) {
    return fmt::format(
        "'multipliers.csv' every ::1 using (strcol(4) eq '{}' ? $1 : NaN):2 with points pt 7 ps 1.3 lc rgb "
        "'{}' title '{}'",
        kind, line_colour(colour), name);
  };
  std::vector<std::string> parts = {
      "cos(t),sin(t) with lines lc rgb '#808080' lw 1 title 'unit circle'"};
  if (any) parts.push_back(points("no", 0, "multipliers"));
  if (any_trivial) parts.push_back(points("yes", 4, "trivial ones"));
  return {.name = "multipliers",
          .title = title + ": Floquet multipliers",
          .width = 800,
          .height = 640,
          .body = fmt::format(
              "set title {} noenhanced\nset xlabel 'real part'\nset ylabel 'imaginary part'\n"
              "set size ratio -1\nset parametric\nset trange [0:2*pi]\nset samples 400\n"
              "set xrange [{}:{}]\nset yrange [{}:{}]\n{}",
              gnuplot_text(title + ": Floquet multipliers"), -range, range, -range, range,
              plot_of(parts))};
}

void write_multipliers(const PeriodicOrbit& orbit, const std::filesystem::path& path) {
  std::string text = "re,im,modulus,trivial\n";
  for (const FloquetMultiplier& m : orbit.multipliers)
    text += fmt::format("{},{},{},{}\n", m.value.real(), m.value.imag(), std::abs(m.value),
                        m.trivial ? "yes" : "no");
  text.pop_back();  // write_text ends the last line
  write_text(path, text);
}

nlohmann::ordered_json rows_of(const Eigen::MatrixXd& matrix) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const Eigen::RowVectorXd row = matrix.row(i);
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return rows;
}

nlohmann::ordered_json to_json(const PeriodicOrbit& o) {
  return {{"found", o.found},
          {"reason", o.reason},
          {"period_s", o.period},
          {"stability", name_of(o.stability)},
          {"bifurcation", name_of(o.bifurcation)},
          {"largest_multiplier", o.largest_multiplier},
          {"determinant", o.determinant},
          {"degrees_of_freedom", o.degrees_of_freedom},
          {"residuals", o.residuals},
          {"worst", o.worst},
          {"start",
           {{"t_s", o.start.t},
            {"q", std::vector<double>(o.start.q.begin(), o.start.q.end())},
            {"v", std::vector<double>(o.start.v.begin(), o.start.v.end())},
            {"z", std::vector<double>(o.start.z.begin(), o.start.z.end())}}},
          {"monodromy", rows_of(o.monodromy)},
          {"memory", o.memory},
          {"events", o.run.events.size()},
          {"notes", o.notes}};
}

void print(const PeriodicOrbit& o) {
  fmt::print("{}\n", o.reason);
  if (!o.found) return;
  fmt::print("period {:.12g} s, {}{}\n", o.period, name_of(o.stability),
             o.bifurcation == BifurcationKind::none
                 ? ""
                 : fmt::format(", near a bifurcation: {}", name_of(o.bifurcation)));
  fmt::print("{:>22} {:>22} {:>14}\n", "multiplier: real part", "imaginary part", "modulus");
  for (const FloquetMultiplier& m : o.multipliers)
    fmt::print("{:>22.12g} {:>22.12g} {:>14.8g}{}\n", m.value.real(), m.value.imag(),
               std::abs(m.value), m.trivial ? "  trivial" : "");
  for (const std::string& note : o.notes) fmt::print("note: {}\n", note);
}

RunStatus status_of(bool good) {
  return interrupted() ? RunStatus::interrupted : good ? RunStatus::completed : RunStatus::failed;
}

SimulationOptions options_of(const RunRequest& request, int samples) {
  SimulationOptions options;
  options.relative_tolerance = request.relative_tolerance;
  options.formulation = request.formulation;
  options.samples = samples;
  options.observer = [](const Progress&) { return !interrupted(); };
  return options;
}

Figure exponent_figure(const std::string& title, const Table& history) {
  std::vector<std::string> lines;
  for (std::size_t i = 1; i < history.names().size(); ++i)
    lines.push_back(fmt::format("'exponents.csv' every ::1 using 1:{} {} title '{}'", i + 1,
                                line_style(i - 1), i));
  return {.name = "exponents",
          .title = title + ": Lyapunov exponents",
          .width = 1000,
          .height = 600,
          .body = fmt::format("set title {} noenhanced\nset xlabel 'time [s]'\n"
                              "set ylabel 'mean rate of growth [1/s]'\nset xzeroaxis lc rgb "
                              "'#606060'\n{}",
                              gnuplot_text(title + ": Lyapunov exponents"), plot_of(lines))};
}

}  // namespace

double period_of_turns(const Model& model, int turns) {
  if (turns < 1) throw ModelError(fmt::format("--turns {}: must be at least 1", turns));
  const State start = assembled_state(model);
  double fastest = 0.0;
  for (const auto& constraint : model.constraints()) {
    if (!constraint->rheonomic()) continue;
    const BodyId body = constraint->bodies()[constraint->reaction_body()];
    if (body != ground) fastest = std::max(fastest, std::abs(start.v[3 * body.index - 1]));
  }
  if (!(fastest > 0.0))
    throw ModelError(fmt::format(
        "--turns {}: no driver turns a body at the start of the case; give --period", turns));
  return 2.0 * pi * turns / fastest;
}

RunStatus run_orbit(const std::string& title, const Model& model, const RunRequest& request,
                    PeriodicOrbitOptions options, const std::string& coordinate) {
  options.run = options_of(request, request.samples);
  const PeriodicOrbit orbit = periodic_orbit(model, options);
  const std::filesystem::path& folder = request.output;
  make_output_folder(folder);
  std::string pictures;
  write_text(folder / "summary.json", to_json(orbit).dump(2));
  write_multipliers(orbit, folder / "multipliers.csv");
  const Table& samples = orbit.run.samples;
  if (samples.rows() > 1) {
    samples.write_csv(folder / "orbit.csv");
    write_events(orbit.run.events, folder / "events.csv");
    std::vector<Figure> figures;
    const Coordinate c = portrait_of(model, samples, coordinate);
    if (!c.position.empty()) figures.push_back(phase_figure(title, samples, c));
    if (!orbit.multipliers.empty()) figures.push_back(multiplier_figure(title, orbit));
    if (request.plots) pictures = draw_figures(figures, folder, request.jobs);
  }
  if (!request.quiet) {
    print(orbit);
    fmt::print("results in {}\n{}{}", folder.string(), pictures, pictures.empty() ? "" : "\n");
  } else if (!orbit.found) {
    fmt::print(stderr, "yoke: {}\n", orbit.reason);
  }
  return status_of(orbit.found);
}

RunStatus run_lyapunov(const std::string& title, const Model& model, const RunRequest& request,
                       LyapunovOptions options) {
  options.run = options_of(request, 0);
  ProgressLine line({title}, !request.quiet);
  options.run.observer = line.observer(0);
  const Lyapunov found = lyapunov(model, options);
  const std::filesystem::path& folder = request.output;
  make_output_folder(folder);
  std::string pictures;
  const auto numbers = [](const Eigen::VectorXd& x) {
    return std::vector<double>(x.begin(), x.end());
  };
  const nlohmann::ordered_json json = {{"complete", found.complete},
                                       {"reason", found.reason},
                                       {"exponents_per_s", numbers(found.exponents)},
                                       {"uncertainty_per_s", numbers(found.uncertainty)},
                                       {"mean_trace_per_s", found.mean_trace},
                                       {"t_end_s", found.run.summary.t_end},
                                       {"intervals", found.history.rows()},
                                       {"jumps", found.jumps},
                                       {"degrees_of_freedom", found.degrees_of_freedom},
                                       {"notes", found.notes}};
  write_text(folder / "summary.json", json.dump(2));
  found.history.write_csv(folder / "exponents.csv");
  if (request.plots && found.history.rows() > 1)
    pictures = draw_figures({exponent_figure(title, found.history)}, folder, 1);
  if (!request.quiet) {
    fmt::print("{}\n", found.reason);
    for (Eigen::Index i = 0; i < found.exponents.size(); ++i)
      fmt::print("exponent {}: {:.6g}{} 1/s\n", i + 1, found.exponents[i],
                 std::isfinite(found.uncertainty[i])
                     ? fmt::format(" +- {:.2g}", found.uncertainty[i])
                     : "");
    fmt::print("mean trace {:.6g} 1/s\n", found.mean_trace);
    for (const std::string& note : found.notes) fmt::print("note: {}\n", note);
    fmt::print("results in {}\n{}{}", folder.string(), pictures, pictures.empty() ? "" : "\n");
  } else if (!found.complete) {
    fmt::print(stderr, "yoke: {}\n", found.reason);
  }
  return status_of(found.complete);
}

}  // namespace yoke::cases
