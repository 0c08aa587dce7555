// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// When the events of a step happen: at the root the formulation located, or earlier, where another
// function crossed zero unnoticed because it came back within the step.
#pragma once

#include <vector>

#include <yoke/integrators/formulations/formulation.hpp>

namespace yoke {

class EventLocator {
 public:
  explicit EventLocator(System& system);
  /// [s] Instant of the first events of the step that `formulation` has just made from `from` [s];
  /// fired() are the slots. Overwrites `scratch` and leaves the system at its motion.
  double locate(Formulation& formulation, double from, State& scratch);
  const std::vector<int>& fired() const { return fired_; }

 private:
  double locate_crossing(Formulation& formulation, int slot, double from, State& scratch);

  System& system_;
  std::vector<double> values_;
  std::vector<int> fired_;
};

}  // namespace yoke
