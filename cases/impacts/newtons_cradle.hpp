// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The strike in Newton's cradle as an impact of a collinear chain: what the case is compared with.
#pragma once

#include <vector>

#include <yoke/contact/laws/law.hpp>

namespace yoke::cases {

/// Equal discs in a row with a force between neighbours that depends on the penetration alone.
struct CollinearChain {
  ElasticLaw law;
  double mass = 0.0;  // [kg] of each
  double gap = 0.0;   // [m] >= 0 between neighbours before the strike
};

/// [m/s] of each disc behind the strike, when all are apart for good. `v` [m/s] before it: the same
/// for the discs that strike, the first ones, and 0 for the others. Nothing if they do not part.
std::vector<double> velocities_behind_strike(const CollinearChain& chain,
                                             const std::vector<double>& v);

}  // namespace yoke::cases
