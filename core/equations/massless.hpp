// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Bodies without mass or inertia. Joints must determine their motion: [M G^T; G 0] is regular only if
// no motion that the joints allow leaves everything at rest that has mass. Where a mechanism has such
// a motion everywhere, a body is free; where it has one at a single pose, a dead centre of the
// masses, that pose is an impasse of the equations of motion (Rabier, Rheinboldt, Theoretical and
// Numerical Analysis of Differential-Algebraic Equations, 2002): speeds of the massless bodies grow
// without bound on the way there, and no motion leads beyond it.
#pragma once

#include <string>
#include <vector>

#include <yoke/core/equations/system.hpp>
#include <yoke/core/state.hpp>

namespace yoke {

/// What one motion moves while everything that has mass rests.
struct MasslessMotion {
  struct Part {
    int body = 0;  // index into Model::bodies()
    bool turns = false, shifts = false;
  };
  std::vector<Part> parts;
};

/// The independent motions of that kind, for the blocks of G computed last, equations left out not
/// counted. `metric` is metric_of_lengths(). Motions count as such when less than `threshold` of
/// them, in this metric, is a violation of the joints or a motion of masses. Set-up and reports only.
std::vector<MasslessMotion> massless_motions(const System& system,
                                             const std::vector<double>& metric, double threshold);

/// Empty, or why the masses and joints do not determine the accelerations at `state`, where the
/// constraints hold: "'rod': no mass and free to turn", or that the pose is an impasse.
std::string undetermined_motion(System& system, const State& state,
                                const std::vector<double>& metric);

/// Empty, or "'crank' and 'rod', which have no mass, could move without any mass moving": the pose
/// is, as near as a run can come, an impasse.
std::string impasse_at(System& system, const State& state, const std::vector<double>& metric);

}  // namespace yoke
