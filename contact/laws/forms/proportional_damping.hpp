// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the laws F = F_e (1 + X d'/v_i) share: most published laws, which differ only in the number
// X(e) they put in front of the approach velocity v_i.
//
// A free central impact m d'' = -F_e (1 + X d'/v_i) can be integrated once whatever F_e: with
// u = d'/v_i, m v_i^2 u du/(1 + X u) = -F_e dd, and both ends have d = 0, so
//   X (1 + e) = ln((1 + X)/(1 - e X))
// for the restitution e delivered. It depends on X alone: not on F_e, the mass or the speed. The
// force never pulls in a free impact, since 1 - e X > 0.
//
// The floor on v_i. A contact that begins at rest has v_i = 0, and the damping would be infinite.
// Below `slowest_approach` the damping stays that of the floor, so slower impacts tend to e = 1. A
// contact that lasts keeps the damping F_e X/v_i [N s/m] of the impact that began it, at most that
// of the floor; for contacts that mostly last a constant alpha (HuntCrossley) means more.
#pragma once

#include <algorithm>
#include <string_view>

#include <yoke/contact/laws/law.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

/// Least e of laws whose damping is infinite at e = 0.
inline constexpr double least_restitution = 1e-3;

/// F = F_e (1 + X d'/v_i) with the floor on v_i.
inline ContactOutput damped_by_approach(const ContactInput& in, const ElasticLaw& elastic, double X,
                                        double slowest_approach) {
  const double v_i = std::max(in.memory.approach_velocity, slowest_approach);
  return damped_in_proportion(elastic.response(in.penetration), X / v_i, in.rate);
}

/// Throws ModelError unless `least_e` <= e <= 1 and the floor of the approach velocity is positive.
inline void check_damped_by_approach(std::string_view owner, double e, double least_e,
                                     double slowest_approach) {
  require_range(owner, "e", e, least_e, 1.0);
  require_positive(owner, "slowest_approach", slowest_approach, "m/s");
}

/// The e delivered with X >= 0: root of X (1 + e) = ln((1 + X)/(1 - e X)).
double restitution_of_damping(double X);

/// The X >= 0 that delivers e, 0 < e <= 1: the same equation solved for X.
double damping_for_restitution(double e);

}  // namespace yoke
