// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Random numbers that are the same on every platform: the raw output of std::mt19937_64, which the
// standard prescribes, and our own transformations, which need only +, -, *, / and sqrt. (The
// distributions of the standard library, and sin or pow, differ from one library to another.)
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include <yoke/core/types.hpp>

namespace yoke::tests::random {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed * 0x9E3779B97F4A7C15ULL + 1U) {
    engine_.discard(16);
  }

  /// In [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// 0, ..., n - 1.
  int below(int n) {
    return static_cast<int>((engine_() >> 32U) * static_cast<std::uint64_t>(n) >> 32U);
  }
  int among(int low, int high) { return low + below(high - low + 1); }
  bool chance(double probability) { return unit() < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  /// Of any order of magnitude: 10^low to 10^(low + decades), each decade equally likely.
  double decades(int low, int decades) {
    double value = between(1.0, 10.0);
    for (int k = low + below(decades); k != 0; k += k < 0 ? 1 : -1)
      value = k < 0 ? value / 10.0 : value * 10.0;
    return value;
  }
  /// Within the unit circle.
  Vec2 in_circle() {
    for (;;) {
      const double x = between(-1.0, 1.0);
      const double y = between(-1.0, 1.0);
      if (x * x + y * y < 1.0) return {x, y};
    }
  }
  Vec2 direction() {
    for (;;) {
      const Vec2 p = in_circle();
      const double square = p.x() * p.x() + p.y() * p.y();
      if (square > 0.01) return p / std::sqrt(square);
    }
  }

 private:
  std::mt19937_64 engine_;
};

/// (cos, sin) of an angle up to a few turns, by Taylor's series and doubling: the same bits
/// everywhere, accurate to 1e-12.
inline Vec2 unit_vector(double angle) {
  const double x = angle / 32.0, y = x * x;
  double s = x * (1.0 - y / 6.0 * (1.0 - y / 20.0 * (1.0 - y / 42.0 * (1.0 - y / 72.0))));
  double c = 1.0 - y / 2.0 * (1.0 - y / 12.0 * (1.0 - y / 30.0 * (1.0 - y / 56.0)));
  for (int i = 0; i < 5; ++i) {
    const double double_s = 2.0 * s * c;
    c = 1.0 - 2.0 * s * s;
    s = double_s;
  }
  const double norm = std::sqrt(c * c + s * s);
  return {c / norm, s / norm};
}

}  // namespace yoke::tests::random
