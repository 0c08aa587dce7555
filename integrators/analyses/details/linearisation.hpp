// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// linearise() without assembling: with the velocities and multipliers that the state has.
#pragma once

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/analyses/modes.hpp>

namespace yoke {

Linearisation linearise_at(Dynamics& dynamics, const State& state);

}  // namespace yoke
