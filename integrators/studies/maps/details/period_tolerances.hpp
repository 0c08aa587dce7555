// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// How much two points of a section may differ and be the same.
#pragma once

#include <vector>

#include <yoke/integrators/studies/maps/poincare.hpp>

namespace yoke {

/// For period_of(): of each column the part `options.period_tolerance` of its range, but no less than what the
/// run's own errors make, a hundred times its tolerance in the scales of the error weights. The time does not
/// count, nor does the penetration at events, which is rounding.
std::vector<double> period_tolerances(const Poincare& map, const std::vector<double>& range,
                                      const PoincareOptions& options);

/// Whether a column is an angle, of which turns do not count.
bool is_angle_column(const std::string& column);

}  // namespace yoke
