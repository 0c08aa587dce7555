// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Two numbers in one register: what is done alike for both rows of a joint takes one instruction for both.
#pragma once

#include <Eigen/Core>

namespace yoke {

using Pair = Eigen::Array2d;

inline Pair pair_at(const double* p) { return Eigen::Map<const Pair>(p); }
inline void put(double* p, const Pair& x) { Eigen::Map<Pair>{p} = x; }
/// First the second.
inline Pair swapped(const Pair& x) { return {x[1], x[0]}; }

}  // namespace yoke
