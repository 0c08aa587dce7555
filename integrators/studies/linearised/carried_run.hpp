// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A run from a state with variations carried along.
#pragma once

#include <yoke/integrators/simulate.hpp>
#include <yoke/integrators/studies/linearised/carried_variation.hpp>

namespace yoke {

/// Throws ModelError for what can be told before the first step.
Result run_with(CarriedVariation& variation, const Model& model, const State& start,
                const SimulationOptions& options);

}  // namespace yoke
