// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Sees when a run gets nowhere: steps that no longer move the time, contacts that chatter.
#pragma once

#include <array>

namespace yoke {

/// A contact that opens and closes this often within one part in a million of the run makes no
/// progress any more.
constexpr long max_events_in_window = 2000;
constexpr double event_window = 1e-6;

class Standstill {
 public:
  /// Events counted since an instant [s].
  struct Window {
    double start = 0.0;
    long events = 0;
  };
  /// The run, or its continuation behind `window`, begins at `t` [s].
  void start(double t, Window window);
  /// The integrator begins afresh at `t`.
  void restart(double t);
  /// [s] Where the last step began or, after stalls(), ended.
  double t_last() const { return t_last_; }
  /// A step has come to `t`. IDA goes on for ever with steps that do not move the time.
  bool stalls(double t);
  /// An event has changed something at `t` in a run of `duration` [s].
  bool chatters(double t, double duration);
  const Window& window() const { return window_; }
  void note_step(double step);
  /// [s] The last three steps accepted, 0 where there were fewer.
  const std::array<double, 3>& last_steps() const { return last_steps_; }

 private:
  double t_last_ = 0.0;
  int stalled_steps_ = 0;
  Window window_;
  std::array<double, 3> last_steps_{};
};

}  // namespace yoke
