// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The derivatives of all elements at one state as sparse matrices, for analyses that look at a
// state once; integrators have iteration_matrix.hpp.
#pragma once

#include <Eigen/SparseCore>
#include <span>

#include <yoke/core/equations/system.hpp>

namespace yoke {

struct Tangent {
  using Matrix = Eigen::SparseMatrix<double>;
  Matrix Q_q, Q_v, Q_z;  // of the forces by q [n x n], v [n x n], z [n x nz]
  Matrix z_q, z_v, z_z;  // of z' by q [nz x n], v [nz x n], z [nz x nz]
  Matrix K_lambda;       // d(G^T lambda)/dq [n x n]
  Matrix G, H;           // dPhi/dq and d(G v + Phi_t)/dq [rows x n]; no rows that are dropped
};

/// Throws ModelError if a force changes with the reactions at this state, which no block of a Tangent
/// says.
void refuse_loads(System& system, const State& state);

/// At `state`, whose contacts are as they are. `share` [forces]: each force and its derivatives are
/// multiplied by it; empty: 1.
Tangent calc_tangent(System& system, const State& state, std::span<const double> share = {});

}  // namespace yoke
