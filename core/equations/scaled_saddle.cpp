// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/scaled_saddle.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/core/equations/assemblies.hpp>
#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

ScaledSaddle::ScaledSaddle(const System& system, std::vector<double> weights,
                           std::vector<char> held, std::vector<char> ignored)
    : system_(system),
      root_(std::move(weights)),
      held_(std::move(held)),
      ignored_(std::move(ignored)) {
  const int n = system.dofs(), rows = system.rows();
  for (double& r : root_) r = std::sqrt(r);
  held_.resize(at(n), 0);
  ignored_.resize(at(rows), 0);
  for (const ConstraintSlot& c : system.holds()) ignored_[at(c.row)] = 1;
  PatternBuilder pattern(n + rows);
  for (int i = 0; i < n + rows; ++i) diagonal_.push_back(pattern.add(i, i));
  for (const ConstraintSlot& c : system.constraints()) {
    for (int i = 0; i < c.rows; ++i) {
      const int row = c.row + i;
      for (int j = 0; j < c.columns; ++j) {
        const int dof = system.dof()[at(c.dofs + j)];
        if (dof < 0 || holds(dof) || ignores(row)) continue;
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
  row_scale_.assign(at(rows), 0.0);
  lu_ = std::make_unique<SparseLU>(matrix_);
}

bool ScaledSaddle::factorise(double mu) {
  const int n = system_.dofs();
  const double* G = system_.G();
  std::ranges::fill(row_scale_, 0.0);
  for (const Stamp& s : stamps_) {
    const double g = G[s.entry] / root_[at(s.dof)];
    row_scale_[at(s.row)] += g * g;
  }
  for (double& r : row_scale_) r = r > 0.0 && std::isfinite(r) ? 1.0 / std::sqrt(r) : 0.0;
  std::ranges::fill(matrix_.value, 0.0);
  for (int i = 0; i < n; ++i) matrix_.value[at(diagonal_[at(i)])] = 1.0;
  for (int i = 0; i < system_.rows(); ++i)
    matrix_.value[at(diagonal_[at(n + i)])] = ignores(i) ? 1.0 : -mu;
  for (const Stamp& s : stamps_) {
    const double value = G[s.entry] * row_scale_[at(s.row)] / root_[at(s.dof)];
    matrix_.value[at(s.lower)] += value;
    matrix_.value[at(s.upper)] += value;
  }
  return lu_->factorise(matrix_);
}

namespace {

/// Largest mass [kg] and inertia [kg m^2] of the bodies tied together, and how far they spread [m].
struct Size {
  double mass = 0.0, inertia = 0.0, length = 0.0;
};

// Of each assembly its own, as far as it has them: others must not tell how it starts.
std::vector<Size> sizes_of(const System& system, const std::vector<int>& assembly) {
  constexpr double no_length = 1e-6;  // bodies in one place, but for rounding
  const auto& bodies = system.model().bodies();
  std::vector<Size> size(assembly.size());
  std::vector<Vec2> centre(assembly.size(), Vec2::Zero());
  std::vector<double> count(assembly.size(), 0.0), spread = count;
  for (std::size_t i = 0; i < assembly.size(); ++i) {
    Size& s = size[at(assembly[i])];
    s.mass = std::max(s.mass, bodies[i + 1].mass);
    s.inertia = std::max(s.inertia, bodies[i + 1].inertia);
    centre[at(assembly[i])] += bodies[i + 1].pose.position;
    count[at(assembly[i])] += 1.0;
  }
  for (std::size_t i = 0; i < assembly.size(); ++i) {
    const std::size_t own = at(assembly[i]);
    spread[own] += (bodies[i + 1].pose.position - centre[own] / count[own]).squaredNorm();
  }
  for (std::size_t k = 0; k < size.size(); ++k) {
    Size& s = size[k];
    if (count[k] > 0.0) s.length = std::sqrt(spread[k] / count[k]);
    if (s.mass > 0.0) s.length = std::max(s.length, std::sqrt(s.inertia / s.mass));
    if (!(s.length > no_length * system.natural_length())) s.length = system.natural_length();
    if (s.mass == 0.0) s.mass = s.inertia / (s.length * s.length);
    if (s.mass == 0.0) s.mass = system.mean_mass();
  }
  return size;
}

}  // namespace

std::vector<double> metric_of_masses(const System& system) {
  // Small enough to leave the motion to those that have mass, large enough for the numerics.
  constexpr double next_to_nothing = 1e-6;
  std::vector<double> weights(system.mass().begin(), system.mass().end());
  if (!system.has_massless()) return weights;
  const std::vector<int> assembly = assemblies_of(system);
  const std::vector<Size> size = sizes_of(system, assembly);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Size& own = size[at(assembly[i / 3])];
    if (weights[i] == 0.0)
      weights[i] = next_to_nothing * own.mass * (i % 3 == 2 ? own.length * own.length : 1.0);
  }
  return weights;
}

std::vector<double> metric_of_lengths(System& system) {
  // In parts of the natural length. A short lever may only happen to be short in the start pose, as
  // that of a pin that enters a slot along it: how long it is shows in other poses.
  constexpr double short_lever = 1e-2, no_lever = 1e-6;
  const double length = system.natural_length();
  std::vector<double> arms = system.squared_arms();
  const auto shorter = [&](double arm, double share) {
    return !(arm > std::pow(share * length, 2) && std::isfinite(arm));
  };
  if (std::ranges::any_of(arms, [&](double arm) { return shorter(arm, short_lever); }))
    for (const double turned : {1.1, 2.3}) {
      const std::vector<double> other = system.squared_arms(turned);
      for (std::size_t body = 0; body < arms.size(); ++body)
        if (shorter(arms[body], short_lever) && std::isfinite(other[body]))
          arms[body] = std::isfinite(arms[body]) ? std::max(arms[body], other[body]) : other[body];
    }
  std::vector<double> weights(at(system.dofs()), 1.0);
  for (std::size_t body = 0; body < arms.size(); ++body)
    weights[3 * body + 2] = shorter(arms[body], no_lever) ? length * length : arms[body];
  return weights;
}

}  // namespace yoke
