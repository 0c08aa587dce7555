// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Which formulation runs when the user does not say.
#pragma once

#include <string>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/formulations/formulation.hpp>

namespace yoke {

struct Choice {
  std::string name;
  std::string reason;  // one sentence, for the summary
};

/// An explicit method is the most accurate for its work unless a force is so stiff that stability
/// and not accuracy bounds its step; then BDF. Stiffness is judged at `state`, to which `dynamics` is
/// bound: the fastest rate of all forces but contacts (whose impacts any method must resolve), from
/// damping over mass, the root of stiffness over mass, and the rates of element states; a coordinate without mass has that which joints tie
/// to it.
Choice choose_formulation(Dynamics& dynamics, const State& state, double relative_tolerance);

}  // namespace yoke
