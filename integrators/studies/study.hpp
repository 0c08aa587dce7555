// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A study: a function of many points, on several threads, with a table of what it gave. The function may
// do anything, a run or none. Each point stands alone: one that fails is a row with its reason. The
// table is in the order of the points, so its bits do not depend on who computed what when. With a folder
// every row is kept on the disk as soon as it is there, and the same study there goes on after whatever
// ended it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <yoke/core/result.hpp>
#include <yoke/integrators/studies/points.hpp>

namespace yoke {

/// A number that the function of a study gives for each point; a column of its table.
struct StudyQuantity {
  std::string name;    // "peak_force"
  std::string unit{};  // as "m/s^2"; "": none
};

/// What the function gives for one point. An exception derived from std::exception is a failure too, with
/// its text as the reason.
struct StudyOutcome {
  std::vector<double> values{};  // of the quantities in their order; missing ones are nan
  std::string failure{};         // "": none; else one sentence
  bool unfinished = false;  // stopped from outside: no row; the point is left for the next time
};

/// Called on several threads at a time, once for each point that is left.
using StudyFunction = std::function<StudyOutcome(const StudyPoint&)>;

/// Whether a point has a row, and how it went.
enum class PointState { missing, completed, failed };

/// What a study has of one point.
struct StudyRow {
  std::size_t point = 0;                   // its index
  PointState state = PointState::missing;  // missing: it has no row yet
  std::vector<double> values{};  // as many as there are quantities, nan where there is none
  std::string reason{};          // of a failure, in one line
  double seconds = 0.0;          // [s] of the clock that it took
};

/// How far a study is.
struct StudyProgress {
  std::size_t total = 0;   // points
  std::size_t done = 0;    // that have a row
  std::size_t failed = 0;  // of these
  std::size_t reused = 0;  // of these, from the folder
  double elapsed = 0.0;    // [s] since the start
  double remaining = 0.0;  // [s] at the pace so far; nan: not known yet
};

/// What an executor has to do.
struct StudyWork {
  std::vector<std::size_t> points{};  // left to compute, by index, rising
  /// Computes one point, on any thread; does not throw.
  std::function<StudyRow(std::size_t)> compute{};
  /// Takes rows, from any thread and in any order. Throws OutputError.
  std::function<void(const std::vector<StudyRow>&)> deliver{};
  std::function<bool()> stopped{};  // asked before each point
};

/// Hands the points to whoever computes them, and returns when all is delivered or it was stopped.
using StudyExecutor = std::function<void(const StudyWork&)>;

/// On at most `jobs` threads of this process, the next point to whichever is free; < 1: one per processor.
StudyExecutor on_threads(int jobs);

/// How a study is done.
struct StudyOptions {
  int jobs = 0;                    // threads; 0: one per processor
  std::filesystem::path folder{};  // where the journal is kept; empty: in memory alone
  /// What the function computes, in words: a study with other words, points or quantities in the folder is
  /// not taken for this one.
  std::string identity{};
  std::function<void(const StudyProgress&)> observer{};  // called now and then, one call at a time
  std::function<bool()> stop{};  // true: no further points; what was computed is there
  StudyExecutor executor{};      // in place of threads
  /// False: this process only computes for another, by its executor. It keeps no journal and has no rows.
  bool leads = true;
};

/// The rows of a study.
struct StudyResult {
  StudyPoints points{};                     // as given
  std::vector<StudyQuantity> quantities{};  // as given
  std::vector<StudyRow> rows{};             // one for each point, in their order
  StudyProgress progress{};                 // at the end
  bool complete = false;                    // no row is missing

  /// The rows there are: point, coordinates (words as labels), quantities, state (a label). The names
  /// include units.
  Table table() const;
  /// The same with the reason of each failure, as CSV; words are text. Throws OutputError.
  void write_csv(const std::filesystem::path& path) const;
};

/// The name of the journal in the folder of a study.
inline constexpr const char* journal_name = "journal.tsv";

/// Computes what the folder does not have yet. Throws ModelError for points without axes, two columns of one
/// name, another study in the folder; OutputError for files that cannot be written and for a folder in
/// which another process works.
StudyResult run_study(StudyPoints points, std::vector<StudyQuantity> quantities,
                      const StudyFunction& function, const StudyOptions& options = {});

}  // namespace yoke
