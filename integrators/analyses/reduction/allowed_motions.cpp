// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/reduction/allowed_motions.hpp>

namespace yoke {

namespace {
constexpr double dependent_below = 1e-9;  // of an equation normalised to one
}

AllowedMotions::AllowedMotions(int dofs, int rows)
    : transpose_(Eigen::MatrixXd::Zero(dofs, rows)), norm_(rows), qr_(dofs, rows) {
  qr_.setThreshold(dependent_below);
}

int AllowedMotions::factorise() {
  rank_ = 0;
  if (transpose_.cols() == 0) return rank_;
  for (Eigen::Index i = 0; i < norm_.size(); ++i) {
    norm_[i] = transpose_.col(i).norm();
    if (norm_[i] > 0.0) transpose_.col(i) /= norm_[i];
  }
  qr_.compute(transpose_);
  rank_ = static_cast<int>(qr_.rank());
  return rank_;
}

void AllowedMotions::rotate(Eigen::MatrixXd& x) const {
  const Eigen::Index n = transpose_.rows();
  for (Eigen::Index k = qr_.hCoeffs().size() - 1; k >= 0; --k) {
    const auto v = qr_.matrixQR().col(k).tail(n - k - 1);
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      const double s = qr_.hCoeffs()[k] * (x(k, j) + v.dot(x.col(j).tail(n - k - 1)));
      x(k, j) -= s;
      x.col(j).tail(n - k - 1) -= s * v;
    }
  }
}

void AllowedMotions::write_basis(Eigen::MatrixXd& basis) const {
  const Eigen::Index n = transpose_.rows();
  basis.setZero(n, n - rank_);
  basis.bottomRows(n - rank_).setIdentity();
  if (rank_ > 0) rotate(basis);
}

void AllowedMotions::solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) const {
  x.setZero(transpose_.rows(), b.cols());
  if (rank_ == 0) return;
  const auto& R = qr_.matrixQR();
  const auto& equation = qr_.colsPermutation().indices();
  for (Eigen::Index j = 0; j < b.cols(); ++j)
    for (Eigen::Index i = 0; i < rank_; ++i) {
      const Eigen::Index row = equation[i];
      const double left = b(row, j) / norm_[row];
      x(i, j) = (left - R.col(i).head(i).dot(x.col(j).head(i))) / R(i, i);
    }
  rotate(x);
}

}  // namespace yoke
