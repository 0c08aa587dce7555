// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a run writes, as tables of named columns, whatever the format of the file.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/core/model.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

/// What of a run is written.
struct OutputChoice {
  std::string format = "csv";                              // one of output_formats
  std::vector<std::string> columns{};                      // patterns with * and ?; empty: all
  std::size_t every = 1;                                   // rows: the first of so many
  double from = -std::numeric_limits<double>::infinity();  // [s] rows and events before: left out
  bool events_only = false;                                // no tables over time
};
inline constexpr const char* output_formats[] = {"csv", "hdf5", "mat"};

/// Throws ModelError for a format that is not known or was not built in.
void check_output_format(const std::string& format);

/// A column: numbers in memory at equal distances, or text of rows.
struct OutputColumn {
  std::string name;  // with its unit: "crank.x_m"
  std::string unit;  // "m/s^2"; "": none
  const double* first = nullptr;
  std::size_t step = 1;  // from one row to the next, in numbers
  double shift = 0.0;    // added
  std::function<std::string_view(std::size_t row)> text{};

  double number(std::size_t row) const {
    const double x = first[row * step];
    return shift == 0.0 ? x : x + shift;  // keeps -0
  }
};

/// Valid as long as what it was made of stays in place.
struct OutputTable {
  std::string name;  // "motion"
  std::vector<OutputColumn> columns{};
  std::size_t rows = 0;
};

/// The columns of a run: of its samples by their parts, where "motion" may be the case's own.
class SampleColumns {
 public:
  /// Of the samples of a model, whose names `header` has. Throws ModelError for a pattern without a
  /// column, naming what comes near.
  SampleColumns(const Table& header, const std::vector<MotionColumn>& own,
                const OutputChoice& choice);
  /// The rows of samples that the choice leaves.
  std::vector<OutputTable> tables(const Table& samples) const;

 private:
  struct Column {
    std::string table, name, unit;
    std::vector<std::string> labels;
    std::size_t source;
    double shift;
  };
  void add(const std::string& table, const Table& header, std::size_t source);
  void choose(const std::vector<std::string>& patterns);

  std::vector<Column> columns_;  // those of a table together, its time first
  OutputChoice choice_;
};

/// The samples of a model without rows, with all columns or those that fit one of the patterns.
Table sample_header(const Model& model, const std::vector<std::string>& patterns = {});

/// Events from a time [s] on.
OutputTable event_table(const std::vector<EventRecord>& events, double from);

}  // namespace yoke::cases
