// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// One step of generalised-alpha: prediction, Newton's iteration, the consistent state at its end.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <yoke/core/equations/linear/index.hpp>
#include <yoke/integrators/formulations/generalised_alpha.hpp>

namespace yoke {

namespace {

constexpr int max_newton_iterations = 10;
constexpr double newton_share = 1e-3;  // of the error allowed in a step
constexpr double slow = 0.2;           // Newton converging worse than this gets a new matrix

}  // namespace

void GeneralisedAlpha::predict(double h) {
  const double rescaled = options_.plain ? h_last_ : h;
  const double am = (1.0 - c_.alpha_m) / (1.0 - c_.alpha_f);
  for (std::size_t i = 0; i < v_.size(); ++i) {
    const double v = end_.v[i] + c_.C * h * h * jerk_normal_[i];
    const double a = end_.a[i] + rescaled * b_[i];
    a_[i] = end_.a[i] + (1.0 + c_.theta) * h * jerk_[i];
    new_.u[i] = end_.u[i] + h * (v + h * ((0.5 - c_.beta) * a + c_.beta * a_[i]));
    v_[i] = v + h * ((1.0 - c_.gamma) * a + c_.gamma * a_[i]);
    rate_[i] = am * a_[i] + (c_.alpha_m * a - c_.alpha_f * end_.a[i]) / (1.0 - c_.alpha_f);
  }
  for (std::size_t i = 0; i < w_.size(); ++i) {
    const double w = end_.z_dot[i] + rescaled * b_z_[i];
    w_[i] = end_.z_dot[i];
    new_.z[i] = end_.z[i] + h * ((1.0 - c_.gamma) * w + c_.gamma * w_[i]);
    z_rate_[i] = am * w_[i] + (c_.alpha_m * w - c_.alpha_f * end_.z_dot[i]) / (1.0 - c_.alpha_f);
  }
  for (std::size_t i = 0; i < lambda_.size(); ++i)
    lambda_[i] = end_.lambda[i] + h * lambda_rate_[i];
  load_ = lambda_;
}

bool GeneralisedAlpha::solve_stage(double h, double t) {
  bool renew = true;
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < max_newton_iterations; ++iteration) {
    if (renew) {
      calc_matrix(h, t);
      const double am = (1.0 - c_.alpha_m) / (1.0 - c_.alpha_f);
      if (!matrix_.factorise(std::sqrt(am / c_.beta) / h)) return false;
    }
    if (!calc_residual(h, t)) return false;
    matrix_.solve(x_.data());
    const double norm = correct(h);
    if (!std::isfinite(norm)) return false;
    if (norm < 1.0) return true;
    if (iteration > 1 && norm > 0.5 * last && norm * allowed_ < 1.0)
      return true;  // as well as positions are known there; the error test has the last word
    if (iteration > 1 && norm > 2.0 * last) return false;
    renew = norm > slow * last;
    last = norm;
  }
  return false;
}

/// -R into x_.
bool GeneralisedAlpha::calc_residual(double h, double t) {
  ++counters_.evaluations;
  system_.set_motion(t, absolute(new_.u), v_.data());
  system_.set_states(new_.z.data());
  double* r_q = x_.data();
  double* r_z = r_q + n_;
  double* r_p = r_z + nz_;
  system_.calc_position_level(r_p);
  std::ranges::fill(force_, 0.0);
  system_.set_multipliers(mask_.kept(load_.data()));
  system_.add_forces(force_.data(), nz_ > 0 ? r_z : nullptr, nullptr);
  system_.subtract_constraint_forces(mask_.kept(lambda_.data()), force_.data());
  double sum = 0.0;
  for (int i = 0; i < n_; ++i) r_q[i] = force_[at(i)] - system_.mass()[at(i)] * rate_[at(i)];
  for (int i = 0; i < nz_; ++i) r_z[i] -= z_rate_[at(i)];
  for (int i = 0; i < rows_; ++i) r_p[i] = -r_p[i];
  if (system_.any_grip()) {
    system_.calc_velocity_residual(rates_.data());
    for (const ConstraintSlot& c : system_.holds())
      r_p[c.row] = -c_.beta * h / c_.gamma * rates_[at(c.row)];
  }
  for (const int i : system_.dropped_rows()) r_p[i] = -lambda_[at(i)];
  for (const double r : x_) sum += r;
  if (!std::isfinite(sum)) system_.blame_not_finite();
  return std::isfinite(sum);
}

void GeneralisedAlpha::calc_matrix(double h, double t) {
  ++counters_.jacobians;
  const double am = (1.0 - c_.alpha_m) / (1.0 - c_.alpha_f);
  matrix_.evaluate({.t = t,
                    .q = absolute(new_.u),
                    .v = v_.data(),
                    .z = new_.z.data(),
                    .lambda = mask_.kept(lambda_.data())},
                   std::array{1.0, -1.0, am / (c_.beta * h * h), -c_.gamma / (c_.beta * h),
                              am / (c_.gamma * h), c_.beta * h / c_.gamma});
}

/// Adds the correction x_; returns its size in units of what is allowed. Accelerations take their
/// share of it rather than being differences of positions, which would cost them their digits.
double GeneralisedAlpha::correct(double h) {
  const double am = (1.0 - c_.alpha_m) / (1.0 - c_.alpha_f);
  double norm = 0.0;
  for (int i = 0; i < n_; ++i) {
    const double dq = x_[at(i)], da = dq / (c_.beta * h * h);
    new_.u[at(i)] += dq;
    v_[at(i)] += c_.gamma * h * da;
    a_[at(i)] += da;
    rate_[at(i)] += am * da;
    const double r = std::abs(dq) / std::max(newton_share / weight_q_[at(i)], rounding_[at(i)]);
    if (!(r <= norm)) norm = r;  // catches NaN
  }
  for (int i = 0; i < nz_; ++i) {
    const double dz = x_[at(n_ + i)], dw = dz / (c_.gamma * h);
    new_.z[at(i)] += dz;
    w_[at(i)] += dw;
    z_rate_[at(i)] += am * dw;
    const double r = std::abs(dz) / std::max(newton_share * allowed_ * tolerances_.z[i],
                                             rounding_of(tolerances_.z[i] / tolerances_.relative));
    if (!(r <= norm)) norm = r;
  }
  for (int i = 0; i < rows_; ++i) lambda_[at(i)] += x_[at(n_ + nz_ + i)];
  return norm;
}

/// The consistent state at the end of the step being tried.
bool GeneralisedAlpha::finish(double t) {
  new_.t = t;
  new_.v = v_;
  double* q = absolute(new_.u);
  if (!options_.plain) {
    if (!dynamics_.project(t, q, new_.v.data())) return false;
    for (std::size_t i = 0; i < q_.size(); ++i) new_.u[i] = q_[i] - q_start_[i];
  }
  if (!calc_rates(new_)) return false;
  if (options_.plain) new_.a = rate_;
  return guard_.count() == 0 ||
         guard_.evaluate(t, absolute(new_.u), new_.v.data(), new_.z.data(), g_to_.data());
}

}  // namespace yoke
