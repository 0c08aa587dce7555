// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The lowest eigenvalues of the linearised equations at rest from the sparse saddle matrix: Arnoldi's
// or Lanczos' iteration (Spectra) on the inverse of what is shifted to just below them, which KLU
// factorises. No basis of the allowed motions is needed.
//
//   s^2 M x + s C x + K x + G^T lambda = Q_z z,  G x = 0,  s z = z_q x + s z_v x + z_z z
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include <yoke/integrators/analyses/modes.hpp>

namespace yoke {

struct LowestModes {
  std::vector<std::complex<double>> values;  // s [1/s], those nearest to zero
  std::vector<Eigen::VectorXcd> shapes;      // [n] of the coordinates
  bool complete = true;                      // all that were asked for have converged
};

/// Of the symmetric problem without dampers and states: s^2 real, one value for each, +i omega, or
/// +sqrt(-omega^2) where it is unstable. Throws ModelError if the iteration does not converge.
LowestModes lowest_undamped(const Linearisation& l, int count);
/// Of the general problem, all s of pairs. Overdamped motions crowd about -k/c, the more of them the
/// larger the model, and cannot be told apart there: after a while those that have converged are
/// returned. Throws ModelError if there are none.
LowestModes lowest_general(const Linearisation& l, int count);

}  // namespace yoke
