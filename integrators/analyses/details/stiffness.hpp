// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The stiffness of a mechanism at rest, which says whether it is stable.
#pragma once

#include <Eigen/Core>
#include <optional>

#include <yoke/integrators/analyses/details/rest_equations.hpp>

namespace yoke {

/// Against motions that the joints allow, in the metric of the masses.
struct Stiffness {
  double lowest = 0.0;       // [1/s^2] smallest eigenvalue
  int negatives = 0;         // eigenvalues below zero, beyond rounding
  bool neutral = false;      // a motion without stiffness
  Eigen::VectorXd soft;      // [n] the softest motion
  Eigen::VectorXd way_down;  // [n] the motion of the lowest stiffness
  bool negative() const { return negatives > 0; }
};

/// At rest at `state`, the loads as they are set in `statics`. None for a model that cannot move or
/// one larger than largest_linearisation.
std::optional<Stiffness> stiffness_at(Statics& statics, const State& state);

}  // namespace yoke
