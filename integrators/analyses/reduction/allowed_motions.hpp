// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Motions the joints allow: an orthonormal basis of the null space of G W^-1/2, and what solves
// G W^-1/2 x = b in its row space. Room is made once; nothing allocates after that, which Eigen's own
// products with Householder vectors would.
#pragma once

#include <Eigen/Core>
#include <Eigen/QR>

namespace yoke {

class AllowedMotions {
 public:
  AllowedMotions(int dofs, int rows);

  /// [dofs x rows] (G W^-1/2)^T, to be written before factorise(); columns of zeros stand for no equation.
  Eigen::MatrixXd& transpose() { return transpose_; }
  /// Returns the rank.
  int factorise();
  int rank() const { return rank_; }
  /// Writes the basis [dofs x dofs - rank].
  void write_basis(Eigen::MatrixXd& basis) const;
  /// x [dofs x m]: the smallest with G W^-1/2 x = b [rows x m], of consistent equations.
  void solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) const;

 private:
  void rotate(Eigen::MatrixXd& x) const;  // by the orthogonal factor

  Eigen::MatrixXd transpose_;
  Eigen::VectorXd norm_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
  int rank_ = 0;
};

}  // namespace yoke
