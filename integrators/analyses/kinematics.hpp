// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Kinematic analysis: positions, velocities and accelerations of a mechanism whose drivers leave no
// degree of freedom, from the equations of the joints alone. Nothing is integrated: every row is
// exact to rounding. Forces do not matter.
#pragma once

#include <yoke/core/model.hpp>
#include <yoke/core/result.hpp>

namespace yoke {

/// Until when, how many rows, and what counts as nearly singular.
struct KinematicsOptions {
  double until = 0.0;  // [s] end time, > 0
  int samples = 1001;  // rows, uniform in time, both ends; >= 2
  /// Positions whose Dynamics::independence() falls below this are reported as nearly singular. It
  /// falls like the square of the distance: 1e-4 is about 0.01 rad from a singular position.
  double warn_below = 1e-4;
};

/// Columns: t_s, the nine of each body as in simulate(), and `independence`, between 0 (singular)
/// and 1, see Dynamics::independence(). `summary.singular_positions` lists the nearly singular
/// positions with time and equation. If the drivers run into a dead point the results up to there
/// are kept and the reason names time and equation (Stop::failed).
/// Throws ModelError if degrees of freedom remain, naming how many and of which bodies, for options
/// out of range, and if the start cannot be assembled.
Result kinematics(const Model& model, const KinematicsOptions& options);

}  // namespace yoke
