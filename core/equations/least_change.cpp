// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/least_change.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <yoke/core/equations/consistency.hpp>
#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {
constexpr int max_iterations = 300;
constexpr double smallest_damping = 1e-13;
constexpr double largest_damping = 1e10;
constexpr double largest_turn = 0.5;  // [rad] in one iteration
// What rounding may leave, in length scales or rad, where Newton's iteration cannot square it.
constexpr double close_enough = 1e-12;
// Rounds that remove what the damping leaves of a residual: at least, and at most next to a singular
// position, where each removes less.
constexpr int velocity_rounds = 4, max_velocity_rounds = 40;
constexpr double agreement_of_rates = 1e-10;  // of the terms
}  // namespace

LeastChange::LeastChange(System& system, std::vector<double> weights, std::vector<char> held,
                         std::vector<char> ignored)
    : system_(system),
      saddle_(system, std::move(weights), std::move(held), std::move(ignored)),
      residual_(at(system.rows()), 0.0),
      x_(at(system.dofs() + system.rows()) + 1, 0.0),
      zero_(at(system.dofs()), 0.0) {}

double LeastChange::size(int row) const {
  return system_.measure(row) == Measure::length ? system_.scales().length : 1.0;
}

void LeastChange::evaluate(double t, const double* q) {
  system_.set_motion(t, q, zero_.data());
  system_.calc_position_level(residual_.data());
  norm_ = 0.0;
  for (int i = 0; i < system_.rows(); ++i) {
    if (saddle_.ignores(i)) residual_[at(i)] = 0.0;
    const double r = std::abs(residual_[at(i)]) / size(i);
    if (r <= norm_) continue;
    norm_ = r;  // NaN too
    worst_row_ = i;
    if (std::isnan(r)) break;
  }
}

double LeastChange::merit() const {
  double sum = 0.0;
  for (int i = 0; i < system_.rows(); ++i) sum += std::pow(residual_[at(i)] / size(i), 2);
  return sum;
}

// With the least damping that dependent equations let one factorise with.
bool LeastChange::factorise_lightly() {
  for (double mu = 10.0 * smallest_damping; mu < 1e-5; mu *= 10.0)
    if (saddle_.factorise(mu)) return true;
  return false;
}

void LeastChange::step(const double* residual) {
  const int n = system_.dofs();
  std::ranges::fill(x_, 0.0);
  for (int i = 0; i < system_.rows(); ++i)
    if (!saddle_.ignores(i)) x_[at(n + i)] = -residual[i] * saddle_.row_scale(i);
  saddle_.solve(x_.data());
  for (int i = 0; i < n; ++i) x_[at(i)] /= saddle_.root_weight(i);
}

bool LeastChange::solve_positions(double t, double* q) {
  const auto n = at(system_.dofs());
  std::vector<double> trial(n);
  double mu = 1e-3;
  evaluate(t, q);
  const double size = std::max(1.0, largest_position_term(system_, q)),
               tolerance = 16.0 * machine_epsilon * size,
               good = std::max(tolerance, close_enough * size);
  double before = merit();
  for (int iteration = 0; iteration < max_iterations && norm_ > tolerance; ++iteration) {
    if (!std::isfinite(before)) return false;
    bool better = false;
    // The blocks of G are those of q here: a rejected trial is evaluated anew.
    while (!better && mu <= largest_damping) {
      if (saddle_.factorise(mu)) {
        step(residual_.data());
        double turn = 0.0;
        for (std::size_t i = 2; i < n; i += 3) turn = std::max(turn, std::abs(x_[i]));
        const double share = turn > largest_turn ? largest_turn / turn : 1.0;
        for (std::size_t i = 0; i < n; ++i) trial[i] = q[i] + share * x_[i];
        evaluate(t, trial.data());
        const double after = merit();
        better = after < before * (1.0 - 1e-6);
        if (better) {
          std::ranges::copy(trial, q);
          before = after;
          break;
        }
        evaluate(t, q);
        if (norm_ < good) return true;
      }
      mu = std::max(10.0 * mu, 1e-8);
    }
    if (!better) break;
    mu = std::max(0.1 * mu, smallest_damping);
  }
  return norm_ <= good;
}

bool LeastChange::solve_velocities(double t, const double* q, double* v) {
  evaluate(t, q);
  if (!factorise_lightly()) return false;
  const int n = system_.dofs();
  // What a residual is to be compared with: the terms it is the sum of, before and after.
  const auto size_of_terms = [&] {
    const EquationTerms terms = rate_terms(system_, Eigen::Map<const Eigen::VectorXd>(v, n));
    double largest = 0.0;
    for (int i = 0; i < system_.rows(); ++i)
      if (!saddle_.ignores(i)) largest = std::max(largest, terms.size[at(i)] / size(i));
    return largest;
  };
  const double before = size_of_terms();
  double last = std::numeric_limits<double>::infinity(), worst = last;
  for (int round = 0;; ++round) {
    system_.set_motion(t, q, v);
    system_.calc_velocity_residual(residual_.data());
    last = worst;
    worst = largest_residual();
    const bool enough = worst <= machine_epsilon * before || !(worst < 0.9 * last);
    if (round == max_velocity_rounds || (round >= velocity_rounds && enough)) break;
    step(residual_.data());
    for (int i = 0; i < n; ++i) v[i] += x_[at(i)];
  }
  const double rate = std::max(before, size_of_terms());
  return worst <= agreement_of_rates * rate;
}

// Of the equations that count, in length scales or rad per s; notes the row.
double LeastChange::largest_residual() {
  double worst = 0.0;
  for (int i = 0; i < system_.rows(); ++i) {
    if (saddle_.ignores(i)) residual_[at(i)] = 0.0;
    const double r = std::abs(residual_[at(i)]) / size(i);
    if (r <= worst) continue;
    worst = r;  // NaN too
    worst_row_ = i;
    if (std::isnan(r)) break;
  }
  return worst;
}

void LeastChange::make_admissible(double* d) {
  if (!factorise_lightly()) return;
  for (int i = 0; i < system_.dofs(); ++i)
    if (saddle_.holds(i)) d[i] = 0.0;
  std::vector<double> change(residual_.size());
  for (int round = 0; round < 3; ++round) {
    std::ranges::fill(change, 0.0);
    system_.add_jacobian_times(d, change.data());
    step(change.data());
    for (int i = 0; i < system_.dofs(); ++i)
      if (!saddle_.holds(i)) d[i] += x_[at(i)];
  }
}

}  // namespace yoke
