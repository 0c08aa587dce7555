// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// linearise() without assembling: with the velocities and multipliers that the state has.
#pragma once

#include <span>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/analyses/modes.hpp>

namespace yoke {

/// Throws ModelError for a model larger than largest_linearisation.
void check_linearisable(const Model& model);
/// `share` [forces] as in calc_tangent().
Linearisation linearise_at(Dynamics& dynamics, const State& state,
                           std::span<const double> share = {});
/// The sparse matrices alone: basis, basis_rate, C_reduced, K_reduced and A are empty.
Linearisation linearise_sparse(Dynamics& dynamics, const State& state,
                               std::span<const double> share = {});
/// Empty, or what moves or is accelerated most in comparison with `rate` [1/s].
std::string restlessness(const System& system, const State& state, double rate);

}  // namespace yoke
