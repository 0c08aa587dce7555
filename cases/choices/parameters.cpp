// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/choices/parameters.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include <yoke/core/error.hpp>

namespace yoke::cases {

std::string CaseParameter::range_text() const {
  std::vector<std::string> parts = words;
  if (numeric())
    parts.push_back(fmt::format("{}{} to {}", whole ? "a whole number, " : "",
                                format_quantity(quantity, low), format_quantity(quantity, high)));
  return fmt::format("{}", fmt::join(parts, " or "));
}

Parameters::Parameters(std::vector<CaseParameter> parameters,
                       const std::vector<std::string>& settings)
    : parameters_(std::move(parameters)) {
  for (const CaseParameter& p : parameters_) set(p.name, p.default_text);
  for (const std::string& setting : settings) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos)
      throw ModelError(fmt::format("--set {}: expected name=value", setting));
    set(std::string_view(setting).substr(0, equals), std::string_view(setting).substr(equals + 1));
  }
}

const CaseParameter& Parameters::find(std::string_view name) const {
  const auto found = std::ranges::find(parameters_, name, &CaseParameter::name);
  if (found != parameters_.end()) return *found;
  std::vector<std::string> known;
  for (const CaseParameter& p : parameters_) known.push_back(p.name);
  throw ModelError(fmt::format("unknown parameter '{}'{}", name, suggestion(name, known)));
}

void Parameters::set(std::string_view name, std::string_view value) {
  const CaseParameter& p = find(name);
  if (std::ranges::find(p.words, value) != p.words.end()) {
    values_[p.name] = {.number = 0.0, .word = std::string(value)};
    return;
  }
  if (!p.numeric())
    throw ModelError(fmt::format("{}: '{}' is not one of {}", name, value, p.range_text()));
  const double x = parse_quantity(name, p.quantity, value);
  // A value typed as a bound may differ from it by rounding.
  const double slack = 1e-12 * std::max(std::abs(p.low), std::abs(p.high));
  if (!(x >= p.low - slack && x <= p.high + slack))
    throw ModelError(fmt::format("{}: {} is out of range; accepted: {}", name,
                                 format_quantity(p.quantity, x), p.range_text()));
  if (p.whole && x != std::round(x))
    throw ModelError(
        fmt::format("{}: {} is not a whole number; accepted: {}", name, value, p.range_text()));
  values_[p.name] = {.number = x, .word = {}};
}

const Parameters::Value& Parameters::value(std::string_view name) const {
  return values_.at(find(name).name);
}

double Parameters::number(std::string_view name) const { return value(name).number; }

int Parameters::whole(std::string_view name) const {
  return static_cast<int>(std::lround(number(name)));
}

const std::string& Parameters::word(std::string_view name) const { return value(name).word; }

std::string Parameters::text(std::string_view name) const {
  const Value& v = value(name);
  return v.word.empty() ? format_quantity(find(name).quantity, v.number) : v.word;
}

nlohmann::ordered_json Parameters::to_json() const {
  nlohmann::ordered_json json;
  for (const CaseParameter& p : parameters_) json[p.name] = text(p.name);
  return json;
}

}  // namespace yoke::cases
