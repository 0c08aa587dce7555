// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Linearisation about a state, and natural modes of the constrained mechanism.
//
// With N the basis of motions the joints allow, G N = 0, orthonormal in the metric of the masses,
// N^T M N = 1, a neighbouring motion is q + N p, and to first order
//   p.. + C p. + K p = N^T Q_z dz       C = -N^T Q_v N
//                                       K = N^T (K_lambda - Q_q) N - N^T Q_v N' - N'^T M N'
//   dz. = z_v N p. + (z_q N + z_v N') p + z_z dz
// K_lambda = d(G^T lambda)/dq is the curvature of the joints under their reactions. N' is the rate
// of the basis, N' = -M^-1 G^T (G M^-1 G^T)^-1 H N with H = d(G v + Phi_t)/dq: of all bases of the
// allowed motions this one turns least, N^T M N' = 0, and its second derivative enters as
// N^T M N'' = -N'^T M N'. So the equations are exact at rest as well as about a motion, where the
// centrifugal terms are in N'^T M N'; about a motion the coefficients change with time, and modes
// are those of the instant.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>
#include <string>
#include <vector>

#include <yoke/core/model.hpp>

namespace yoke {

/// Largest number of coordinates (3 per body) and element states together for which the reduced
/// matrices, which are dense, are made; modes() finds the lowest modes of larger models without them.
inline constexpr int largest_linearisation = 1500;

/// The matrices of the linear equations, full and reduced.
struct Linearisation {
  using Sparse = Eigen::SparseMatrix<double>;  // matrices of the whole model
  State state;                                 // where, with accelerations and multipliers
  Eigen::VectorXd mass;                        // [n] diagonal of M, n = 3 bodies [kg, kg, kg m^2]
  Eigen::VectorXd metric;      // [n] the same, next to nothing where a body has no mass or inertia
  Sparse C;                    // [n x n] -dQ/dv
  Sparse K;                    // [n x n] d(G^T lambda)/dq - dQ/dq
  Sparse G, H;                 // [rows x n] dPhi/dq, d(G v + Phi_t)/dq; redundant rows are zero
  Sparse Q_z;                  // [n x nz]
  Sparse z_q, z_v, z_z;        // [nz x n], [nz x n], [nz x nz] of z'
  Eigen::MatrixXd basis;       // N [n x f], f degrees of freedom
  Eigen::MatrixXd basis_rate;  // N' [n x f] [1/s]
  Eigen::MatrixXd C_reduced;   // [f x f] [1/s]
  Eigen::MatrixXd K_reduced;   // [f x f] [1/s^2]
  /// y' = A y about y = (p, p', dz) [2 f + nz].
  Eigen::MatrixXd A;
  /// Empty, or why the state is no equilibrium: what moves or is accelerated most.
  std::string warning;

  /// 3 per body less the independent equations.
  int degrees_of_freedom() const { return freedom; }
  int freedom = 0;  // degrees of freedom
};

/// About `state`, which is assembled first. Contacts are linearised as they are: in contact or
/// apart; a state from the model itself should come from equilibrium(). Throws ModelError if the
/// state is not of the model or cannot be assembled, or if the model is larger than
/// largest_linearisation.
Linearisation linearise(const Model& model, const State& state);

/// One mode: motion ~ shape exp(s t).
struct Mode {
  std::complex<double> eigenvalue;  // s [1/s]; for a pair the one with positive imaginary part
  double frequency = 0.0;           // [Hz] natural, |s| / 2 pi
  double damped_frequency = 0.0;    // [Hz] |Im s| / 2 pi
  double damping_ratio = 0.0;       // -Re s / |s|; 1 decays without swinging, -1 grows
  /// [3 nb] motion of x, y [m], angle [rad] of every body for one unit of the modal coordinate,
  /// mass-normalised: shape^H M shape = 1 [kg^-1/2]; the largest entry is real and positive.
  Eigen::VectorXcd shape;
};

struct Modes {
  std::vector<Mode> modes;      // by natural frequency; a rigid-body motion has frequency 0
  Linearisation linearisation;  // of which they are the modes
  /// No mode grows: every Re s < 0 or, where nothing damps, = 0. A rigid-body motion is neutral.
  bool stable = true;
};

/// How many modes are wanted.
struct ModesOptions {
  /// The lowest modes that are wanted, at least this many; 0: all, or 10 of a model that is larger
  /// than largest_linearisation.
  int lowest = 0;
};

/// One mode for each pair of conjugate eigenvalues; an overdamped coordinate gives two. Without
/// dampers and element states the symmetric problem is solved, else the general one; there an
/// eigenvalue below 1e-7 of the largest is rounding and counts as zero.
///
/// A model larger than largest_linearisation, or of more than 300 coordinates and states if `lowest`
/// is given, is not reduced: the basis and the reduced matrices in `linearisation` are empty, and the
/// modes nearest to zero are found from the sparse matrices by shift and inversion (Spectra, KLU), in
/// a time that grows with the size of a chain. `stable` then speaks of these modes only. The state
/// must be at rest. Throws ModelError for a negative number, a large model in motion, and if the
/// iteration does not converge.
Modes modes(const Model& model, const State& state, const ModesOptions& options = {});

}  // namespace yoke
