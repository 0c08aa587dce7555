// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <fmt/format.h>

#include <cmath>
#include <set>

#include <yoke/cases/fmu/fmu_variables.hpp>
#include <yoke/core/version.hpp>

namespace yoke::cases {

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

/// Nothing if there is no value.
std::string attribute(const char* name, const std::string& value) {
  return value.empty() ? "" : fmt::format(" {}=\"{}\"", name, escaped(value));
}
std::string attribute(const char* name, double value) {
  return std::isfinite(value) ? fmt::format(" {}=\"{}\"", name, value) : "";
}

struct RoleText {
  const char *causality, *variability, *initial;  // "": as the standard says by itself
};

RoleText text_of(FmuRole role) {
  switch (role) {
    case FmuRole::fixed:
      return {"parameter", "fixed", "exact"};
    case FmuRole::tunable:
      return {"parameter", "tunable", "exact"};
    case FmuRole::input:
      return {"input", "continuous", ""};
    case FmuRole::output:
      break;
  }
  return {"output", "continuous", "calculated"};
}

std::string scalar_variable(const FmuVariable& v, std::size_t reference) {
  const RoleText text = text_of(v.role);
  std::string type = "<Real" + attribute("unit", v.unit);
  if (v.role != FmuRole::output)
    type += attribute("min", v.low) + attribute("max", v.high) + attribute("start", v.start);
  return fmt::format(
      "    <ScalarVariable name=\"{}\" valueReference=\"{}\"{} causality=\"{}\" "
      "variability=\"{}\"{}>\n      {}/>\n    </ScalarVariable>\n",
      escaped(v.name), reference, attribute("description", v.description), text.causality,
      text.variability, attribute("initial", text.initial), type);
}

std::string unknowns(const char* element, const std::vector<FmuVariable>& variables) {
  std::string out = fmt::format("    <{}>\n", element);
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (variables[i].role == FmuRole::output)
      out += fmt::format("      <Unknown index=\"{}\"/>\n", i + 1);
  return out + fmt::format("    </{}>\n", element);
}

}  // namespace

std::string model_description(const FmuDescription& description) {
  const std::vector<FmuVariable> variables = fmu_variables(description);
  std::set<std::string> units;
  for (const FmuVariable& v : variables)
    if (!v.unit.empty()) units.insert(v.unit);
  std::string xml = fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="{}" guid="{}"
    description="{}" generationTool="Yoke {}"
    variableNamingConvention="flat" numberOfEventIndicators="0">
  <CoSimulation modelIdentifier="yoke_fmu" canHandleVariableCommunicationStepSize="true"
      canInterpolateInputs="false" maxOutputDerivativeOrder="0" canGetAndSetFMUstate="true"
      canSerializeFMUstate="true" canNotUseMemoryManagementFunctions="true"
      providesDirectionalDerivative="true"/>
)",
      escaped(description.case_name), escaped(description.guid),
      escaped(find_case(description.case_name).description), version);
  xml += "  <UnitDefinitions>\n";
  for (const std::string& unit : units)
    xml += fmt::format("    <Unit name=\"{}\"/>\n", escaped(unit));
  xml +=
      "  </UnitDefinitions>\n  <LogCategories>\n    <Category name=\"logStatusError\"/>\n"
      "  </LogCategories>\n";
  xml += fmt::format("  <DefaultExperiment startTime=\"0\" stopTime=\"{}\" tolerance=\"{}\"/>\n",
                     fmu_duration(description, fmu_parameters(description)),
                     description.relative_tolerance);
  xml += "  <ModelVariables>\n";
  for (std::size_t i = 0; i < variables.size(); ++i) xml += scalar_variable(variables[i], i);
  xml += "  </ModelVariables>\n  <ModelStructure>\n" + unknowns("Outputs", variables) +
         unknowns("InitialUnknowns", variables) + "  </ModelStructure>\n</fmiModelDescription>\n";
  return xml;
}

}  // namespace yoke::cases
