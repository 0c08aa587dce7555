// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Pendulums with known motion, written as a user would.
#pragma once

#include <yoke/core/model.hpp>

namespace yoke::cases {

/// A01 of the IFToMM library of multibody benchmarks: a point mass of 1 kg on a massless rod of
/// 1 m, released at rest to the right of the pivot; g = 9.81 m/s^2. Body "mass", joint "rod".
Model point_pendulum();

/// A uniform rod of 1 m and 1 kg, released horizontal. Body "rod", joint "pivot".
Model rod_pendulum();

/// Two such rods in a row. Bodies "a", "b", joints "pivot", "elbow".
Model double_pendulum();

}  // namespace yoke::cases
