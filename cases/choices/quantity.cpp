// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/choices/quantity.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include <yoke/core/error.hpp>
#include <yoke/core/types.hpp>

namespace yoke::cases {

namespace {

// SI value = number * factor / divisor. Dividing keeps 45mm the double nearest to 0.045.
struct Unit {
  std::string_view name;
  double factor;
  double divisor;
};

// The first unit is the one to print in.
const std::vector<Unit>& units_of(Quantity quantity) {
  static const std::vector<Unit> number{};
  static const std::vector<Unit> length{
      {"mm", 1, 1e3}, {"cm", 1, 1e2}, {"m", 1, 1}, {"um", 1, 1e6}};
  static const std::vector<Unit> angle{{"deg", pi, 180}, {"rad", 1, 1}};
  static const std::vector<Unit> time{{"s", 1, 1}, {"ms", 1, 1e3}, {"us", 1, 1e6}};
  static const std::vector<Unit> time_per_length{{"s/m", 1, 1}, {"s/mm", 1e3, 1}};
  switch (quantity) {
    case Quantity::number:
      return number;
    case Quantity::length:
      return length;
    case Quantity::angle:
      return angle;
    case Quantity::time:
      return time;
    case Quantity::time_per_length:
      return time_per_length;
  }
  return number;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Number of letters to insert, delete or replace.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

std::string_view si_unit_name(Quantity quantity) {
  for (const Unit& unit : units_of(quantity))
    if (unit.factor == 1.0 && unit.divisor == 1.0) return unit.name;
  return "";
}

std::string accepted_units(Quantity quantity) {
  std::vector<std::string_view> names;
  for (const Unit& unit : units_of(quantity)) names.push_back(unit.name);
  return names.empty() ? "a plain number" : fmt::format("{}", fmt::join(names, ", "));
}

double parse_quantity(std::string_view owner, Quantity quantity, std::string_view text) {
  const std::string_view word = trimmed(text);
  double number = 0.0;
  const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || !std::isfinite(number))
    throw ModelError(fmt::format("{}: '{}' does not start with a finite number", owner, text));
  const std::string_view name = trimmed(word.substr(static_cast<std::size_t>(rest - word.data())));
  const std::vector<Unit>& units = units_of(quantity);
  if (units.empty() && name.empty()) return number;
  for (const Unit& unit : units)
    if (unit.name == name) return number * unit.factor / unit.divisor;
  const std::string problem = name.empty() ? "has no unit" : fmt::format("has the unit '{}'", name);
  throw ModelError(
      fmt::format("{}: '{}' {}; accepted: {}", owner, text, problem, accepted_units(quantity)));
}

TypedNumber parse_number(std::string_view owner, std::string_view text) {
  double value = 0.0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value))
    throw ModelError(fmt::format("{}: '{}' does not start with a finite number", owner, text));
  std::string_view unit = text.substr(static_cast<std::size_t>(rest - text.data()));
  while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
  return {value, unit};
}

double parse_in(std::string_view owner, std::string_view text, std::string_view unit) {
  const TypedNumber number = parse_number(owner, text);
  if (!number.unit.empty() && number.unit != unit)
    throw ModelError(fmt::format("{}: '{}' has the unit '{}'; accepted: a plain number{}{}", owner,
                                 text, number.unit, unit.empty() ? "" : " or one in ", unit));
  return number.value;
}

double parse_metres(std::string_view owner, std::string_view text) {
  const TypedNumber number = parse_number(owner, text);
  return number.unit.empty() ? number.value : parse_quantity(owner, Quantity::length, text);
}

std::string exactly(double value) { return fmt::format("{:.17g}", value); }

std::string format_quantity(Quantity quantity, double value) {
  const std::vector<Unit>& units = units_of(quantity);
  if (units.empty()) return fmt::format("{:.9g}", value);
  const Unit& unit = units.front();
  return fmt::format("{:.9g} {}", value * unit.divisor / unit.factor, unit.name);
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : known) {
    // A beginning counts as near: 'johnson' for 'table11-johnson' does too, by its end.
    const bool part = word.size() >= 3 && candidate.find(word) != std::string::npos;
    const std::size_t distance = part ? 1 : edit_distance(word, candidate);
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  const std::string nearest = nearest_word(word, known);
  const std::string question = nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
  return fmt::format("{}{} '{}'", question,
                     nearest.empty() ? "; known:" : " Known:", fmt::join(known, "', '"));
}

}  // namespace yoke::cases
