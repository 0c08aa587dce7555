// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/fmu/fmu_variables.hpp>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <yoke/core/error.hpp>
#include <yoke/integrators/simulation.hpp>

namespace yoke::cases {

namespace {

const char* si_unit(Quantity quantity) {
  switch (quantity) {
    case Quantity::length:
      return "m";
    case Quantity::angle:
      return "rad";
    case Quantity::time:
      return "s";
    case Quantity::time_per_length:
      return "s/m";
    case Quantity::number:
      break;
  }
  return "";
}

}  // namespace

std::string FmuDescription::to_json() const {
  return nlohmann::ordered_json({{"case", case_name},
                                 {"settings", settings},
                                 {"law", law},
                                 {"relative_tolerance", relative_tolerance},
                                 {"guid", guid}})
      .dump(2);
}

FmuDescription FmuDescription::from_json(const std::string& text) {
  try {
    const auto json = nlohmann::json::parse(text);
    return {.case_name = json.at("case"),
            .settings = json.at("settings").get<std::vector<std::string>>(),
            .law = json.at("law"),
            .relative_tolerance = json.at("relative_tolerance"),
            .guid = json.at("guid")};
  } catch (const nlohmann::json::exception& error) {
    throw ModelError(
        fmt::format("this is not the description of an FMU of Yoke: {}", error.what()));
  }
}

Parameters fmu_parameters(const FmuDescription& description) {
  return Parameters(find_case(description.case_name).parameters, description.settings);
}

Model fmu_model(const FmuDescription& description, const Parameters& parameters) {
  return make_model(find_case(description.case_name), parameters, description.law);
}

double fmu_duration(const FmuDescription& description, const Parameters& parameters) {
  return find_case(description.case_name).duration(parameters);
}

std::vector<FmuVariable> fmu_variables(const FmuDescription& description) {
  const Parameters parameters = fmu_parameters(description);
  const Model model = fmu_model(description, parameters);
  std::vector<FmuVariable> all;
  for (const CaseParameter& p : find_case(description.case_name).parameters) {
    if (!p.numeric() || p.whole || parameters.is_word(p.name)) continue;
    all.push_back({.name = "case." + p.name,
                   .unit = si_unit(p.quantity),
                   .description = p.description,
                   .role = FmuRole::fixed,
                   .start = parameters.number(p.name),
                   .low = p.low,
                   .high = p.high,
                   .case_parameter = p.name});
  }
  for (std::size_t i = 0; i < model.parameters().size(); ++i) {
    const OwnedParameter& p = model.parameters()[i];
    if (p.parameter.own) continue;
    all.push_back({.name = p.name(),
                   .unit = p.parameter.unit,
                   .role = p.parameter.load ? FmuRole::input : FmuRole::tunable,
                   .start = p.parameter.value,
                   .low = p.parameter.low,
                   .high = p.parameter.high,
                   .index = i});
  }
  Simulation run(model, {.until = fmu_duration(description, parameters), .samples = 0});
  const Table columns = run.result().samples;
  for (std::size_t i = 0; i < columns.names().size(); ++i)
    if (columns.names()[i] != "t_s")
      all.push_back({.name = columns.names()[i], .unit = columns.unit(i), .index = i});
  return all;
}

}  // namespace yoke::cases
