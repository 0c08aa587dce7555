// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The linear equations of modes.hpp in the motions that the joints allow, element by element: no matrix
// of the whole model but G is made. Room is made once; compute() allocates nothing as long as the number
// of degrees of freedom stays, which friction that takes hold changes.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <span>
#include <vector>

#include <yoke/integrators/analyses/reduction/allowed_motions.hpp>
#include <yoke/integrators/analyses/reduction/element_blocks.hpp>

namespace yoke {

class Reduction {
 public:
  explicit Reduction(const System& system);
  /// At `state`, with its velocities and multipliers as they are; each force and its derivatives are
  /// multiplied by its `share` [forces], empty: 1. Throws ModelError if a body without mass could move
  /// without any mass moving, if a force follows the reactions it makes, or if a derivative is not finite.
  void compute(System& system, const State& state, std::span<const double> share = {});

  /// As in Linearisation.
  const Eigen::MatrixXd& basis() const { return N_; }
  const Eigen::MatrixXd& basis_rate() const { return N_rate_; }
  const Eigen::MatrixXd& C() const { return C_; }
  const Eigen::MatrixXd& K() const { return K_; }
  const Eigen::MatrixXd& A() const { return A_; }

 private:
  using Matrix = Eigen::MatrixXd;

  void find_basis(const System& system);
  void find_basis_rate(const System& system);
  void add_constraints(const System& system);
  void add_force(const System& system, const ForceSlot& force, double share);
  void add_block(std::span<const int> dofs, const double* block, double factor, const Matrix& right,
                 Matrix& to);
  void add_row(std::span<const int> dofs, const double* row, double factor, const Matrix& motions,
               Eigen::Index to_row, Eigen::Index to_column, Matrix& to) const;
  void make_orthonormal();

  Eigen::VectorXd mass_, root_;  // diagonals of M and of the root of the metric
  bool massless_ = false;
  std::vector<double> lambda_;
  AllowedMotions allowed_;
  ForceBlocks force_;
  ConstraintBlocks constraint_;
  LoadCheck loads_;
  Matrix N_, N_rate_, C_, K_, A_;
  Matrix HN_;               // [rows x f] -H N
  Matrix weighted_, gram_;  // [n x f] M N and so on, [f x f]
  Eigen::LLT<Matrix> factor_;
  Eigen::VectorXd left_;
  Eigen::RowVectorXd right_;
};

}  // namespace yoke
