// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// How far a run is from what is known: closed forms and tables.
#pragma once

#include <algorithm>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <limits>
#include <string_view>

#include <yoke/cases/validation/benchmark_values.hpp>
#include <yoke/core/result.hpp>
#include <yoke/core/types.hpp>

namespace yoke::cases {

/// psi'' = -w^2 sin(psi), psi from the lowest position, by Jacobi's elliptic functions. Swinging
/// and turning over alike; not the motion between them that takes for ever.
class PendulumMotion {
 public:
  struct Point {
    double angle, rate, acceleration;  // [rad], [rad/s], [rad/s^2]
  };

  PendulumMotion(double w, double angle, double rate)
      : w_(w),
        // sin(psi/2) = a sn, psi'/(2 w) = a cn while it swings; a > 1: it turns over.
        a_(std::hypot(std::sin(0.5 * angle), rate / (2.0 * w))),
        sense_(rate < 0.0 ? -1.0 : 1.0) {
    using boost::math::ellint_1;
    modulus_ = turns_over() ? 1.0 / a_ : a_;
    quarter_ = ellint_1(modulus_);
    u_ = turns_over() ? ellint_1(modulus_, 0.5 * angle)
                      : ellint_1(modulus_, std::atan2(std::sin(0.5 * angle), rate / (2.0 * w)));
  }

  bool turns_over() const { return a_ > 1.0; }
  /// [s] of a full swing or turn.
  double period() const { return turns_over() ? 2.0 * quarter_ / (a_ * w_) : 4.0 * quarter_ / w_; }

  Point at(double t) const {
    const double u = u_ + (turns_over() ? sense_ * a_ : 1.0) * w_ * t;
    // By whole periods to arguments where the functions keep their digits.
    const double half_turns = 2.0 * std::round(u / (4.0 * quarter_));
    double cn = 1.0;
    const double sn = boost::math::jacobi_elliptic(modulus_, u - 2.0 * quarter_ * half_turns, &cn,
                                                   static_cast<double*>(nullptr));
    // dn of the library loses its digits where cn = 0.
    const double m = modulus_ * modulus_, dn = std::sqrt((1.0 - m) + m * cn * cn);
    Point p{};
    if (turns_over()) {
      p.angle = 2.0 * (half_turns * pi + std::atan2(sn, cn));
      p.rate = sense_ * 2.0 * w_ * a_ * dn;
    } else {
      p.angle = 2.0 * std::asin(modulus_ * sn);
      p.rate = 2.0 * w_ * modulus_ * cn;
    }
    p.acceleration = -w_ * w_ * std::sin(p.angle);
    return p;
  }

 private:
  double w_, a_, sense_, modulus_ = 0.0, quarter_ = 0.0, u_ = 0.0;
};

/// Largest errors of a run. NaN: nothing to compare with, or the run did not get there.
struct BenchmarkErrors {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double position = none;      // [m, rad]
  double velocity = none;      // over the largest velocity
  double acceleration = none;  // over the largest acceleration
  double reaction = none;      // over the largest force, and the largest moment
};

/// Collects differences by what the name of a column says it is.
class Comparison {
 public:
  void add(std::string_view column, double value, double expected) {
    Worst& worst = worst_of(column);
    worst.difference = std::max(worst.difference, std::abs(value - expected));
    worst.largest = std::max(worst.largest, std::abs(expected));
    worst.any = true;
  }

  BenchmarkErrors errors() const {
    return {.position = larger(lengths_.absolute(), angles_.absolute()),
            .velocity = larger(velocities_.relative(), rates_.relative()),
            .acceleration = larger(accelerations_.relative(), rate_rates_.relative()),
            .reaction = larger(forces_.relative(), moments_.relative())};
  }

 private:
  struct Worst {
    double difference = 0.0, largest = 0.0;
    bool any = false;
    double absolute() const { return any ? difference : BenchmarkErrors::none; }
    /// Of moments that are to vanish nothing relative can be said.
    double relative() const { return largest > 0.0 ? difference / largest : BenchmarkErrors::none; }
  };
  static double larger(double a, double b) { return std::fmax(a, b); }  // ignores a NaN

  Worst& worst_of(std::string_view column) {
    if (column.ends_with("_N")) return forces_;
    if (column.ends_with("_N_m")) return moments_;
    if (column.ends_with("_m_per_s2")) return accelerations_;
    if (column.ends_with("_rad_per_s2")) return rate_rates_;
    if (column.ends_with("_m_per_s")) return velocities_;
    if (column.ends_with("_rad_per_s")) return rates_;
    return column.ends_with("_rad") ? angles_ : lengths_;
  }

  Worst lengths_, angles_, velocities_, rates_, accelerations_, rate_rates_, forces_, moments_;
};

/// A run against a table. Rows the run did not get to make all errors NaN.
inline BenchmarkErrors compare(const Result& run, const ReferenceTable& table) {
  const Eigen::VectorXd t = run["t_s"];
  Comparison comparison;
  for (const ReferenceRow& row : table.rows) {
    Eigen::Index i = 0;
    while (i < t.size() && std::abs(t[i] - row.t) > 1e-9 * row.t) ++i;
    if (i == t.size()) return {};
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      const std::size_t column = run.samples.index(table.columns[k]);
      comparison.add(table.columns[k], run.samples.value(static_cast<std::size_t>(i), column),
                     row.values[k]);
    }
  }
  return comparison.errors();
}

}  // namespace yoke::cases
