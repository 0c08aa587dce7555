// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/maps/map_axis.hpp>

#include <fmt/format.h>

#include <array>

#include <yoke/cases/sweep/sweep_axes.hpp>
#include <yoke/core/error.hpp>
#include <yoke/integrators/studies/maps/section.hpp>

namespace yoke::cases {

namespace {

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

/// BODY.COLUMN=LOW:HIGH:N
MapAxis parse_column_axis(const std::string& option, const std::string& text, std::size_t equals) {
  const std::string owner = option + " " + text, range = text.substr(equals + 1);
  std::vector<std::string> parts{""};
  for (const char c : range)
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  if (parts.size() != 3)
    throw ModelError(fmt::format("{}: accepted is BODY.COLUMN=LOW:HIGH:N in SI units", owner));
  const auto number = [&](std::size_t i) {
    return parse_quantity(owner, Quantity::number, parts[i]);
  };
  const double count = number(2);
  require_range(owner, "N", count, 1.0, 1e6);
  MapAxis axis{.axis = linear_axis(text.substr(0, equals), number(0), number(1),
                                   static_cast<std::size_t>(count))};
  axis.column = axis.axis.name;
  return axis;
}

}  // namespace

std::vector<std::string> MapAxis::settings_at(std::size_t i) const {
  return settings.empty() ? std::vector<std::string>{} : std::vector{settings[i]};
}

MapAxis parse_map_axis(const Case& c, const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('='), dot = text.find('.');
  if (equals != std::string::npos && dot < equals) return parse_column_axis(option, text, equals);
  try {
    const SweepPoints points(c, {.vary = {text}});
    MapAxis axis{.axis = points.points().axes().front()};
    if (!axis.axis.words.empty() || points.setting(0).parameters.empty())
      throw ModelError(
          fmt::format("{} {}: accepted is a parameter of the case with numbers", option, text));
    for (std::size_t i = 0; i < points.points().size(); ++i)
      axis.settings.push_back(points.setting(i).parameters.front());
    return axis;
  } catch (const ModelError& error) {
    throw ModelError(replaced(error.what(), "--vary", option));
  }
}

void set_start(const Model& model, State& start, const std::string& column, double value) {
  if (!is_motion_column(model, column))
    throw ModelError(
        fmt::format("--grid {}: neither a parameter nor a coordinate or velocity of a "
                    "body, as {}",
                    column, free_coordinates(model).front()));
  constexpr std::array<std::string_view, 6> names{"x_m",        "y_m",        "angle_rad",
                                                  "vx_m_per_s", "vy_m_per_s", "omega_rad_per_s"};
  const std::size_t dot = column.rfind('.');
  const auto body = static_cast<Eigen::Index>(model.find_body(column.substr(0, dot)).index) - 1;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (column.substr(dot + 1) != names[i]) continue;
    const auto at = 3 * body + static_cast<Eigen::Index>(i % 3);
    (i < 3 ? start.q : start.v)[at] = value;
  }
}

}  // namespace yoke::cases
