// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Whether a run that has stopped gets on from there if less is asked of it: then its tolerance was
// too tight.
#pragma once

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/state.hpp>
#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke {

/// From `there`, the last good state, with `options`, for at least a million times `last_step` [s]
/// or up to an event. `dynamics` is left anywhere.
bool gets_on(const FormulationEntry& entry, Dynamics& dynamics, const State& there,
             const SimulationOptions& options, double last_step);

}  // namespace yoke
