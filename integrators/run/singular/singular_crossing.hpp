// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Crossing singular positions, whatever the formulation. Where constraint equations become
// dependent for an instant (a parallelogram with all links in line) the motion is smooth, but the
// multipliers grow without bound, errors of a step are amplified by the same factor, and adaptive
// steps run to zero. A run is therefore guarded:
//
//   watch    after every accepted step, Dynamics::independence(): m, which falls like the square of
//            the distance to the singular position. No look at mechanisms without closed loops.
//            Steps that move the mechanism far (`longest_part`) are looked into on the dense
//            output; one that has passed a singular position is taken back.
//   leave    the formulation when m is a small part of the largest seen (`near`), or heads for zero
//            within the next steps (`look_ahead`) and not past it (`missed`), or the formulation fails
//            with m small (`troubled`).
//   cross    with Gauss' collocation, 6 stages, order 12. Its stages lie beside the ends of a step,
//            and each is projected on positions and velocities before accelerations are asked for,
//            so nothing is evaluated off the constraints. A stage or end too close to the singular
//            position (`too_close`) moves by a change of the step. A method of 4 stages controls
//            the error of the steps, which are never shorter on its account than a share of the
//            time scale (`shortest_apart`, in contact `shortest_touching`).
//   return   to the formulation when m has doubled, with energy before and after compared. All
//            minima of m met on the way are recorded, if it has vanished there.
//
// Contacts and events inside the crossing are located on the collocation polynomial as elsewhere.
//
// Where equations were left out as redundant, it also watches them (they may turn out to be in
// conflict later: the run then ends with a ModelError that names the equation), and it chooses
// again which to leave out when those kept become dependent but others are not.
#pragma once

#include <functional>
#include <memory>

#include <yoke/core/result.hpp>
#include <yoke/integrators/formulations/formulation.hpp>

namespace yoke {

/// A formulation guarded as described above, or the bare one if there is nothing to guard.
/// `record` is called for every singular position that was crossed. `largest`: the independence seen so far in the run,
/// 0 before it begins; kept up to date, as it tells what is small.
std::unique_ptr<Formulation> guard_singular_positions(
    const FormulationEntry& entry, Dynamics& dynamics, const Tolerances& tolerances,
    std::function<void(const SingularPosition&)> record, double& largest);

}  // namespace yoke
