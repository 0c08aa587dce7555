// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What can be known to be wrong before a run starts. All throw ModelError naming the option, the
// state or the driver, the value and the range.
#pragma once

#include <yoke/core/equations/system.hpp>
#include <yoke/integrators/run/checkpoint.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke {

void check_options(const SimulationOptions& options, double t_start);
/// Asks every force element; a model needs a body.
void check_model(const Model& model);
/// Is `start` a state of this model, and finite?
void check_state(const Model& model, const State& start);
/// Does the checkpoint belong to this model and these options?
void check_checkpoint(const Model& model, const SimulationOptions& options,
                      const Checkpoint& checkpoint);
/// A driver's rate must be the derivative of its value, or it does work that nobody accounts for.
void check_drivers(System& system, const State& state, double until);

}  // namespace yoke
