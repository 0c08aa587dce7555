// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Work against error at several accuracies, and work at equal error.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

namespace yoke::bench {

struct WorkPoint {
  double error = 0.0, work = 0.0;
};

/// In the order of the accuracies asked for. The least work with which an error is reached, between
/// neighbouring accuracies with both axes logarithmic; nan if it is not reached.
inline double work_at(const std::vector<WorkPoint>& curve, double error) {
  double best = std::numeric_limits<double>::quiet_NaN();
  const auto take = [&](double work) { best = std::isnan(best) ? work : std::fmin(best, work); };
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve[i].error <= error) take(curve[i].work);
    if (i == 0) continue;
    const WorkPoint &a = curve[i - 1], &b = curve[i];
    if ((a.error - error) * (b.error - error) >= 0.0) continue;
    const double s = std::log(error / a.error) / std::log(b.error / a.error);
    take(std::exp((1.0 - s) * std::log(a.work) + s * std::log(b.work)));
  }
  return best;
}

}  // namespace yoke::bench
