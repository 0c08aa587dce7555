// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/elastic/log_law_inverse.hpp>

#include <numbers>

namespace yoke {

namespace {

/// v - ln(1 + v) to full relative precision, by its series where the difference cancels.
long double excess(long double v) {
  if (v > 0.25L) return v - std::log1p(v);
  long double sum = 0.0L;
  for (int k = 40; k >= 2; --k) sum = (k % 2 == 0 ? 1.0L : -1.0L) / k + v * sum;
  return v * v * sum;
}

/// v > 0 of v - ln(1 + v) = u. The left side is convex and the start, u + sqrt(2u), above the root,
/// so Newton's method comes down to it without overshoot.
long double solve(long double u) {
  long double v = u + std::sqrt(2.0L * u);
  for (int i = 0; i < 50; ++i) {
    const long double next = v - (excess(v) - u) * (1.0L + v) / v;
    if (!(next < v)) break;
    v = next;
  }
  return v;
}

/// The polynomial in t = x - left through the values of `function` at the Chebyshev points of
/// [left, left + width]: Newton's divided differences, then multiplied out.
template <class Function>
std::array<double, 8> interpolate(long double left, long double width, Function&& function) {
  constexpr int count = 8;
  std::array<long double, count> t{}, difference{}, power{};
  for (std::size_t i = 0; i < count; ++i) {
    const long double angle =
        std::numbers::pi_v<long double> * (static_cast<long double>(i) + 0.5L) / count;
    t[i] = 0.5L * width * (1.0L - std::cos(angle));
    difference[i] = function(left + t[i]);
  }
  for (std::size_t order = 1; order < count; ++order)
    for (std::size_t i = count - 1; i >= order; --i)
      difference[i] = (difference[i] - difference[i - 1]) / (t[i] - t[i - order]);
  for (std::size_t i = count; i-- > 0;) {  // power = power * (t - t_i) + difference_i
    for (std::size_t k = count - 1; k >= 1; --k) power[k] = power[k - 1] - t[i] * power[k];
    power[0] = difference[i] - t[i] * power[0];
  }
  std::array<double, count> result{};
  for (std::size_t k = 0; k < count; ++k) result[k] = static_cast<double>(power[k]);
  return result;
}

}  // namespace

LogLawInverse::LogLawInverse() {
  for (std::size_t i = 0; i < away_.size(); ++i) {
    const double left = std::bit_cast<double>((first + i) << shift);
    const double right = std::bit_cast<double>((first + i + 1) << shift);
    away_[i] = interpolate(left, right - left, solve);
  }
  for (std::size_t i = 0; i < fold_.size(); ++i)
    fold_[i] = interpolate(static_cast<double>(i) / pieces_per_unit, 1.0 / pieces_per_unit,
                           [](long double q) { return solve(-std::log1p(-0.5L * q * q)) / q; });
}

const LogLawInverse& LogLawInverse::tables() {
  static const LogLawInverse only;
  return only;
}

}  // namespace yoke
