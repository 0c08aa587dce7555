// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The inverse of every law  d = a F ln(B/F)  without exponential and without iteration.
//
// Put F = d/(a w). Then w = ln(B/F) and w e^-w = d/(a B): w is minus the lower branch of Lambert's
// function. With the end of the law, d_max = a B/e (w = 1), and x = d/d_max,
//   w - ln w = 1 - ln x,      v = w - 1 >= 0:   v - ln(1 + v) = u,   u = -ln x >= 0;
//   F = d/(a (1 + v)),   dF/dd = 1/(a v),   U = a F^2 (v/2 + 1/4).
// v is one function of one variable for all laws of the family, analytic but at x = 1, where it
// goes as sqrt(2u), and at x = 0. Two tables of polynomials of degree 7 cover it:
//   away from the fold (x <= 3/4): v(u), pieces of u of equal relative width, 16 to the octave from
//     1/4 to 2048, found by the leading bits of u. On a piece the branch point is 33 half-widths
//     away and interpolation at Chebyshev points errs by C(1/2, 8)/33^8/2^7 = 7e-17 relative.
//   near the fold (x > 3/4): v = q P(q), q = sqrt(2y), y = (d_max - d)/d_max, pieces of q of width
//     1/32. y is exact to a rounding because the difference is; no logarithm is taken. The nearest
//     singularity, x = 0 or q = sqrt(2), is 42 half-widths away: 6e-17.
// The tables are interpolated on first use, from v by Newton's method in extended precision.
// Relative error of force and stiffness: below 2e-15 over the whole range (tested against higher
// precision), judged at the doubles a and d_max.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace yoke {

class LogLawInverse {
 public:
  /// The tables, 14 kB; made by the first call.
  static const LogLawInverse& tables();

  static constexpr double fold = 0.75;  ///< x beyond which near_fold() is meant

  /// v of u = -ln x for 1/4 <= u < 2048.
  double away(double u) const {
    const auto bits = std::bit_cast<std::uint64_t>(u);
    const double left = std::bit_cast<double>(bits & ~((std::uint64_t{1} << shift) - 1));
    return value(away_[static_cast<std::size_t>((bits >> shift) - first)], u - left);
  }

  /// v of y = 1 - x for 0 <= y <= 1/4.
  double near_fold(double y) const {
    const double q = std::sqrt(2.0 * y);
    const auto piece = static_cast<int>(q * pieces_per_unit);
    return q * value(fold_[static_cast<std::size_t>(piece)], q - piece / pieces_per_unit);
  }

 private:
  using Polynomial = std::array<double, 8>;  // lowest power first: one line of the cache

  LogLawInverse();

  static double value(const Polynomial& c, double t) {
    const double t2 = t * t;
    return ((c[0] + c[1] * t) + (c[2] + c[3] * t) * t2) +
           ((c[4] + c[5] * t) + (c[6] + c[7] * t) * t2) * (t2 * t2);
  }

  static constexpr int shift = 48;  // leaves sign, exponent and four bits: 16 pieces to the octave
  static constexpr std::uint64_t first = std::bit_cast<std::uint64_t>(0.25) >> shift;
  static constexpr int octaves = 13;
  static constexpr double pieces_per_unit = 32.0;

  alignas(64) std::array<Polynomial, 16 * octaves> away_;
  alignas(64) std::array<Polynomial, 23> fold_;  // up to q = sqrt(1/2)
};

}  // namespace yoke
