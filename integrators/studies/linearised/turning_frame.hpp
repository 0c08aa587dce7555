// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The linear equations of a motion in a basis of allowed motions that turns smoothly along it.
//
// Reduction finds at each state some basis N of what the joints allow, orthonormal in the masses, and
// its least rate N' (modes.hpp); the next state may have another, turned at will. A variation beside
// the motion is dq = N a, dv = N b + N' a, whatever the basis: a = N^T M dq, b = N^T M dv. Of all the
// turned bases N R the one nearest to a reference N_r is taken, N_r^T M N R = S symmetric (polar
// decomposition), which is smooth in time. It turns within itself at the rate W = (N R)^T M (N R)':
//   S' = N_r^T M N' R + S W = S'^T      =>  S W + W S = X^T - X,  X = N_r^T M N' R
//   a' = b - W a       b' = -K a - C b + N^T Q_z dz - W b
#pragma once

#include <Eigen/Core>

#include <yoke/integrators/analyses/reduction/reduction.hpp>

namespace yoke {

class TurningFrame {
 public:
  explicit TurningFrame(const System& system);

  /// At `state`, on the constraints with its accelerations and multipliers. Throws ModelError as
  /// Reduction::compute(), and if the number of degrees of freedom has changed since refer().
  void at(System& system, const State& state);
  /// Takes the basis of the last at() as the reference, as it is.
  void refer();

  int freedom() const { return static_cast<int>(N_.cols()); }
  const Eigen::MatrixXd& basis() const { return N_; }            ///< N R [n x f]
  const Eigen::MatrixXd& basis_rate() const { return N_rate_; }  ///< N' R [n x f]
  const Eigen::VectorXd& mass() const { return mass_; }          ///< [n]
  /// Of (a, b, dz)' [2 f + nz square].
  const Eigen::MatrixXd& A() const { return A_; }
  /// Smallest cosine between the basis and the reference.
  double alignment() const { return alignment_; }

 private:
  using Matrix = Eigen::MatrixXd;
  void turn(Eigen::Index f);

  Eigen::VectorXd mass_;
  Reduction reduced_;
  Matrix reference_;  // N_r^T M [f x n]
  Matrix N_, N_rate_, A_;
  double alignment_ = 1.0;
};

}  // namespace yoke
