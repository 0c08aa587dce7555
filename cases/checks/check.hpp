// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a run of a case is compared with: a number found in it beside the number it should be, by a
// closed form, a balance or a count. Every run prints its checks and writes them to summary.json.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/core/result.hpp>

namespace yoke::cases {

struct Check {
  std::string what;        // "period"
  double value = 0.0;      // found in the run
  double expected = 0.0;   // 0 for the largest deviation from something
  std::string unit{};      // "s", or "" for a plain number
  double tolerance = 0.0;  // of |value - expected|, in the unit
  std::string remark{};    // where `expected` is from: "closed form"

  /// False also for a value that is not a number.
  bool within() const;
};

/// "period 2.00607 s, expected 2.00607 s within 1e-08 s (closed form)"; one outside its tolerance
/// says so.
std::string text_of(const Check& check);

/// A tolerance for numbers of size `scale` in a run: 1e3 times its relative tolerance. Errors of
/// the steps add up over a run.
double tolerance_of(const Result& run, double scale);

/// The worst imbalance of the energy ledger, which should be 0. Tolerated of what was exchanged or,
/// if it is more, of the kinetic energy: that is what a relative error of the velocities moves, also
/// where nothing is exchanged; or of `scale` [J], if that is more still.
Check energy_check(const Result& run, double scale = 0.0);

/// The largest difference of a column from what it should be, over all rows. The tolerance is
/// tolerance_of() the range of the expected values, or of `scale` where it is given.
Check deviation_check(std::string what, const Result& run, std::string_view column,
                      std::string unit, std::string remark,
                      const std::function<double(std::size_t row)>& expected, double scale = 0.0);

/// How far times found between rows may be off, over the period [s] of what is sampled: the error of
/// cubic interpolation of a sine, with room for its harmonics.
double interpolation_error(const Result& run, double period);

/// Times [s] at which a column rises through a level, by cubic interpolation between rows; `rate`
/// is the column of its derivative by time.
std::vector<double> rising_times(const Result& run, std::string_view column, std::string_view rate,
                                 double level = 0.0);
/// The same where it falls.
std::vector<double> falling_times(const Result& run, std::string_view column, std::string_view rate,
                                  double level = 0.0);

/// The same of a quantity that is no column: its values y and rates v at the times t of the rows.
std::vector<double> rising_times(const Eigen::VectorXd& t, const Eigen::VectorXd& y,
                                 const Eigen::VectorXd& v);

/// The mean distance of the times beside a period [s]; no check if there are fewer than two.
std::vector<Check> period_check(const Result& run, const std::vector<double>& times, double period);

}  // namespace yoke::cases
