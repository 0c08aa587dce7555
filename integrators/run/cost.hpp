// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The counters of a run, of its steps and of its samples apart, over checkpoints and continuations.
#pragma once

#include <chrono>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/result.hpp>
#include <yoke/integrators/formulations/formulation.hpp>

namespace yoke {

/// Work on the equations of motion.
struct Work {
  long evaluations = 0, refactorisations = 0, fresh = 0;
  Work operator-(const Work& o) const;
  void operator+=(const Work& o);
};
Work work_of(const Dynamics& dynamics);

/// The wall time counts from the construction.
class RunCost {
 public:
  /// Goes on counting behind `before`.
  void resume(const Summary& before);
  /// Work of `dynamics` that was done for samples.
  void book_recording(const Work& done) { recording_ += done; }
  /// Steps accepted until now.
  long steps(const Formulation& formulation) const;
  /// Writes the counters and the wall time.
  void write(const Dynamics& dynamics, const Formulation& formulation, Summary& summary) const;
  /// At a checkpoint, before the formulation is made anew: `summary` as write() has left it.
  void close(const Dynamics& dynamics, const Summary& summary);

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point began_ = Clock::now();
  double wall_time_before_ = 0.0;  // [s] of the run that is gone on with
  Summary before_;                 // counters up to the last checkpoint
  Work work_before_;               // by then
  Work recording_;                 // for samples, since then
};

}  // namespace yoke
