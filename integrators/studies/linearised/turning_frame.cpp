// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/linearised/turning_frame.hpp>

#include <Eigen/SVD>

#include <yoke/core/error.hpp>

namespace yoke {

TurningFrame::TurningFrame(const System& system)
    : mass_(Eigen::Map<const Eigen::VectorXd>(system.mass().data(), system.dofs())),
      reduced_(system) {}

void TurningFrame::at(System& system, const State& state) {
  reduced_.compute(system, state);
  N_ = reduced_.basis();
  N_rate_ = reduced_.basis_rate();
  A_ = reduced_.A();
  alignment_ = 1.0;
  if (reference_.rows() == 0) return;
  if (reference_.rows() != N_.cols())
    throw ModelError(fmt::format(
        "variation: at t = {:.9g} s the number of degrees of freedom changes from {} to {}",
        state.t, reference_.rows(), N_.cols()));
  turn(N_.cols());
}

void TurningFrame::turn(Eigen::Index f) {
  const Eigen::JacobiSVD<Matrix> svd(reference_ * N_, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Matrix& U = svd.matrixU();
  const Eigen::VectorXd& s = svd.singularValues();
  alignment_ = s[f - 1];
  const Matrix R = svd.matrixV() * U.transpose();
  N_ *= R;
  N_rate_ *= R;
  const Matrix X = U.transpose() * (reference_ * N_rate_) * U;
  Matrix W(f, f);
  for (Eigen::Index i = 0; i < f; ++i)
    for (Eigen::Index j = 0; j < f; ++j) W(i, j) = (X(j, i) - X(i, j)) / (s[i] + s[j]);
  W = U * W * U.transpose();
  const auto rotate_block = [&](Eigen::Index row, Eigen::Index column) {
    A_.block(row, column, f, f) = R.transpose() * A_.block(row, column, f, f) * R;
  };
  rotate_block(f, 0);
  rotate_block(f, f);
  const Eigen::Index nz = A_.rows() - 2 * f;
  A_.block(f, 2 * f, f, nz) = R.transpose() * A_.block(f, 2 * f, f, nz);
  A_.block(2 * f, 0, nz, f) *= R;
  A_.block(2 * f, f, nz, f) *= R;
  A_.block(0, 0, f, f) -= W;
  A_.block(f, f, f, f) -= W;
}

void TurningFrame::refer() { reference_ = N_.transpose() * mass_.asDiagonal(); }

}  // namespace yoke
