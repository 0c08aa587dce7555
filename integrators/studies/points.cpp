// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/points.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <yoke/core/error.hpp>

namespace yoke {

namespace {

/// As a person would write it: 0.1 and not 0.1 and a bit.
double rounded_to(int digits, double x) {
  return std::strtod(fmt::format("{:.{}g}", x, digits).c_str(), nullptr);
}

StudyAxis ranged_axis(std::string name, double low, double high, std::size_t count,
                      std::string unit, bool logarithmic) {
  const std::string owner = fmt::format("axis '{}'", name);
  require_finite(owner, "low", low);
  require_finite(owner, "high", high);
  if (logarithmic) {
    require_positive(owner, "low, on a logarithmic axis,", low, unit);
    require_positive(owner, "high, on a logarithmic axis,", high, unit);
  }
  if (count < 1 || count > most_study_points)
    throw ModelError(
        fmt::format("{}: {} values; accepted are 1 to {}", owner, count, most_study_points));
  if (count == 1 && low != high)
    throw ModelError(fmt::format(
        "{}: one value cannot be both {:g} and {:g}; accepted are 2 or more", owner, low, high));
  StudyAxis axis{.name = std::move(name), .unit = std::move(unit)};
  axis.range = true;
  axis.low = low;
  axis.high = high;
  axis.logarithmic = logarithmic;
  for (std::size_t i = 0; i < count; ++i) {
    const double part = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0.0;
    const double between = logarithmic ? rounded_to(13, low * std::pow(high / low, part))
                                       : rounded_to(15, low + (high - low) * part);
    axis.values.push_back(i == 0 ? low : i + 1 == count ? high : between);
  }
  return axis;
}

}  // namespace

StudyAxis linear_axis(std::string name, double low, double high, std::size_t count,
                      std::string unit) {
  return ranged_axis(std::move(name), low, high, count, std::move(unit), false);
}

StudyAxis log_axis(std::string name, double low, double high, std::size_t count, std::string unit) {
  return ranged_axis(std::move(name), low, high, count, std::move(unit), true);
}

StudyAxis value_axis(std::string name, std::vector<double> values, std::string unit) {
  if (values.empty()) throw ModelError(fmt::format("axis '{}' has no values", name));
  for (const double x : values) require_finite(fmt::format("axis '{}'", name), "value", x);
  StudyAxis axis{.name = std::move(name), .unit = std::move(unit), .values = std::move(values)};
  const auto [low, high] = std::ranges::minmax(axis.values);
  axis.low = low;
  axis.high = high;
  return axis;
}

StudyAxis word_axis(std::string name, std::vector<std::string> words) {
  if (words.empty()) throw ModelError(fmt::format("axis '{}' has no words", name));
  StudyAxis axis{.name = std::move(name), .words = std::move(words)};
  for (std::size_t i = 0; i < axis.words.size(); ++i) axis.values.push_back(static_cast<double>(i));
  axis.high = axis.values.back();
  return axis;
}

StudyPoints::StudyPoints(std::vector<StudyAxis> axes, std::vector<double> coordinates,
                         std::string origin)
    : axes_(std::move(axes)), coordinates_(std::move(coordinates)), origin_(std::move(origin)) {
  for (std::size_t i = 0; i < axes_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (axes_[i].name == axes_[j].name)
        throw ModelError(fmt::format("axis '{}' is given twice", axes_[i].name));
  if (axes_.empty() ? !coordinates_.empty() : coordinates_.size() % axes_.size() != 0)
    throw ModelError(fmt::format("points of {} axes have {} coordinates in all", axes_.size(),
                                 coordinates_.size()));
  size_ = axes_.empty() ? 0 : coordinates_.size() / axes_.size();
  for (std::size_t a = 0; a < axes_.size(); ++a)
    for (std::size_t i = 0; i < size_ && !axes_[a].words.empty(); ++i) {
      const double x = coordinate(i, a);
      if (!(x >= 0.0 && x < static_cast<double>(axes_[a].words.size()) && x == std::floor(x)))
        throw ModelError(fmt::format("axis '{}': {} is not the number of one of its {} words",
                                     axes_[a].name, x, axes_[a].words.size()));
    }
}

std::string StudyPoints::text(std::size_t point, std::size_t axis) const {
  const double x = coordinate(point, axis);
  const std::vector<std::string>& words = axes_[axis].words;
  return words.empty() ? fmt::format("{}", x) : words[static_cast<std::size_t>(x)];
}

std::size_t StudyPoints::axis(std::string_view name) const {
  const auto found = std::ranges::find(axes_, name, &StudyAxis::name);
  if (found != axes_.end()) return static_cast<std::size_t>(found - axes_.begin());
  std::vector<std::string> known;
  for (const StudyAxis& a : axes_) known.push_back(a.name);
  throw ModelError(
      fmt::format("unknown axis '{}'; there are '{}'", name, fmt::join(known, "', '")));
}

}  // namespace yoke
