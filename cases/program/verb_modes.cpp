// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke modes CASE: natural frequencies, damping ratios and shapes about the equilibrium, or about
// the start.
#include <nlohmann/json.hpp>

#include <yoke/cases/program/analysis_verb.hpp>
#include <yoke/integrators/analyses/equilibrium.hpp>
#include <yoke/integrators/analyses/modes.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke::cases {

namespace {

State state_to_look_at(const Model& model, const std::string& about) {
  if (about == "start") return assembled_state(model);
  Equilibrium e = equilibrium(model, {.allow_neutral = true});
  if (!e.found)
    throw ModelError("modes: " + e.reason + "; '--about start' looks at the start pose");
  return std::move(e.state);
}

Table table_of(const Modes& found, const Model& model) {
  Table table;
  for (const auto& [name, unit] : {std::pair{"frequency", "Hz"},
                                   {"damped_frequency", "Hz"},
                                   {"damping_ratio", ""},
                                   {"eigenvalue_re", "1/s"},
                                   {"eigenvalue_im", "1/s"}})
    table.add_column(name, unit);
  for (int i = 1; i <= model.body_count(); ++i)
    for (const char* coordinate : {"x", "y", "angle"})
      for (const char* part : {"re", "im"})
        table.add_column(fmt::format("{}.{}_{}", model.bodies()[static_cast<std::size_t>(i)].name,
                                     coordinate, part),
                         "");
  for (const Mode& mode : found.modes) {
    double* row = table.append();
    for (const double x : {mode.frequency, mode.damped_frequency, mode.damping_ratio,
                           mode.eigenvalue.real(), mode.eigenvalue.imag()})
      *row++ = x;
    for (const std::complex<double>& x : mode.shape) {
      *row++ = x.real();
      *row++ = x.imag();
    }
  }
  return table;
}

int report(const Modes& found, const Model& model, const RunRequest& request,
           const AnalysisOptions& options) {
  const Table table = table_of(found, model);
  if (!options.request.output.empty()) {
    make_output_folder(request.output);
    table.write_csv(request.output / "modes.csv");
  }
  if (options.format == "json") {
    nlohmann::ordered_json modes = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < table.rows(); ++i) {
      nlohmann::ordered_json mode;
      for (std::size_t k = 0; k < table.names().size(); ++k)
        mode[table.names()[k]] = table.value(i, k);
      modes.push_back(mode);
    }
    const nlohmann::ordered_json json = {
        {"degrees_of_freedom", found.linearisation.degrees_of_freedom()},
        {"stable", found.stable},
        {"warning", found.linearisation.warning},
        {"modes", modes}};
    fmt::print("{}\n", json.dump(2));
    return exit_ok;
  }
  if (!found.linearisation.warning.empty())
    fmt::print("warning: {}\n", found.linearisation.warning);
  fmt::print("degrees of freedom: {}\n", found.linearisation.degrees_of_freedom());
  fmt::print("{:>4} {:>16} {:>14} {:>34}  {}\n", "mode", "frequency Hz", "damping ratio",
             "eigenvalue 1/s", "moves most");
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    const Mode& mode = found.modes[i];
    Eigen::Index most = 0;
    mode.shape.cwiseAbs().maxCoeff(&most);
    fmt::print("{:>4} {:>16.9g} {:>14.6g} {:>16.9g} {:>+16.9g}i  {}\n", i + 1, mode.frequency,
               mode.damping_ratio, mode.eigenvalue.real(), mode.eigenvalue.imag(),
               model.bodies()[static_cast<std::size_t>(most / 3 + 1)].name);
  }
  return exit_ok;
}

}  // namespace

void add_modes_verb(CLI::App& app, Action& action) {
  auto about = std::make_shared<std::string>("equilibrium");
  auto lowest = std::make_shared<int>(0);
  add_analysis_verb(
      app, action, "modes", "Natural frequencies, damping and shapes of a case",
      [about, lowest](CLI::App& verb, AnalysisOptions&) {
        verb.add_option("--about", *about, "equilibrium or start: the state to linearise about")
            ->check(CLI::IsMember({"equilibrium", "start"}))
            ->capture_default_str();
        verb.add_option("--lowest", *lowest,
                        "this many of the lowest modes; 0: all, or 10 of a large model")
            ->capture_default_str();
      },
      [about, lowest](const Model& model, const RunRequest& request,
                      const AnalysisOptions& options) {
        return report(modes(model, state_to_look_at(model, *about), {.lowest = *lowest}), model,
                      request, options);
      });
}

}  // namespace yoke::cases
