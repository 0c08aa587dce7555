// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The files of one run, in the format asked for: a CSV file for each table, or results.h5 or
// results.mat with all of them. results.h5 is there while the run goes on.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <yoke/cases/results/contact_spans.hpp>
#include <yoke/cases/results/hdf5_file.hpp>
#include <yoke/cases/results/output_table.hpp>

namespace yoke::cases {

class RunOutput {
 public:
  /// Nothing is written before watch() or finish().
  RunOutput(OutputChoice choice, std::filesystem::path folder);
  /// Of a run of `model` that will have `expected_rows` samples, of all columns or of those that fit
  /// `kept`. Throws ModelError for columns that are not there.
  void begin(const Model& model, const std::vector<MotionColumn>& own, std::size_t expected_rows,
             const std::vector<std::string>& kept = {});
  /// Takes what the run has so far, at most once a second, where the format allows it.
  void watch(const Result& so_far);
  /// Writes all tables. Throws OutputError naming the path.
  void finish(const Table& samples, const std::vector<EventRecord>& events,
              const std::vector<ContactSpan>& impacts, const std::string& summary);

 private:
  void write_hdf5(const std::vector<OutputTable>& tables, const std::string& summary) const;

  OutputChoice choice_;
  std::filesystem::path folder_;
  std::optional<SampleColumns> columns_;
  std::size_t expected_rows_ = 0;
  std::unique_ptr<Hdf5File> growing_;
  double last_ = 0.0;  // [s] when it was watched
};

/// Contacts from onset to release, of those that begin at a time [s] or later.
OutputTable impact_table(const std::vector<ContactSpan>& impacts, double from);

}  // namespace yoke::cases
