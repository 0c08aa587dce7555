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

namespace yoke::cases {

/// From now on Ctrl-C (SIGINT) and SIGTERM only set a flag; a second one ends the program at once.
/// A file that may not grow (SIGXFSZ) becomes an error of the write instead of the program's end.
void catch_signals();
/// True once the user has asked to stop.
bool interrupted();
/// Sets or clears the flag, as a signal would; for tests.
void set_interrupted(bool value);

/// Progress of several runs at a time, as one line on stderr if that is a terminal.
class ProgressLine {
 public:
  explicit ProgressLine(std::vector<std::string> names);
  ~ProgressLine();

  /// Reports that run `index` has come to `fraction`. Any thread.
  void report(std::size_t index, double fraction);
  /// An observer for simulate(): reports, and stops the run when interrupted.
  std::function<bool(const Progress&)> observer(std::size_t index);

 private:
  void draw();

  std::vector<std::string> names_;
  std::vector<double> fractions_;
  std::mutex mutex_;
  double last_draw_ = -1.0;
  bool terminal_;
  bool drawn_ = false;
};

}  // namespace yoke::cases
