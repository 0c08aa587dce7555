// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/explicit/stability_watch.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace yoke {

namespace {

constexpr double near = 0.5;  // to the bound of stability on the real axis; others are nearer
double square(double x) { return x * x; }

constexpr int forgotten = 6;  // steps that are free, after which those before do not count

}  // namespace

StabilityWatch::StabilityWatch(std::vector<double> weights, int dofs)
    : weights_(std::move(weights)), y_(weights_.size(), 0.0), n_(static_cast<std::size_t>(dofs)) {}

// A force by position and one by velocity: of the root of stiffness over mass and damping over mass what
// the difference of the stages bears, so that neither is taken for the other.
double StabilityWatch::rate_between(const double* y, const double* y_dot) const {
  double q = 0.0, v = 0.0, a = 0.0, z = 0.0, z_dot = 0.0;
  const std::size_t n = n_;
  for (std::size_t i = n; i < 2 * n; ++i) {
    const double w = weights_[i] * weights_[i];
    q += w * square(y[i - n] - y_[i - n]);
    v += w * square(y[i] - y_[i]);
    a += w * square(y_dot[i] - y_dot_[i]);
  }
  for (std::size_t i = 2 * n; i < y_.size(); ++i) {
    const double w = weights_[i] * weights_[i];
    z += w * square(y[i] - y_[i]);
    z_dot += w * square(y_dot[i] - y_dot_[i]);
  }
  const double of_bodies = a > 0.0 ? std::sqrt(std::min(a / v, std::sqrt(a / q))) : 0.0;
  return std::max(of_bodies, z > 0.0 ? std::sqrt(z_dot / z) : 0.0);
}

void StabilityWatch::see(double t, const double* y, const double* y_dot) {
  if (seen_ && t == t_) {
    if (found_) return;  // the next step begins there
    rate_ = rate_between(y, y_dot);
    found_ = rate_ > 0.0 && std::isfinite(rate_);
  } else {
    found_ = false;
  }
  std::copy_n(y, y_.size(), y_.begin());
  y_dot_ = y_dot;
  t_ = t;
  seen_ = true;
}

void StabilityWatch::end_step(double h) {
  if (!found_) return;
  if (h * rate_ > near * stable_) {
    ++bounded_;
    free_ = 0;
  } else if (++free_ >= forgotten) {
    bounded_ = 0;
  }
}

}  // namespace yoke
