// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/equations/acceleration_matrix.hpp>

#include <array>

namespace yoke {

AccelerationMatrix::AccelerationMatrix(System& system, const Baumgarte& stabilisation)
    : n_(system.dofs()),
      nz_(system.states()),
      rows_(system.rows()),
      stabilisation_(stabilisation),
      matrix_(system, layout()),
      lambda_(system) {}

MatrixLayout AccelerationMatrix::layout() const {
  // The factors handed over in evaluate().
  enum Factor { plus, minus, shift, two, two_alpha, beta_squared, shifted };
  const int q = 0, r_q = 0, r_v = v(), r_z = z(), r_l = lambda();
  return {.size = 2 * n_ + nz_ + rows_,
          .placements = {{Block::coordinates, r_q, q, shift},
                         {Block::coordinates, r_q, v(), minus},
                         {Block::K_lambda, r_v, q, plus},
                         {Block::Q_q, r_v, q, minus},
                         {Block::mass, r_v, v(), shift},
                         {Block::Q_v, r_v, v(), minus},
                         {Block::Q_z, r_v, z(), minus},
                         {Block::G_T, r_v, lambda(), plus},
                         {Block::Q_lambda, r_v, lambda(), minus},
                         {Block::z_q, r_z, q, minus},
                         {Block::z_v, r_z, v(), minus},
                         {Block::states, r_z, z(), shift},
                         {Block::z_z, r_z, z(), minus},
                         {Block::z_lambda, r_z, lambda(), minus},
                         {Block::H_second, r_l, q, plus},
                         {Block::H, r_l, q, two_alpha},
                         {Block::G_position, r_l, q, beta_squared},
                         {Block::G, r_l, v(), shifted},
                         {Block::H, r_l, v(), two},
                         {Block::dropped, r_l, lambda(), plus},
                         {Block::open, r_l, lambda(), plus}},
          .rows = {{Unit::coordinate, r_q, 1},
                   {Unit::force, r_v, 2},
                   {Unit::state, r_z, 1},
                   {Unit::equation, r_l, 2}},
          .columns = {{Unit::coordinate, q},
                      {Unit::coordinate, v(), 1},
                      {Unit::state, z()},
                      {Unit::multiplier, lambda(), 2}}};
}

void AccelerationMatrix::evaluate(double t, double c, const double* q, const double* v,
                                  const double* z, const double* lambda, const double* a) {
  c_ = c;
  const auto [alpha, beta] = stabilisation_;
  matrix_.evaluate({.t = t, .q = q, .v = v, .z = z, .lambda = lambda_.kept(lambda), .v_second = a},
                   std::array{1.0, -1.0, c, 2.0, 2.0 * alpha, beta * beta, c + 2.0 * alpha});
}

}  // namespace yoke
