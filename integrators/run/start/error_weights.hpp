// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Natural scales of a model and the absolute error weights made from them. No weight depends on
// where the origin is or how often anything has turned.
#pragma once

#include <yoke/core/equations/system.hpp>
#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke {

/// Length: the user's or System::natural_length. Time: the user's, or one over the fastest rate
/// seen at the start (velocities, accelerations over the length), and not longer than the run.
Scales choose_scales(const System& system, const State& state, const SimulationOptions& options);

/// Positions: tolerance x length, or for bodies in contact tolerance x sqrt(length x penetration
/// scale), so that a penetration is resolved; angles: x 1 rad; velocities: over the time scale;
/// element states: x the scale their element gives.
Tolerances choose_tolerances(const System& system, const SimulationOptions& options);

/// The same for a run from `state`: energies not below rounding of what they are now and of the
/// work that drivers exchange with stiff forces. Throws ModelError for a baumgarte_rate that leaves
/// nothing but rounding.
Tolerances choose_tolerances(System& system, const State& state, const SimulationOptions& options);

}  // namespace yoke
