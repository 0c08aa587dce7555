// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What is measured of a state: independence of the equations, effective mass, violations.
#include <algorithm>
#include <cmath>
#include <limits>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/equations/index.hpp>

namespace yoke {

double Dynamics::independence(double t, const double* q, int iterations) {
  const int n = system_.dofs(), rows = system_.rows();
  if (!same_as_factorised(t, q)) {
    system_.set_motion(t, q, zero_.data());
    system_.calc_position_level(phi_.data());
    factorised_ = false;  // G changed under the factors
  }
  if (!lengths_) lengths_.emplace(system_, length_metric_, std::vector<char>(), dropped_marks());
  if (weakest_.empty()) {  // no direction yet
    weakest_.resize(at(rows));
    for (int i = 0; i < rows; ++i) weakest_[at(i)] = std::cos(1.0 + 2.4 * i);
    iterations = std::max(iterations, 6);
  }
  if (!lengths_->factorise(0.0)) return 0.0;
  const auto counts = [&](int row) {
    return !system_.is_left_out(row) && !system_.is_of_velocity_level(row);
  };
  double eigenvalue = 0.0;
  for (int round = 0; round < iterations; ++round) {
    double before = 0.0, after = 0.0;
    std::fill_n(b_.begin(), n, 0.0);
    for (int i = 0; i < rows; ++i) {
      // A little of everything, or a direction the last one has no part in would stay unseen.
      const double w = counts(i) ? weakest_[at(i)] + 1e-3 * std::cos(2.0 + 1.7 * i) : 0.0;
      b_[at(n + i)] = w;
      before += w * w;
    }
    lengths_->solve(b_.data());
    for (int i = 0; i < rows; ++i) {
      weakest_[at(i)] = counts(i) ? b_[at(n + i)] : 0.0;
      after += weakest_[at(i)] * weakest_[at(i)];
    }
    if (!(after > 0.0) || !std::isfinite(after)) return after == 0.0 ? 1.0 : 0.0;
    eigenvalue = std::sqrt(before / after);
    double largest = 0.0;
    for (int i = 0; i < rows; ++i) {
      weakest_[at(i)] /= std::sqrt(after);
      if (std::abs(weakest_[at(i)]) <= largest) continue;
      largest = std::abs(weakest_[at(i)]);
      weakest_row_ = i;
    }
  }
  return eigenvalue;
}

std::vector<char> Dynamics::dropped_marks() const {
  std::vector<char> marks(at(system_.rows()), 0);
  for (const int row : system_.left_out_rows()) marks[at(row)] = 1;
  return marks;
}

double Dynamics::mobility(const ForceSlot& slot, const double* direction, double& alone) {
  std::fill(b_.begin(), b_.end(), 0.0);
  for (int j = 0; j < slot.columns; ++j)
    if (const int dof = system_.dof()[at(slot.dofs + j)]; dof >= 0) b_[at(dof)] += direction[j];
  lu_->solve(b_.data());
  double mobility = 0.0;
  alone = 0.0;
  for (int j = 0; j < slot.columns; ++j)
    if (const int dof = system_.dof()[at(slot.dofs + j)]; dof >= 0) {
      mobility += direction[j] * b_[at(dof)];
      if (const double mass = system_.mass()[at(dof)]; mass > 0.0)
        alone += direction[j] * direction[j] / mass;
    }
  return mobility;
}

double Dynamics::effective_mass(const ForceSlot& slot, const double* direction) {
  double alone = 0.0;
  const double mobile = mobility(slot, direction, alone);
  // What drivers leave of the mobility of the bodies alone may be rounding.
  return mobile > 64.0 * machine_epsilon * alone ? 1.0 / mobile
                                                 : std::numeric_limits<double>::infinity();
}

double Dynamics::mobility(int dof) {
  std::fill(b_.begin(), b_.end(), 0.0);
  b_[at(dof)] = 1.0;
  lu_->solve(b_.data());
  return std::max(0.0, b_[at(dof)]);
}

Violation Dynamics::largest_of(const std::vector<double>& residual) const {
  Violation worst;
  for (int i = 0; i < system_.rows(); ++i) {
    double& figure = system_.measure(i) == Measure::length ? worst.length : worst.angle;
    figure = std::max(figure, std::abs(residual[at(i)]));
  }
  return worst;
}

Violation Dynamics::position_violation(const State& state) {
  system_.set_motion(state.t, state.q.data(), state.v.data());
  system_.calc_position_level(phi_.data());
  worst_residual_ = system_.norm(phi_.data(), &worst_row_);
  factorised_ = false;  // G changed under the factors
  return largest_of(phi_);
}

Violation Dynamics::velocity_violation(const State& state) {
  system_.set_motion(state.t, state.q.data(), state.v.data());
  system_.calc_position_level(phi_.data());
  system_.calc_velocity_residual(residual_.data());
  factorised_ = false;
  return largest_of(residual_);
}

}  // namespace yoke
