// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The checkpoints of one run: when the next one is due, and writing it. The schedule belongs to the
// result, as the integrator starts afresh at each of them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <yoke/integrators/run/checkpoint.hpp>

namespace yoke {

class RunCheckpoints {
 public:
  /// None, until one of the next two is called; `t_start` [s] is where the schedule begins.
  RunCheckpoints(const SimulationOptions& options, double t_start);
  /// A new run of the model with this fingerprint. Throws OutputError.
  void begin(std::uint64_t model);
  /// A run that goes on behind `existing`. Throws OutputError.
  void resume(const Checkpoint& existing);

  bool wanted() const { return writer_ != nullptr; }
  /// [s] The end of the run or the next checkpoint by time, whichever is first.
  double next_stop() const;
  bool due(double t) const;
  /// The run has started afresh at an event.
  void count_event() { ++events_since_; }
  /// `c` holds where the run is; what was asked and the schedule are filled in. Throws OutputError.
  void write(Checkpoint c, const Result& result);

 private:
  const SimulationOptions& options_;
  double t_start_;
  std::uint64_t model_ = 0;
  std::unique_ptr<CheckpointWriter> writer_;
  long next_time_ = 1;     // number of the next checkpoint by time
  long events_since_ = 0;  // restarts at events since the last one
};

/// Throws ModelError where a schedule by time would write more checkpoints in `duration` [s] than
/// any run is worth.
void check_checkpoint_interval(double every, double duration);
/// Empty, or what is to be said of checkpoints `every` [s] in `duration` [s] that take `seconds`
/// each: how long they will take, and an interval that makes sense.
std::string checkpoint_cost(double every, double duration, double seconds);

/// What was asked of the run that wrote `c` into `folder`.
SimulationOptions options_of(const Checkpoint& c, const std::filesystem::path& folder);

}  // namespace yoke
