// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What runs while a job runs: a progress line on a terminal, and Ctrl-C as a polite request to
// stop.
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include <yoke/integrators/simulate.hpp>
#include <yoke/integrators/studies/study.hpp>

namespace yoke::cases {

/// From now on Ctrl-C (SIGINT) and SIGTERM only set a flag; a second one ends the program at once.
/// A file that may not grow (SIGXFSZ) becomes an error of the write instead of the program's end.
void catch_signals();
/// True once the user has asked to stop.
bool interrupted();
/// Sets or clears the flag, as a signal would; for tests.
void set_interrupted(bool value);

/// Progress of several runs at a time on stderr: on a terminal one line with the simulated time, its
/// speed, contacts and the time that remains; elsewhere a plain line every ten seconds.
class ProgressLine {
 public:
  explicit ProgressLine(std::vector<std::string> names, bool shown = true);
  ~ProgressLine();

  /// Reports that run `index` has come to `fraction`. Any thread.
  void report(std::size_t index, double fraction) { report(index, {.fraction = fraction}); }
  void report(std::size_t index, const Progress& progress);
  /// An observer for simulate(): reports, and stops the run when interrupted.
  std::function<bool(const Progress&)> observer(std::size_t index);

 private:
  struct Line {
    std::string name{};
    double fraction = 0.0;
    double t = 0.0;          // [s] simulated
    double begun = -1.0;     // [s] on the clock
    std::size_t events = 0;  // looked at
    long contacts = 0;
  };
  void draw(double now);
  static std::string text_of(const Line& line, double now);

  std::vector<Line> lines_;
  std::mutex mutex_;
  double last_draw_;
  bool shown_, terminal_;
  bool drawn_ = false;
};

/// Progress of a study on stderr, in one line on a terminal, elsewhere a plain line every ten seconds:
/// "37 %, 370 of 1000 points, 2 failed, 12.5 points/s, 50 s left".
class StudyProgressLine {
 public:
  explicit StudyProgressLine(bool shown);
  ~StudyProgressLine() { clear(); }
  /// One call at a time.
  void report(const StudyProgress& progress);
  /// Takes the line away.
  void clear();

 private:
  double last_draw_;  // [s]
  bool shown_, terminal_;
  bool drawn_ = false;
};

}  // namespace yoke::cases
