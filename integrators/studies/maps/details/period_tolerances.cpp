// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/maps/details/period_tolerances.hpp>

#include <algorithm>
#include <cmath>

namespace yoke {

namespace {

constexpr double above_error = 100.0;  // of the run's tolerance

/// What the error weights take for one of this unit.
double scale_of(const std::string& column, const Summary& summary) {
  const double length = summary.length_scale, time = summary.time_scale;
  if (column.ends_with("_rad")) return 1.0;
  if (column.ends_with("_rad_per_s")) return 1.0 / time;
  if (column.ends_with("_m")) return length;
  if (column.ends_with("_m_per_s")) return length / time;
  return 0.0;
}

}  // namespace

bool is_angle_column(const std::string& column) { return column.ends_with("angle_rad"); }

std::vector<double> period_tolerances(const Poincare& map, const std::vector<double>& range,
                                      const PoincareOptions& options) {
  const double error = above_error * options.run.relative_tolerance;
  std::vector<double> tolerances{-1.0};
  for (std::size_t j = 1; j < range.size(); ++j) {
    const std::string& name = map.points.names()[j];
    double size = scale_of(name, map.summary);
    for (std::size_t i = 0; i < map.points.rows() && !is_angle_column(name); ++i)
      size = std::max(size, std::abs(map.points.value(i, j)));
    tolerances.push_back(name == "penetration_m"
                             ? -1.0
                             : std::max(options.period_tolerance * range[j], error * size));
  }
  return tolerances;
}

}  // namespace yoke
