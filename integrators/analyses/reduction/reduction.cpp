// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/reduction/reduction.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/core/equations/linear/index.hpp>
#include <yoke/core/equations/scaled_saddle.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

Reduction::Reduction(const System& system)
    : mass_(Eigen::Map<const Eigen::VectorXd>(system.mass().data(), system.dofs())),
      root_(system.dofs()),
      massless_(system.has_massless()),
      lambda_(at(system.rows())),
      allowed_(system.dofs(), system.rows()),
      force_(system),
      constraint_(system),
      loads_(system) {
  const std::vector<double> metric = metric_of_masses(system);
  for (int i = 0; i < system.dofs(); ++i) root_[i] = std::sqrt(metric[at(i)]);
}

void Reduction::compute(System& system, const State& state, std::span<const double> share) {
  system.bind(state);
  system.set_motion(state.t, state.q.data(), state.v.data());
  loads_.refuse(system, state.lambda.data());
  std::copy(state.lambda.begin(), state.lambda.end(), lambda_.begin());
  for (const int row : system.dropped_rows()) lambda_[at(row)] = 0.0;
  find_basis(system);
  const Eigen::Index f = N_.cols(), nz = system.states();
  C_.setZero(f, f);
  K_.setZero(f, f);
  A_.setZero(2 * f + nz, 2 * f + nz);
  left_.resize(f);
  right_.resize(f);
  add_constraints(system);
  find_basis_rate(system);
  system.set_multipliers(lambda_.data());
  for (std::size_t i = 0; i < system.forces().size(); ++i)
    add_force(system, system.forces()[i], share.empty() ? 1.0 : share[i]);
  system.set_multipliers(nullptr);
  A_.block(0, f, f, f).setIdentity();
  A_.block(f, 0, f, f) = -K_;
  A_.block(f, f, f, f) = -C_;
  if (!A_.allFinite())
    throw ModelError("linearisation: a derivative of an element is not finite at this state");
}

void Reduction::find_basis(const System& system) {
  Matrix& transpose = allowed_.transpose();
  transpose.setZero();
  for (const ConstraintSlot& c : system.constraints()) {
    constraint_.evaluate(system, c, lambda_.data());
    const double* entry = constraint_.G.data();
    for (int i = 0; i < c.rows; ++i)
      for (int j = 0; j < c.columns; ++j, ++entry) {
        const int dof = system.dof()[at(c.dofs + j)];
        if (dof >= 0 && !system.is_dropped(c.row + i))
          transpose(dof, c.row + i) += *entry / root_[dof];
      }
  }
  allowed_.factorise();
  allowed_.write_basis(N_);
  N_.array().colwise() /= root_.array();
  if (!massless_) return;
  make_orthonormal();  // twice: the first time removes the large ratios of the metric
  make_orthonormal();
}

// N of the positive metric becomes orthonormal in the masses, which leave part of the coordinates
// out but no motion that the joints allow: N := N L^-T with L L^T = N^T M N.
void Reduction::make_orthonormal() {
  weighted_ = N_;
  weighted_.array().colwise() *= mass_.array();
  gram_ = N_.transpose().lazyProduct(weighted_);
  factor_.compute(gram_);
  if (factor_.info() != Eigen::Success)
    throw ModelError(
        "linearisation: a body without mass could move without any mass moving at this state");
  const Matrix& L = factor_.matrixLLT();  // its lower triangle
  for (Eigen::Index j = 0; j < N_.cols(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) N_.col(j) -= L(j, i) * N_.col(i);
    N_.col(j) /= L(j, j);
  }
}

// HN := -H N; K += N^T K_lambda N.
void Reduction::add_constraints(const System& system) {
  HN_.setZero(system.rows(), N_.cols());
  for (const ConstraintSlot& c : system.constraints()) {
    constraint_.evaluate(system, c, lambda_.data());
    const std::span<const int> dofs = system.dof().subspan(at(c.dofs), at(c.columns));
    for (int i = 0; i < c.rows; ++i)
      if (!system.is_dropped(c.row + i))
        add_row(dofs, constraint_.H.data() + i * c.columns, -1.0, N_, c.row + i, 0, HN_);
    add_block(dofs, constraint_.K.data(), 1.0, N_, K_);
  }
}

// And K -= N'^T M N'.
void Reduction::find_basis_rate(const System& system) {
  if (system.rows() > 0)
    allowed_.solve(HN_, N_rate_);
  else
    N_rate_.setZero(N_.rows(), N_.cols());
  N_rate_.array().colwise() /= root_.array();
  if (massless_) {  // the same change of the joints, but N^T M N' = 0
    weighted_ = N_rate_;
    weighted_.array().colwise() *= mass_.array();
    gram_ = N_.transpose().lazyProduct(weighted_);
    N_rate_ -= N_.lazyProduct(gram_);
  }
  weighted_ = N_rate_;
  weighted_.array().colwise() *= mass_.array();
  K_ -= N_rate_.transpose().lazyProduct(weighted_);
}

void Reduction::add_force(const System& system, const ForceSlot& force, double share) {
  if (!force_.evaluate(system, force)) return;
  const std::span<const int> dofs = system.dof().subspan(at(force.dofs), at(force.columns));
  const Eigen::Index f = N_.cols();
  add_block(dofs, force_.Q_v.data(), -share, N_, C_);
  add_block(dofs, force_.Q_q.data(), -share, N_, K_);
  add_block(dofs, force_.Q_v.data(), -share, N_rate_, K_);
  for (int i = 0; i < force.states; ++i) {
    const Eigen::Index z = 2 * f + force.z + i;
    const int start = i * force.columns;
    add_row(dofs, force_.z_q.data() + start, 1.0, N_, z, 0, A_);
    add_row(dofs, force_.z_v.data() + start, 1.0, N_rate_, z, 0, A_);
    add_row(dofs, force_.z_v.data() + start, 1.0, N_, z, f, A_);
    for (int j = 0; j < force.states; ++j)
      A_(z, 2 * f + force.z + j) += force_.z_z[at(i * force.states + j)];
    for (int j = 0; j < force.columns; ++j)
      if (dofs[at(j)] >= 0)
        A_.col(z).segment(f, f) +=
            (share * force_.Q_z[at(j * force.states + i)]) * N_.row(dofs[at(j)]).transpose();
  }
}

// to += factor N^T block right, of an element's rows.
void Reduction::add_block(std::span<const int> dofs, const double* block, double factor,
                          const Matrix& right, Matrix& to) {
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (dofs[i] < 0) continue;
    right_.setZero();
    bool any = false;
    for (std::size_t j = 0; j < dofs.size(); ++j) {
      const double entry = block[i * dofs.size() + j];
      if (dofs[j] < 0 || entry == 0.0) continue;
      right_ += entry * right.row(dofs[j]);
      any = true;
    }
    if (!any) continue;
    left_ = factor * N_.row(dofs[i]).transpose();
    to += left_.lazyProduct(right_);
  }
}

// A row of an element times motions.
void Reduction::add_row(std::span<const int> dofs, const double* row, double factor,
                        const Matrix& motions, Eigen::Index to_row, Eigen::Index to_column,
                        Matrix& to) const {
  for (std::size_t j = 0; j < dofs.size(); ++j)
    if (dofs[j] >= 0 && row[j] != 0.0)
      to.row(to_row).segment(to_column, motions.cols()) += (factor * row[j]) * motions.row(dofs[j]);
}

}  // namespace yoke
