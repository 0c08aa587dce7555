// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke equilibrium CASE: where the mechanism rests under its loads, with contacts.
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include <yoke/cases/program/analysis_verb.hpp>
#include <yoke/integrators/analyses/equilibrium.hpp>

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

}  // namespace

void add_equilibrium_verb(CLI::App& app, Action& action) {
  add_analysis_verb(
      app, action, "equilibrium", "Static equilibrium of a case under its loads, contacts included",
      [](CLI::App& verb, AnalysisOptions& options) {
        verb.add_flag("--allow-neutral", options.allow_neutral,
                      "Accept an equilibrium that leaves a motion free");
      },
      [](const Model& model, const RunRequest& request, const AnalysisOptions& options) {
        return report(equilibrium(model, {.allow_neutral = options.allow_neutral}), request,
                      options);
      });
}

}  // namespace yoke::cases
