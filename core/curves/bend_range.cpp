// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/curves/bend_range.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace yoke {

namespace {

/// The place of the greatest sign * curvature near the middle one of three.
double sharpest(const CurvePiece& piece, double sign, double low, double high) {
  constexpr double golden = 0.381966011250105;
  for (int i = 0; i < 60 && high > low; ++i) {
    const double left = low + golden * (high - low), right = high - golden * (high - low);
    if (sign * piece.at(left).curvature > sign * piece.at(right).curvature)
      high = right;
    else
      low = left;
  }
  return 0.5 * (low + high);
}

}  // namespace

BendRange bend_range(const CurvePiece& piece, double from, double to) {
  // A table of polynomials has one for each unit of u; lines and arcs do not bend more anywhere.
  const int parts = static_cast<int>(std::clamp(8.0 * std::ceil(std::abs(to - from)), 64.0, 4e4));
  const auto place = [&](int k) { return from + (to - from) * k / parts; };
  std::vector<double> curvature;
  for (int k = 0; k <= parts; ++k) curvature.push_back(piece.at(place(k)).curvature);
  BendRange range{std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity()};
  const auto consider = [&](double u) {
    const double k = piece.at(u).curvature;
    if (k < range.low) range.low = k, range.u_low = u;
    if (k > range.high) range.high = k, range.u_high = u;
  };
  for (int k = 0; k <= parts; ++k) {
    consider(place(k));
    if (k == 0 || k == parts) continue;
    const std::size_t i = static_cast<std::size_t>(k);
    const double before = curvature[i - 1], here = curvature[i], after = curvature[i + 1];
    if (here > before && here >= after) consider(sharpest(piece, 1.0, place(k - 1), place(k + 1)));
    if (here < before && here <= after) consider(sharpest(piece, -1.0, place(k - 1), place(k + 1)));
  }
  return range;
}

}  // namespace yoke
