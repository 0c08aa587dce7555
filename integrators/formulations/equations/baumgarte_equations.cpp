// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/equations/baumgarte_equations.hpp>

#include <algorithm>
#include <cmath>

namespace yoke {

BaumgarteEquations::BaumgarteEquations(System& system, const Baumgarte& stabilisation)
    : system_(system),
      n_(system.dofs()),
      nz_(system.states()),
      stabilisation_(stabilisation),
      matrix_(system, stabilisation),
      lambda_(system) {
  force_.assign(static_cast<std::size_t>(n_) + 1, 0.0);
  phi_.assign(static_cast<std::size_t>(system.rows()), 0.0);
  phi_dot_ = phi_;
}

void BaumgarteEquations::calc_constraint_residual(const double* v_dot, double* r_l) {
  for (const ConstraintSlot& c : system_.constraints())
    system_.evaluate(
        c, {.phi = phi_.data() + c.row, .G = system_.G() + c.block, .gamma = r_l + c.row});
  system_.calc_velocity_residual(phi_dot_.data());
  const auto [alpha, beta] = stabilisation_;
  for (std::size_t i = 0; i < phi_.size(); ++i)
    r_l[i] = 2.0 * alpha * phi_dot_[i] + beta * beta * phi_[i] - r_l[i];
  system_.add_jacobian_times(v_dot, r_l);
}

bool BaumgarteEquations::calc_residual(double t, const double* y, const double* y_dot,
                                       double* residual) {
  system_.set_motion(t, y, y + v());
  system_.set_states(y + z());
  calc_constraint_residual(y_dot + v(), residual + lambda());
  for (const int i : system_.dropped_rows()) residual[lambda() + i] = y[lambda() + i];
  double* r_v = residual + v();
  double* r_z = residual + z();
  std::ranges::fill(force_, 0.0);
  system_.set_multipliers(lambda_.kept(y + lambda()));
  system_.add_forces(force_.data(), r_z, nullptr);
  system_.subtract_constraint_forces(lambda_.kept(y + lambda()), force_.data());
  double sum = 0.0;
  for (int i = 0; i < n_; ++i) {
    residual[i] = y_dot[i] - y[v() + i];
    r_v[i] = system_.mass()[static_cast<std::size_t>(i)] * y_dot[v() + i] -
             force_[static_cast<std::size_t>(i)];
  }
  for (int i = 0; i < nz_; ++i) r_z[i] = y_dot[z() + i] - r_z[i];
  for (int i = 0; i < size(); ++i) sum += residual[i];
  if (!std::isfinite(sum)) system_.blame_not_finite();
  return std::isfinite(sum);
}

void BaumgarteEquations::calc_jacobian(double t, double c, const double* y, const double* y_dot) {
  matrix_.evaluate(t, c, y, y + v(), y + z(), y + lambda(), y_dot + v());
}

}  // namespace yoke
