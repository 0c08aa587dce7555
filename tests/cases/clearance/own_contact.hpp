// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Small integrations with constant steps, to compare mechanisms with clearance with: they share no
// code with the library.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace yoke::tests {

/// Steel on steel, Hertz: K = 4/3 E* sqrt(R).
inline double hertz_stiffness(double relative_radius) {
  return 4.0 / 3.0 * 207e9 / (2.0 * (1.0 - 0.3 * 0.3)) * std::sqrt(relative_radius);
}

/// F = K d^1.5 (1 + 3/4 (1 - e^2) d'/v) in contact, v the speed of approach at its onset.
struct OwnContact {
  double K, e;
  double approach = 0.0;
  bool on = false;
  double d = -1.0, rate = 0.0;  // after the step before
  std::vector<double> onsets{};

  double force(double depth, double depth_rate) const {
    if (!on || depth <= 0.0) return 0.0;
    return K * std::pow(depth, 1.5) * (1.0 + 0.75 * (1.0 - e * e) * depth_rate / approach);
  }
  /// After a step of length h that ended at t.
  void note(double t, double h, double depth, double depth_rate) {
    if (!on && depth > 0.0) {
      const double part = d / (d - depth);
      approach = rate + part * (depth_rate - rate);
      onsets.push_back(t - h + part * h);
    }
    on = depth > 0.0;
    d = depth;
    rate = depth_rate;
  }
};

/// One step of the classical method of fourth order for y' = f(t, y).
template <int N, class F>
Eigen::Matrix<double, N, 1> rk4(const F& f, double t, double h,
                                const Eigen::Matrix<double, N, 1>& y) {
  using Y = Eigen::Matrix<double, N, 1>;
  const Y a = f(t, y), b = f(t + 0.5 * h, y + 0.5 * h * a), c = f(t + 0.5 * h, y + 0.5 * h * b),
          d = f(t + h, y + h * c);
  return y + h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
}

}  // namespace yoke::tests
