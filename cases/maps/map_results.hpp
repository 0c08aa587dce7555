// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What maps write and print alike.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include <yoke/cases/jobs/plot.hpp>
#include <yoke/cases/jobs/progress.hpp>
#include <yoke/cases/maps/section_choice.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

/// The picture, if asked for and there are points; returns what to tell the user, "" if nothing.
std::string draw_map(const MapRequest& request, const Figure& figure, std::size_t points);

/// A line of progress that knows since when.
class MapProgress {
 public:
  explicit MapProgress(bool shown);
  /// One call at a time.
  void report(std::size_t done, std::size_t total);
  void clear() { line_.clear(); }

 private:
  StudyProgressLine line_;
  std::chrono::steady_clock::time_point start_;
};

/// "  mass.x_m   0.01 to 0.02" a line for each column from `first` on.
void print_ranges(const Table& points, std::size_t first);

/// "period 3", "no period within 200 points".
std::string period_text(std::size_t period, std::size_t points);

/// The last line: where the results are.
void print_files(const MapRequest& request, const std::string& files, const std::string& plots);

}  // namespace yoke::cases
