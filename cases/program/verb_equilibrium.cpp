// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke equilibrium CASE: where the mechanism rests under its loads, with contacts, and with --path
// how that place moves while the loads or a parameter change.
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include <yoke/cases/jobs/plot.hpp>
#include <yoke/cases/program/analysis_verb.hpp>
#include <yoke/integrators/analyses/equilibrium.hpp>
#include <yoke/integrators/analyses/equilibrium_path.hpp>

namespace yoke::cases {

namespace {

nlohmann::ordered_json numbers(const Table& row) {
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < row.names().size(); ++i) json[row.names()[i]] = row.value(0, i);
  return json;
}

int report(const Equilibrium& e, const RunRequest& request, const AnalysisOptions& options) {
  nlohmann::ordered_json json = {
      {"found", e.found},           {"reason", e.reason},      {"load_steps", e.load_steps},
      {"iterations", e.iterations}, {"load", e.load},          {"worst", e.worst},
      {"residual", e.residual},     {"residual_unit", e.unit}, {"touching", e.touching},
      {"stable", e.stable},         {"neutral", e.neutral}};
  if (e.lowest_stiffness) json["lowest_stiffness_per_s2"] = *e.lowest_stiffness;
  if (!options.request.output.empty()) {
    make_output_folder(request.output);
    e.row.write_csv(request.output / "equilibrium.csv");
    write_text(request.output / "summary.json", json.dump(2) + "\n");
  }
  const int code = e.found ? exit_ok : exit_failed;
  if (options.format == "json") {
    json["row"] = numbers(e.row);
    fmt::print("{}\n", json.dump(2));
    return code;
  }
  fmt::print("{}\n", e.reason);
  if (!e.found) return code;
  if (!e.touching.empty()) fmt::print("touching: {}\n", fmt::join(e.touching, ", "));
  if (e.lowest_stiffness) fmt::print("lowest stiffness {:.6g} 1/s^2\n", *e.lowest_stiffness);
  fmt::print("largest residual {:.2g} {} ('{}')\n", e.residual, e.unit, e.worst);
  for (std::size_t i = 0; i < e.row.names().size(); ++i) {
    const std::string& name = e.row.names()[i];
    const bool shown = name.ends_with(".x_m") || name.ends_with(".y_m") || name.ends_with("_rad") ||
                       name.ends_with("_N") || name.ends_with("_N_m") ||
                       name.ends_with(".penetration_m");
    if (shown) fmt::print("{:<32} {:>18.10g}\n", name, e.row.value(0, i));
  }
  return code;
}

/// "NAME=FROM:TO", or "FROM:TO" of the factor of the loads.
EquilibriumPathOptions path_options(const std::string& text) {
  const std::size_t equals = text.rfind('='), colon = text.rfind(':');
  const std::size_t from = equals == std::string::npos ? 0 : equals + 1;
  if (colon == std::string::npos || colon < from)
    throw ModelError(fmt::format(
        "--path {}: accepted is FROM:TO of the load factor, or ELEMENT.PARAMETER=FROM:TO", text));
  return {.parameter = from == 0 ? "" : text.substr(0, equals),
          .from = parse_in("--path", text.substr(from, colon - from), ""),
          .to = parse_in("--path", text.substr(colon + 1), "")};
}

/// The column of positions or angles that changes most, positions if there are any that move.
std::size_t widest_column(const Table& points) {
  std::size_t widest = 0;
  for (const char* ending : {"_m", ".angle_rad"}) {
    double range = 0.0;
    for (std::size_t i = 0; i < points.names().size(); ++i) {
      const std::string& name = points.names()[i];
      if (!name.ends_with(".x_m") && !name.ends_with(".y_m") && !name.ends_with(".angle_rad"))
        continue;
      const Eigen::VectorXd values = points[name];
      const double r = values.maxCoeff() - values.minCoeff();
      if (name.ends_with(ending) && r > range) range = r, widest = i;
    }
    if (range > 1e-9) break;
  }
  return widest;
}

Figure path_figure(const Table& points, const std::string& title) {
  const std::size_t x = widest_column(points);
  const auto curve = [&](const char* condition, const char* style) {
    return fmt::format("\"path.csv\" every ::1 using {}:({} ? $1 : NaN) {}", x + 1, condition,
                       style);
  };
  return {
      .name = "path",
      .title = title,
      .width = 1000,
      .height = 650,
      .body = fmt::format(
          "set xlabel \"{}\" noenhanced\nset ylabel \"{}\" noenhanced\nplot \"path.csv\" "
          "every ::1 using {}:1 with lines lc rgb '#a0a0a0' dt 2 title 'unstable', "
          "{}, {}, {}\n",
          points.names()[x], points.names()[0], x + 1,
          curve("strcol(3) eq \"stable\" || strcol(3) eq \"neutral\"",
                "with lines lc rgb '#0072b2' lw 2 title 'stable'"),
          curve("strcol(2) eq \"limit\"", "with points lc rgb '#d55e00' pt 7 title 'limit point'"),
          curve("strcol(2) eq \"branch\"",
                "with points lc rgb '#009e73' pt 5 title 'branch point'"))};
}

int report_path(const EquilibriumPath& path, const RunRequest& request,
                const AnalysisOptions& options, const std::string& parameter) {
  const int code = path.complete ? exit_ok : exit_failed;
  nlohmann::ordered_json critical = nlohmann::ordered_json::array();
  for (const CriticalPoint& c : path.critical)
    critical.push_back({{"kind", c.kind == PathPoint::limit ? "limit" : "branch"},
                        {parameter, c.value},
                        {"row", c.row}});
  const nlohmann::ordered_json json = {{"complete", path.complete},
                                       {"reason", path.reason},
                                       {"points", path.points.rows()},
                                       {"iterations", path.iterations},
                                       {"critical", critical}};
  std::string pictures;
  if (path.points.rows() > 0) {
    make_output_folder(request.output);
    path.points.write_csv(request.output / "path.csv");
    write_text(request.output / "summary.json", json.dump(2) + "\n");
    pictures =
        draw_figures({path_figure(path.points, options.request.case_name + ": " + parameter)},
                     request.output, 1);
  }
  if (options.format == "json") {
    fmt::print("{}\n", json.dump(2));
    return code;
  }
  fmt::print("{}\n", path.reason);
  for (const CriticalPoint& c : path.critical)
    fmt::print("{} point at {} = {:.12g} (row {})\n",
               c.kind == PathPoint::limit ? "limit" : "branch", parameter, c.value, c.row);
  if (!pictures.empty()) fmt::print("results in {}\n{}\n", request.output.string(), pictures);
  return code;
}

int follow_path(const Model& model, const RunRequest& request, const AnalysisOptions& options,
                const std::string& text) {
  EquilibriumPathOptions along = path_options(text);
  along.allow_neutral = options.allow_neutral;
  return report_path(equilibrium_path(model, along), request, options,
                     along.parameter.empty() ? "load_factor" : along.parameter);
}

}  // namespace

void add_equilibrium_verb(CLI::App& app, Action& action) {
  auto path = std::make_shared<std::string>();
  add_analysis_verb(
      app, action, "equilibrium", "Static equilibrium of a case under its loads, contacts included",
      [path](CLI::App& verb, AnalysisOptions& options) {
        verb.add_flag("--allow-neutral", options.allow_neutral,
                      "Accept an equilibrium that leaves a motion free");
        verb.add_option("--path", *path,
                        "Follow it while the load factor, or a parameter (SI), changes: 0:1, "
                        "spring.stiffness=5000:100")
            ->type_name("[NAME=]FROM:TO");
      },
      [path](const Model& model, const RunRequest& request, const AnalysisOptions& options) {
        if (!path->empty()) return follow_path(model, request, options, *path);
        return report(equilibrium(model, {.allow_neutral = options.allow_neutral}), request,
                      options);
      });
}

}  // namespace yoke::cases
