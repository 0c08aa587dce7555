// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/maps/basins.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <yoke/integrators/studies/maps/details/period_tolerances.hpp>

namespace yoke {

namespace {

constexpr std::size_t bounded_quantity = 0, period_quantity = 1, first_mean = 2;

/// Mean and scatter of a column over the last rows; of an angle on the circle.
struct Spread {
  double mean = 0.0, scatter = 0.0;
};

Spread spread_of(const Table& points, std::size_t column, std::size_t rows) {
  const std::size_t first = points.rows() - rows;
  const auto n = static_cast<double>(rows);
  Spread s;
  if (is_angle_column(points.names()[column])) {
    double c = 0.0, sine = 0.0;
    for (std::size_t i = first; i < points.rows(); ++i) {
      c += std::cos(points.value(i, column));
      sine += std::sin(points.value(i, column));
    }
    s.mean = std::atan2(sine, c);
  } else {
    for (std::size_t i = first; i < points.rows(); ++i) s.mean += points.value(i, column) / n;
  }
  for (std::size_t i = first; i < points.rows(); ++i) {
    double d = points.value(i, column) - s.mean;
    if (is_angle_column(points.names()[column])) d = std::remainder(d, 2.0 * pi);
    s.scatter += d * d / n;
  }
  s.scatter = std::sqrt(s.scatter);
  return s;
}

bool goes_beyond(const Poincare& map, double bound) {
  for (std::size_t j = 1; j < map.points.names().size(); ++j)
    if (!is_angle_column(map.points.names()[j]) && !(map.range[j] <= bound)) return true;
  return false;
}

StudyOutcome outcome_of(const SectionedModel& at, const BasinOptions& options) {
  PoincareOptions own = options.map;
  own.observer = [&](std::size_t) { return !(options.study.stop && options.study.stop()); };
  const Poincare map = poincare(at.model, at.start, at.section, own);
  if (options.study.stop && options.study.stop() && !map.complete) return {.unfinished = true};
  if (goes_beyond(map, options.bound)) return {.values = {0.0, 0.0}};
  if (!map.complete) return {.failure = map.reason};
  StudyOutcome outcome{.values = {1.0, static_cast<double>(map.period)}};
  const std::size_t rows = map.period > 0 ? map.period : map.points.rows();
  std::vector<double> scatters;
  for (std::size_t j = 1; j < map.points.names().size(); ++j) {
    const Spread s = spread_of(map.points, j, rows);
    outcome.values.push_back(s.mean);
    scatters.push_back(s.scatter);
  }
  outcome.values.insert(outcome.values.end(), scatters.begin(), scatters.end());
  outcome.values.insert(outcome.values.end(), map.range.begin() + 1, map.range.end());
  return outcome;
}

/// Puts the starts that lead to one attractor together.
class Grouping {
 public:
  Grouping(Basins& basins, double tolerance)
      : basins_(basins), tolerance_(tolerance), columns_(basins.columns.size()) {
    for (std::size_t j = 0; j < columns_; ++j) {
      range_.push_back(0.0);
      for (const StudyRow& row : basins.study.rows)
        if (is_bounded(row))
          range_.back() = std::max(range_.back(), row.values[first_mean + 2 * columns_ + j]);
    }
  }
  void place(const StudyRow& row) { basins_.attractor.push_back(number_of(row)); }

 private:
  static bool is_bounded(const StudyRow& row) {
    return row.state == PointState::completed && row.values[bounded_quantity] == 1.0;
  }
  int number_of(const StudyRow& row) {
    if (row.state == PointState::missing) return basin_missing;
    if (row.state == PointState::failed) return basin_failed;
    if (!is_bounded(row)) return basin_unbounded;
    const double* mean = row.values.data() + first_mean;
    const double* scatter = mean + columns_;
    const auto period = static_cast<std::size_t>(row.values[period_quantity]);
    for (std::size_t a = 0; a < basins_.attractors.size(); ++a)
      if (is_same(basins_.attractors[a], period, mean, scatter)) {
        ++basins_.attractors[a].starts;
        return static_cast<int>(a);
      }
    basins_.attractors.push_back({.period = period,
                                  .mean = {mean, mean + columns_},
                                  .scatter = {scatter, scatter + columns_},
                                  .starts = 1,
                                  .first = row.point});
    return static_cast<int>(basins_.attractors.size()) - 1;
  }
  bool is_same(const Attractor& a, std::size_t period, const double* mean,
               const double* scatter) const {
    if (a.period != period) return false;
    for (std::size_t j = 0; j < columns_; ++j) {
      double d = mean[j] - a.mean[j];
      if (is_angle_column(basins_.columns[j])) d = std::remainder(d, 2.0 * pi);
      double near = tolerance_ * range_[j];
      if (period == 0) near = std::max({near, a.scatter[j], scatter[j]});
      if (!(std::abs(d) <= near)) return false;
    }
    return true;
  }

  Basins& basins_;
  double tolerance_;
  std::size_t columns_;
  std::vector<double> range_;
};

}  // namespace

Table Basins::table() const {
  Table table;
  table.add_column("point", "");
  for (const StudyAxis& axis : study.points.axes())
    table.add_column(axis.name, axis.unit, axis.words);
  table.add_column("attractor", "");
  table.add_column("period", "");
  for (std::size_t i = 0; i < attractor.size(); ++i) {
    if (attractor[i] == basin_missing) continue;
    double* cell = table.append();
    *cell++ = static_cast<double>(i);
    for (std::size_t a = 0; a < study.points.axes().size(); ++a)
      *cell++ = study.points.coordinate(i, a);
    *cell++ = attractor[i] == basin_failed ? std::numeric_limits<double>::quiet_NaN()
                                           : static_cast<double>(attractor[i] + 1);
    *cell = attractor[i] >= 0
                ? static_cast<double>(attractors[static_cast<std::size_t>(attractor[i])].period)
                : 0.0;
  }
  return table;
}

Basins basins(const ModelOfStart& model, const StudyPoints& grid, const BasinOptions& options) {
  require_positive("basins", "tolerance", options.tolerance, "");
  require_positive("basins", "bound", options.bound, "");
  if (grid.size() == 0) throw ModelError("basins: the grid has no points");
  Basins all;
  const SectionedModel first = model(StudyPoint(grid, 0));
  first.section.check(first.model);
  all.columns = options.map.columns.empty() ? free_coordinates(first.model) : options.map.columns;
  std::erase(all.columns, "t_s");
  if (first.section.kind == SectionKind::event) {
    all.columns.emplace_back("speed_m_per_s");
    all.columns.emplace_back("penetration_m");
  }
  std::vector<StudyQuantity> quantities{{"bounded"}, {"period"}};
  for (const std::string& name : all.columns) quantities.push_back({"mean." + name});
  for (const std::string& name : all.columns) quantities.push_back({"scatter." + name});
  for (const std::string& name : all.columns) quantities.push_back({"range." + name});
  all.study = run_study(
      grid, std::move(quantities),
      [&](const StudyPoint& point) { return outcome_of(model(point), options); }, options.study);
  Grouping grouping(all, options.tolerance);
  for (const StudyRow& row : all.study.rows) grouping.place(row);
  return all;
}

}  // namespace yoke
