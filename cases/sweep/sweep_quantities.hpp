// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a sweep asks of each run: numbers of its summary, of its contacts, of any column over time. What a user
// writes after --measure is COLUMN:max, :min, :range, :mean, :rms, :final, or COLUMN:at=TIME; mean and rms are
// over time.
#pragma once

#include <string>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/cases/jobs/law_run.hpp>
#include <yoke/integrators/studies/study.hpp>

namespace yoke::cases {

/// Quantities of every sweep: first those of the mechanism, then those of how it was computed.
inline constexpr std::size_t mechanism_quantities = 6, solver_quantities = 14;

/// One number of a column over time.
struct SweepMeasure {
  std::string column;  // with its unit: "slider_x_m"
  std::string how;     // "max", "min", "range", "mean", "rms", "final", "at"
  double at = 0.0;     // [s]
  StudyQuantity quantity{};
};

/// The quantities of a sweep: those that every sweep has, then the measures. Whatever a run lacks is nan.
class SweepQuantities {
 public:
  /// `measures` as typed; `turn` is the column whose angle counts turns, "": those of the bodies that drivers
  /// move; `from` [s] is where contacts, energy and measures begin to count. `model` is that of the first
  /// point, `own` its columns. Throws ModelError for a column that this model does not have.
  SweepQuantities(const std::vector<std::string>& measures, const std::string& turn, double from,
                  const Model& model, const std::vector<MotionColumn>& own);
  const std::vector<StudyQuantity>& all() const { return all_; }
  std::vector<double> of(const LawRun& run) const;

 private:
  SweepMeasure parse(const std::string& text, const Table& header,
                     const std::vector<MotionColumn>& own) const;
  double turns_of(const Table& rows) const;

  std::vector<StudyQuantity> all_;
  std::vector<SweepMeasure> measures_;
  std::vector<std::string> turning_;  // columns of angles
  double from_;
};

/// Of rows from a time [s] on, by the trapezoidal rule where an integral is meant; nan if there is no row.
/// `how` as SweepMeasure::how; `at` is linear between rows, nan outside them.
double measure(const Table& rows, const std::string& column, const std::string& how, double at,
               double from);

}  // namespace yoke::cases
