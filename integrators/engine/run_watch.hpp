// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Sees what a run does, step by step: for equations that are carried along it. What it throws ends the
// run with its text.
#pragma once

#include <vector>

#include <yoke/integrators/formulations/formulation.hpp>

namespace yoke {

class RunWatch {
 public:
  virtual ~RunWatch() = default;
  /// Before the first step, and before controllers sample there: `state` is consistent.
  virtual void start(const State& state, const System& system) = 0;
  /// From where the last step ended up to `t` [s]: the formulation shows any time between them.
  /// Contacts and parameters were those of `memory`. `at_event`: an event is there.
  virtual void step(Formulation& formulation, const State& memory, double t, bool at_event) = 0;
  /// The slots `fired` have changed a contact's memory, a parameter or velocities. Both states are on
  /// the constraints; `before` has its accelerations, `after` not yet.
  virtual void jump(const State& before, const std::vector<int>& fired, const State& after) = 0;
  /// Controllers are going to sample.
  virtual void sample(const State& state) = 0;
};

}  // namespace yoke
