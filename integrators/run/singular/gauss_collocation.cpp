// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <Eigen/LU>
#include <boost/math/special_functions/legendre.hpp>

#include <yoke/integrators/run/singular/gauss_collocation.hpp>

#include <algorithm>
#include <cmath>

namespace yoke {

namespace {
constexpr int max_iterations = 40;
constexpr double rounding_noise = 1e-6;  // near a singular position, in length scales or rad
}  // namespace

GaussCollocation::GaussCollocation(Dynamics& dynamics, const Tolerances& tolerances, int stages,
                                   double converged)
    : dynamics_(dynamics),
      n_(dynamics.system().dofs()),
      nz_(dynamics.system().states()),
      quadratures_(dynamics.system().quadratures()),
      size_(2 * n_ + nz_ + quadratures_),
      stages_(stages),
      converged_(converged),
      node_(stages),
      weight_(Eigen::VectorXd::Zero(stages)),
      a_(Eigen::MatrixXd::Zero(stages, stages)),
      noise_(std::max(1.0, rounding_noise / tolerances.relative)) {
  // Roots of the Legendre polynomial, shifted to (0, 1).
  const auto roots = boost::math::legendre_p_zeros<double>(stages);  // those that are not negative
  for (int i = 0; i < stages / 2; ++i) {
    const double root = roots[static_cast<std::size_t>(stages / 2 - 1 - i)];
    node_[i] = 0.5 - 0.5 * root;
    node_[stages - 1 - i] = 0.5 + 0.5 * root;
  }
  Eigen::MatrixXd powers(stages, stages);
  for (int i = 0; i < stages; ++i)
    for (int k = 0; k < stages; ++k) powers(i, k) = std::pow(node_[i], k);
  lagrange_ = powers.inverse();  // column j: the polynomial that is 1 at node j, 0 at the others
  for (int j = 0; j < stages; ++j) {
    for (int k = 0; k < stages; ++k) {
      weight_[j] += lagrange_(k, j) / (k + 1);
      for (int i = 0; i < stages; ++i)
        a_(i, j) += lagrange_(k, j) * std::pow(node_[i], k + 1) / (k + 1);
    }
  }
  error_weight_.assign(tolerances.q.begin(), tolerances.q.end());
  error_weight_.insert(error_weight_.end(), tolerances.v.begin(), tolerances.v.end());
  error_weight_.insert(error_weight_.end(), tolerances.z.begin(), tolerances.z.end());
  error_weight_.resize(static_cast<std::size_t>(size_), tolerances.energy);
  stage_.assign(static_cast<std::size_t>(stages), error_weight_);
  sum_ = stage_;
}

GaussCollocation::Segment GaussCollocation::make_segment() const {
  Segment segment;
  segment.begin.assign(static_cast<std::size_t>(size_), 0.0);
  segment.end = segment.begin;
  segment.rates.assign(stage_.size(), segment.begin);
  return segment;
}

double GaussCollocation::distance(const double* a, const double* b) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < error_weight_.size(); ++i) {
    const double weight = i < static_cast<std::size_t>(n_)
                              ? std::max(error_weight_[i], rounding_of(a[i]))
                              : error_weight_[i];
    const double d = std::abs(a[i] - b[i]) / weight;
    if (!(d <= largest)) largest = d;
    if (std::isnan(d)) break;
  }
  return largest;
}

GaussCollocation::Outcome GaussCollocation::project(double t, double* y, double too_close,
                                                    double& independence) {
  if (!dynamics_.project_positions(t, y, Correction::exact)) return Outcome::diverged;
  const double here = dynamics_.independence(t, y);
  independence = std::min(independence, here);
  if (here < too_close) return Outcome::close;
  return dynamics_.project_velocities(t, y, y + n_) ? Outcome::solved : Outcome::diverged;
}

GaussCollocation::Outcome GaussCollocation::calc_rates(double t, double* y, double* rates,
                                                       double too_close, double& independence) {
  const Outcome outcome = project(t, y, too_close, independence);
  if (outcome != Outcome::solved) return outcome;
  std::copy_n(y + n_, n_, rates);
  return dynamics_.calc_accelerations(
             {.t = t, .q = y, .v = y + n_, .z = y + 2 * n_},
             {.a = rates + n_, .z_dot = rates + 2 * n_, .quadrature_rates = rates + 2 * n_ + nz_})
             ? Outcome::solved
             : Outcome::diverged;
}

GaussCollocation::Outcome GaussCollocation::step(Segment& s, const double* a, double too_close,
                                                 bool end_is_free) {
  const auto n = static_cast<std::size_t>(n_);
  for (std::size_t i = 0; i < stage_.size(); ++i) {
    const double x = time(s, i) - s.t;
    stage_[i] = s.begin;
    for (std::size_t k = 0; k < n; ++k) {
      stage_[i][k] += x * (s.begin[n + k] + 0.5 * x * a[k]);
      stage_[i][n + k] += x * a[k];
    }
  }
  return iterate(s, too_close, end_is_free);
}

GaussCollocation::Outcome GaussCollocation::step(Segment& s, const GaussCollocation& other,
                                                 const Segment& found, double too_close,
                                                 bool end_is_free) {
  for (std::size_t i = 0; i < stage_.size(); ++i)
    other.interpolate(found, time(s, i), stage_[i].data());
  return iterate(s, too_close, end_is_free);
}

// Fixed-point iteration from stage_.
GaussCollocation::Outcome GaussCollocation::iterate(Segment& s, double too_close,
                                                    bool end_is_free) {
  s.least = 1.0;
  const std::size_t stages = stage_.size();
  double last = 0.0;
  for (int iteration = 0;; ++iteration) {
    for (std::size_t i = 0; i < stages; ++i)
      if (const Outcome outcome =
              calc_rates(time(s, i), stage_[i].data(), s.rates[i].data(), too_close, s.least);
          outcome != Outcome::solved)
        return outcome;
    double change = 0.0;
    for (std::size_t i = 0; i < stages; ++i) {
      for (std::size_t k = 0; k < s.begin.size(); ++k) {
        double sum = 0.0;
        for (std::size_t j = 0; j < stages; ++j)
          sum += a_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * s.rates[j][k];
        stage_[i][k] = s.begin[k] + s.h * sum;
      }
      if (iteration > 0) change = std::max(change, distance(stage_[i].data(), sum_[i].data()));
      sum_[i] = stage_[i];
    }
    if (!std::isfinite(change)) return Outcome::diverged;
    if (iteration == 0) continue;
    if (change < converged_) break;
    // Rounding, mostly across the motion, where the projection takes it away; or no convergence.
    if (iteration > 3 && change > 0.5 * last) {
      if (change < noise_) break;
      return Outcome::diverged;
    }
    if (iteration == max_iterations) return Outcome::diverged;
    last = change;
  }
  for (std::size_t k = 0; k < s.end.size(); ++k) {
    double sum = 0.0;
    for (std::size_t j = 0; j < stages; ++j)
      sum += weight_[static_cast<Eigen::Index>(j)] * s.rates[j][k];
    s.end[k] = s.begin[k] + s.h * sum;
  }
  const Outcome outcome = project(s.t + s.h, s.end.data(), too_close, s.least);
  return end_is_free ? Outcome::solved : outcome;
}

void GaussCollocation::interpolate(const Segment& s, double t, double* y) const {
  const double x = (t - s.t) / s.h;
  double factor[8] = {};
  for (int j = 0; j < stages_; ++j)
    for (int k = stages_; k-- > 0;) factor[j] = (factor[j] + lagrange_(k, j) / (k + 1)) * x;
  for (std::size_t k = 0; k < s.begin.size(); ++k) {
    double sum = 0.0;
    for (std::size_t j = 0; j < s.rates.size(); ++j) sum += factor[j] * s.rates[j][k];
    y[k] = s.begin[k] + s.h * sum;
  }
}

}  // namespace yoke
