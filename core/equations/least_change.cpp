// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/least_change.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <yoke/core/equations/consistency.hpp>
#include <yoke/core/equations/index.hpp>

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
      weights_(std::move(weights)),
      held_(std::move(held)),
      ignored_(std::move(ignored)) {
  const int n = system.dofs(), rows = system.rows();
  held_.resize(at(n), 0);
  ignored_.resize(at(rows), 0);
  PatternBuilder pattern(n + rows);
  for (int i = 0; i < n + rows; ++i) diagonal_.push_back(pattern.add(i, i));
  for (const ConstraintSlot& c : system.constraints()) {
    for (int i = 0; i < c.rows; ++i) {
      const int row = c.row + i;
      for (int j = 0; j < c.columns; ++j) {
        const int dof = system.dof()[at(c.dofs + j)];
        if (dof < 0 || held_[at(dof)] != 0 || ignored_[at(row)] != 0) continue;
        const int lower = pattern.add(n + row, dof);
        stamps_.push_back(
            {c.block + i * c.columns + j, row, dof, lower, pattern.add(dof, n + row)});
      }
    }
  }
  std::vector<int> slot;
  matrix_ = pattern.compile(slot);
  for (int& d : diagonal_) d = slot[at(d)];
  for (Stamp& s : stamps_) {
    s.lower = slot[at(s.lower)];
    s.upper = slot[at(s.upper)];
  }
  row_scale_.assign(at(rows), 1.0);
  residual_.assign(at(rows), 0.0);
  x_.assign(at(n + rows) + 1, 0.0);
  zero_.assign(at(n), 0.0);
  lu_ = std::make_unique<SparseLU>(matrix_);
}

double LeastChange::size(int row) const {
  return system_.measure(row) == Measure::length ? system_.scales().length : 1.0;
}

void LeastChange::evaluate(double t, const double* q) {
  system_.set_motion(t, q, zero_.data());
  system_.calc_position_level(residual_.data());
  norm_ = 0.0;
  for (int i = 0; i < system_.rows(); ++i) {
    if (ignored_[at(i)] != 0) residual_[at(i)] = 0.0;
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

bool LeastChange::factorise(double mu) {
  mu_ = mu;
  const int n = system_.dofs();
  const double* G = system_.G();
  std::ranges::fill(row_scale_, 0.0);
  for (const Stamp& s : stamps_)
    row_scale_[at(s.row)] += G[s.entry] * G[s.entry] / weights_[at(s.dof)];
  for (double& r : row_scale_) r = r > 0.0 && std::isfinite(r) ? 1.0 / std::sqrt(r) : 1.0;
  std::ranges::fill(matrix_.value, 0.0);
  for (int i = 0; i < n; ++i) matrix_.value[at(diagonal_[at(i)])] = 1.0;
  for (int i = 0; i < system_.rows(); ++i)
    matrix_.value[at(diagonal_[at(n + i)])] = ignored_[at(i)] != 0 ? 1.0 : -mu;
  for (const Stamp& s : stamps_) {
    const double value = G[s.entry] * row_scale_[at(s.row)] / std::sqrt(weights_[at(s.dof)]);
    matrix_.value[at(s.lower)] += value;
    matrix_.value[at(s.upper)] += value;
  }
  return lu_->factorise(matrix_);
}

// With the least damping that dependent equations let one factorise with.
bool LeastChange::factorise_lightly() {
  for (double mu = 10.0 * smallest_damping; mu < 1e-5; mu *= 10.0)
    if (factorise(mu)) return true;
  return false;
}

void LeastChange::step(const double* residual) {
  const int n = system_.dofs();
  std::ranges::fill(x_, 0.0);
  for (int i = 0; i < system_.rows(); ++i)
    if (ignored_[at(i)] == 0) x_[at(n + i)] = -residual[i] * row_scale_[at(i)];
  lu_->solve(x_.data());
  for (int i = 0; i < n; ++i) x_[at(i)] /= std::sqrt(weights_[at(i)]);
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
      if (factorise(mu)) {
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
      if (ignored_[at(i)] == 0) largest = std::max(largest, terms.size[at(i)] / size(i));
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
    if (ignored_[at(i)] != 0) residual_[at(i)] = 0.0;
    const double r = std::abs(residual_[at(i)]) / size(i);
    if (r <= worst) continue;
    worst = r;  // NaN too
    worst_row_ = i;
    if (std::isnan(r)) break;
  }
  return worst;
}

void LeastChange::make_admissible(double* d) {
  const auto n = at(system_.dofs());
  if (!factorise_lightly()) return;
  std::vector<double> change(residual_.size());
  for (int round = 0; round < 3; ++round) {
    std::ranges::fill(change, 0.0);
    for (const Stamp& s : stamps_) change[at(s.row)] += system_.G()[s.entry] * d[at(s.dof)];
    step(change.data());
    for (std::size_t i = 0; i < n; ++i) d[i] += x_[i];
  }
  for (std::size_t i = 0; i < n; ++i)
    if (held_[i] != 0) d[i] = 0.0;
}

double LeastChange::independence(double t, const double* q, int iterations) {
  const int n = system_.dofs(), rows = system_.rows();
  evaluate(t, q);
  if (!factorise_lightly()) return 0.0;
  if (weakest_.empty()) {  // no direction yet
    for (int i = 0; i < rows; ++i) weakest_.push_back(std::cos(1.0 + 2.4 * i));
    iterations = std::max(iterations, 6);
  }
  double eigenvalue = 1.0;
  for (int round = 0; round < iterations; ++round) {
    double before = 0.0, after = 0.0, largest = 0.0;
    std::ranges::fill(x_, 0.0);
    for (int i = 0; i < rows; ++i) {
      if (ignored_[at(i)] != 0) continue;
      // A little of everything, or a direction the last one has no part in would stay unseen.
      x_[at(n + i)] = weakest_[at(i)] + 1e-3 * std::cos(2.0 + 1.7 * i);
      before += x_[at(n + i)] * x_[at(n + i)];
    }
    lu_->solve(x_.data());
    for (int i = 0; i < rows; ++i)
      if (ignored_[at(i)] == 0) after += x_[at(n + i)] * x_[at(n + i)];
    if (!(after > 0.0) || !std::isfinite(after)) return after == 0.0 ? 1.0 : 0.0;
    eigenvalue = std::max(0.0, std::sqrt(before / after) - mu_);
    for (int i = 0; i < rows; ++i) {
      weakest_[at(i)] = ignored_[at(i)] == 0 ? x_[at(n + i)] / std::sqrt(after) : 0.0;
      if (std::abs(weakest_[at(i)]) <= largest) continue;
      largest = std::abs(weakest_[at(i)]);
      worst_row_ = i;
    }
  }
  return eigenvalue;
}

}  // namespace yoke
