// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What assembly has found out about the constraints of a model.
#pragma once

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/result.hpp>

namespace yoke {

/// 3 per body minus the rank of the constraints; after assembly.
int degrees_of_freedom(const Dynamics& dynamics);

/// Degrees of freedom, redundant equations and reactions that are not unique, into the summary.
void note_constraints(Dynamics& dynamics, Summary& summary);

/// The worst violations at a state that is projected, and at one that is not, into the summary.
void note_violation(Dynamics& dynamics, const State& state, Summary& summary);
void note_drift(Dynamics& dynamics, const State& state, Summary& summary);
/// The violations of one summary into another.
void copy_violations(const Summary& from, Summary& to);

}  // namespace yoke
