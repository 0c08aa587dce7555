// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/checks/check.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <yoke/core/types.hpp>

namespace yoke::cases {

bool Check::within() const { return std::abs(value - expected) <= tolerance; }

std::string text_of(const Check& c) {
  // A deviation has no digits to compare.
  const std::string value =
      c.expected == 0.0 ? fmt::format("{:.2g}", c.value) : fmt::format("{:.9g}", c.value);
  const std::string unit = c.unit.empty() ? "" : " " + c.unit;
  std::string text =
      fmt::format("{} {}{}, expected {:.9g}{}", c.what, value, unit, c.expected, unit);
  if (c.tolerance > 0.0) text += fmt::format(" within {:.2g}{}", c.tolerance, unit);
  if (!c.remark.empty()) text += fmt::format(" ({})", c.remark);
  if (!c.within())
    text += fmt::format(": OUTSIDE, by {:.2g}{}", std::abs(c.value - c.expected), unit);
  return text;
}

double tolerance_of(const Result& run, double scale) {
  return 1e3 * run.summary.relative_tolerance * scale;
}

namespace {

/// [J] The last places of the energies that are added up.
double rounding_of_energies(const Result& run) {
  double size = 0.0;
  for (const char* name : {"kinetic_J", "potential_J", "stored_J"}) {
    if (!run.samples.has(name)) continue;
    size += run[name].cwiseAbs().maxCoeff();
  }
  return 16.0 * std::numeric_limits<double>::epsilon() * size;
}

}  // namespace

Check energy_check(const Result& run, double scale) {
  const double exchanged = run.summary.energy_exchanged;
  const double kinetic = run.samples.rows() > 0 ? run["kinetic_J"].maxCoeff() : 0.0;
  return {.what = "imbalance of the energy",
          .value = run.summary.energy_balance,
          .unit = "J",
          .tolerance = std::max(tolerance_of(run, std::max({exchanged, kinetic, scale})),
                                rounding_of_energies(run)),
          .remark = fmt::format(
              "of {:.3g} J exchanged{}", exchanged,
              kinetic > exchanged ? fmt::format(", {:.3g} J kinetic", kinetic) : std::string())};
}

Check deviation_check(std::string what, const Result& run, std::string_view column,
                      std::string unit, std::string remark,
                      const std::function<double(std::size_t)>& expected, double scale) {
  const std::size_t j = run.samples.index(column);
  double worst = 0.0, low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < run.samples.rows(); ++i) {
    const double should = expected(i);
    const double off = std::abs(run.samples.value(i, j) - should);
    if (!(off <= worst) && !std::isnan(worst)) worst = off;  // NaN comes and stays
    low = std::min(low, should);
    high = std::max(high, should);
  }
  return {.what = std::move(what),
          .value = worst,
          .unit = std::move(unit),
          .tolerance = tolerance_of(run, scale > 0.0 ? scale : high - low),
          .remark = std::move(remark)};
}

namespace {

/// Where the cubic through both ends of an interval of length h, with these values and slopes,
/// crosses zero; as a part of h. The value rises from < 0 to >= 0.
double zero_of_cubic(double h, double y0, double v0, double y1, double v1) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double s = 0.5 * (low + high), r = 1.0 - s;
    const double y =
        y0 * r * r * (1.0 + 2.0 * s) + y1 * s * s * (1.0 + 2.0 * r) + h * s * r * (v0 * r - v1 * s);
    (y < 0.0 ? low : high) = s;
  }
  return 0.5 * (low + high);
}

/// Where sense (y - level) rises through 0.
std::vector<double> crossing_times(const Result& run, std::string_view column,
                                   std::string_view rate, double level, double sense) {
  const Eigen::VectorXd y = run[column];
  return rising_times(run["t_s"], sense * (y.array() - level).matrix(), sense * run[rate]);
}

}  // namespace

std::vector<double> rising_times(const Eigen::VectorXd& t, const Eigen::VectorXd& y,
                                 const Eigen::VectorXd& v) {
  std::vector<double> times;
  for (Eigen::Index i = 1; i < t.size(); ++i) {
    const double h = t[i] - t[i - 1];
    if (y[i - 1] < 0.0 && y[i] >= 0.0)
      times.push_back(t[i - 1] + h * zero_of_cubic(h, y[i - 1], v[i - 1], y[i], v[i]));
  }
  return times;
}

std::vector<double> rising_times(const Result& run, std::string_view column, std::string_view rate,
                                 double level) {
  return crossing_times(run, column, rate, level, 1.0);
}

std::vector<double> falling_times(const Result& run, std::string_view column, std::string_view rate,
                                  double level) {
  return crossing_times(run, column, rate, level, -1.0);
}

double interpolation_error(const Result& run, double period) {
  const Eigen::VectorXd t = run["t_s"];
  const double step = 2.0 * pi / period * (t[t.size() - 1] - t[0]) /
                      static_cast<double>(std::max<Eigen::Index>(1, t.size() - 1));
  return 100.0 / 384.0 * std::pow(step, 4);
}

std::vector<Check> period_check(const Result& run, const std::vector<double>& times,
                                double period) {
  if (times.size() < 2) return {};
  return {{.what = "period",
           .value = (times.back() - times.front()) / static_cast<double>(times.size() - 1),
           .expected = period,
           .unit = "s",
           .tolerance = tolerance_of(run, period) + period * interpolation_error(run, period),
           .remark = "closed form"}};
}

}  // namespace yoke::cases
