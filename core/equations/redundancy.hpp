// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Tells apart the three reasons for a singular Jacobian at an assembled pose: equations that say
// the same everywhere (redundant: they may be left out), a singular position (the rank is smaller
// only there), and equations that agree at this pose only (in conflict beside it). For set-up.
#pragma once

#include <string>
#include <vector>

#include <yoke/core/equations/rank.hpp>
#include <yoke/core/equations/system.hpp>
#include <yoke/core/state.hpp>

namespace yoke {

/// Components of a joint's reaction that do not follow from the motion, because another set of
/// reactions moves the mechanism in the same way (Wojtyra, Multibody System Dynamics 14, 2005).
struct ReactionDoubt {
  std::size_t constraint = 0;  // index into System::joints()
  bool fx = false, fy = false, moment = false;
};

struct Redundancy {
  RankAnalysis here;           // at the pose given
  std::vector<int> redundant;  // rows to be left out for good; empty: none
  int rank = 0;                // of all equations, off singular positions
  bool singular_here = false;  // the rank is smaller at the pose given
  std::vector<ReactionDoubt> doubts;
  std::string conflict;  // not empty: why the equations cannot hold together
};

/// At a pose that satisfies all equations. Looks beside it, at poses drawn with fixed seeds.
Redundancy analyse_redundancy(System& system, const State& state);

/// "'motor: angle', 'pivot: x'": the equations row depends on, at most five.
std::string partners_of(const System& system, const RankAnalysis& analysis, int row);

/// Names of the columns of the reactions in doubt: "pivot.fx_N".
std::vector<std::string> column_names(const System& system, const std::vector<ReactionDoubt>&);

}  // namespace yoke
