// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// How sharply a piece of a curve bends, at most, wherever that is.
#pragma once

#include <yoke/core/curves/curve.hpp>

namespace yoke {

/// Least and greatest curvature [1/m], > 0 to the left, and where they are.
struct BendRange {
  double low = 0.0, high = 0.0;      // [1/m]
  double u_low = 0.0, u_high = 0.0;  // where, within the piece
};

/// Between two places u of a piece.
BendRange bend_range(const CurvePiece& piece, double from, double to);

}  // namespace yoke
