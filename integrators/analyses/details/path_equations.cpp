// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/details/path_equations.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

constexpr int max_corrections = 12;
constexpr double good_path_residual =
    1e-7;                                 // of F, scaled: what rounding of a stiff contact leaves
constexpr double good_path_step = 1e-10;  // of the last Newton step in length scales or rad
constexpr double hold = 1e-9;             // scaled inertia where some motions cost nothing

using Vector = Eigen::VectorXd;

}  // namespace

Vector PathEquations::point(const Vector& x, double progress) const {
  Vector y(x.size() + 1);
  y << x, progress;
  return y;
}

bool PathEquations::residual(const Vector& y, Vector& F) {
  set_(progress(y));
  return statics_.residual(y.head(y.size() - 1), F);
}

Vector PathEquations::border(const Vector& direction) const {
  Vector b = Vector::Zero(direction.size());
  const Eigen::Index n = statics_.positions();
  for (Eigen::Index i = 0; i < n; ++i) b[i] = direction[i] / (i % 3 == 2 ? 1.0 : reach_ * reach_);
  b[b.size() - 1] = progress(direction);
  return b;
}

double PathEquations::largest(const Vector& d) const {
  return std::max(
      {statics_.largest_displacement(d) / reach_, statics_.largest_turn(d), std::abs(progress(d))});
}

bool PathEquations::slope(const Vector& y, Vector& F_p) {
  Vector ahead = y, behind = y, F_behind;
  ahead[y.size() - 1] += step_;
  behind[y.size() - 1] -= step_;
  if (!residual(ahead, F_p) || !residual(behind, F_behind)) return false;
  F_p = (F_p - F_behind) / (2.0 * step_);
  return true;
}

bool PathEquations::factorise(const Vector& y, const Vector& border) {
  Vector F_p;
  if (!slope(y, F_p)) return false;
  set_(progress(y));
  const Vector x = y.head(y.size() - 1);
  return factorise_bordered(statics_.calc_matrix(x), F_p, border) ||
         factorise_bordered(statics_.calc_matrix(x, hold), F_p, border);
}

bool PathEquations::factorise_bordered(const Tangent::Matrix& inner, const Vector& column,
                                       const Vector& border) {
  const int last = static_cast<int>(inner.cols()), size = last + 1;
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < last; ++k)
    for (Tangent::Matrix::InnerIterator it(inner, k); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), k, it.value());
  for (int i = 0; i < last; ++i) {
    if (column[i] != 0.0) entries.emplace_back(i, last, column[i]);
    if (border[i] != 0.0) entries.emplace_back(last, i, border[i]);
  }
  entries.emplace_back(last, last, border[last]);
  PatternBuilder pattern(size);
  for (const Eigen::Triplet<double>& e : entries) pattern.add(e.row(), e.col());
  std::vector<int> slot;
  SparseMatrix matrix = pattern.compile(slot);
  for (std::size_t i = 0; i < entries.size(); ++i) matrix.value[at(slot[i])] += entries[i].value();
  lu_ = std::make_unique<SparseLU>(matrix);
  return lu_->factorise(matrix);
}

bool PathEquations::solve(Vector& b) {
  lu_->solve(b.data());
  return b.allFinite();
}

bool PathEquations::correct(Vector& y, const Vector& border, double target) {
  Vector z = y, F;
  if (!residual(z, F)) return false;
  for (int i = 0; i < max_corrections; ++i) {
    ++iterations_;
    if (!factorise(z, border)) return false;
    Vector step(z.size());
    step << -F, target - border.dot(z);
    if (!solve(step)) return false;
    const Vector next = z + step;
    Vector F_next;
    const double norm = F.cwiseAbs().maxCoeff();
    const bool better = residual(next, F_next) && F_next.cwiseAbs().maxCoeff() < norm;
    if (better) z = next, F = F_next;
    set_(progress(z));
    if ((largest(step) < good_path_step && norm < good_path_residual) ||
        (!better && statics_.is_rounding(z.head(z.size() - 1), F)))
      return y = z, true;
    if (!better) return false;
  }
  return false;
}

bool PathEquations::tangent(const Vector& y, const Vector& border, Vector& direction) {
  if (!factorise(y, border)) return false;
  Vector t = Vector::Unit(y.size(), y.size() - 1);
  if (!solve(t)) return false;
  const double size = norm(t);
  if (!(size > 0.0) || !std::isfinite(size)) return false;
  direction = t / size;
  return true;
}

}  // namespace yoke
