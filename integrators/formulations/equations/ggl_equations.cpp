// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/equations/ggl_equations.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

GglEquations::GglEquations(System& system)
    : system_(system),
      n_(system.dofs()),
      nz_(system.states()),
      rows_(system.rows()),
      size_(2 * n_ + nz_ + 2 * rows_),
      matrix_(system, layout()),
      lambda_(system),
      mu_(system) {
  force_.assign(at(n_) + 1, 0.0);
  stabilisation_ = force_;
}

MatrixLayout GglEquations::layout() const {
  enum Factor { plus, minus, shift };  // the factors handed over in calc_jacobian()
  const int q = 0, r_q = 0, r_v = v(), r_z = z(), r_p = lambda(), r_w = mu();
  return {.size = size_,
          .placements = {{Block::mass, r_q, q, shift},
                         {Block::mass, r_q, v(), minus},
                         {Block::K_mu, r_q, q, plus},
                         {Block::G_T, r_q, mu(), plus},
                         {Block::K_lambda, r_v, q, plus},
                         {Block::Q_q, r_v, q, minus},
                         {Block::mass, r_v, v(), shift},
                         {Block::Q_v, r_v, v(), minus},
                         {Block::Q_z, r_v, z(), minus},
                         {Block::G_T, r_v, lambda(), plus},
                         {Block::z_q, r_z, q, minus},
                         {Block::z_v, r_z, v(), minus},
                         {Block::states, r_z, z(), shift},
                         {Block::z_z, r_z, z(), minus},
                         {Block::G_position, r_p, q, plus},
                         {Block::dropped, r_p, lambda(), plus},
                         {Block::Q_lambda, r_v, lambda(), minus},
                         {Block::z_lambda, r_z, lambda(), minus},
                         {Block::hold, r_p, mu(), plus},
                         {Block::H, r_w, q, plus},
                         {Block::G, r_w, v(), plus},
                         {Block::dropped, r_w, mu(), plus},
                         {Block::open, r_w, lambda(), plus}},
          .rows = {{Unit::force, r_q, 1},
                   {Unit::force, r_v, 2},
                   {Unit::state, r_z, 1},
                   {Unit::equation, r_p},
                   {Unit::equation, r_w, 1}},
          .columns = {{Unit::coordinate, q},
                      {Unit::coordinate, v(), 1},
                      {Unit::state, z()},
                      {Unit::multiplier, lambda(), 2},
                      {Unit::multiplier, mu(), 1}}};
}

bool GglEquations::calc_residual(double t, const double* y, const double* y_dot, double* residual) {
  system_.set_motion(t, y, y + v());
  system_.set_states(y + z());
  system_.calc_position_level(residual + lambda());
  system_.calc_velocity_residual(residual + mu());

  double* r_q = residual;
  double* r_v = residual + v();
  double* r_z = residual + z();
  double* force = force_.data();
  std::ranges::fill(force_, 0.0);
  system_.set_multipliers(lambda_.kept(y + lambda()));
  system_.add_forces(force, r_z, nullptr);
  system_.subtract_constraint_forces(lambda_.kept(y + lambda()), force);
  double* stabilisation = stabilisation_.data();
  std::ranges::fill(stabilisation_, 0.0);
  system_.subtract_constraint_forces(mu_.kept(y + mu()), stabilisation);
  for (const int i : system_.left_out_rows()) {
    residual[lambda() + i] = y[lambda() + i];
    residual[mu() + i] = y[mu() + i];
  }
  for (const ConstraintSlot& c : system_.holds()) {
    residual[lambda() + c.row] = y[mu() + c.row];
    if (system_.is_dropped(c.row)) residual[mu() + c.row] = y[lambda() + c.row];
  }
  double sum = 0.0;
  for (int i = 0; i < n_; ++i) {
    const double mass = system_.mass()[at(i)];
    r_q[i] = mass * (y_dot[i] - y[v() + i]) - stabilisation[i];
    r_v[i] = mass * y_dot[v() + i] - force[i];
    sum += r_q[i] + r_v[i];
  }
  for (int i = 0; i < nz_; ++i) {
    r_z[i] = y_dot[z() + i] - r_z[i];
    sum += r_z[i];
  }
  for (int i = lambda(); i < size_; ++i) sum += residual[i];
  if (!std::isfinite(sum)) system_.blame_not_finite();
  return std::isfinite(sum);
}

void GglEquations::calc_jacobian(double t, double c, const double* y, const double*) {
  c_ = c;
  matrix_.evaluate({.t = t,
                    .q = y,
                    .v = y + v(),
                    .z = y + z(),
                    .lambda = lambda_.kept(y + lambda()),
                    .mu = mu_.kept(y + mu())},
                   std::array{1.0, -1.0, c});
}

}  // namespace yoke
