// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <Eigen/SparseQR>

#include <yoke/core/equations/rank.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

constexpr double dependent_below = 1e-8;
constexpr double negligible_in_null_vector = 1e-9;  // in a null vector whose largest entry is 1
// An equation that is left out for another must make the others at least so many times as independent
// (the volume of their normalised gradients).
constexpr double worth_exchanging = 10.0;
constexpr double as_good = 0.5;

// G^T with lengths in units of the length scale, every equation normalised to one; `norm` [rows].
Matrix scaled_transpose(const System& system, const std::vector<char>& ignored,
                        std::vector<double>& norm) {
  const double length = system.scales().length;
  norm.assign(at(system.rows()), 0.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (const ConstraintSlot& c : system.joints()) {
    for (int i = 0; i < c.rows; ++i) {
      if (!ignored.empty() && ignored[at(c.row + i)] != 0) continue;
      const std::size_t first = entries.size();
      double square = 0.0;
      for (int j = 0; j < c.columns; ++j) {
        const int dof = system.dof()[at(c.dofs + j)];
        const double g = system.G()[c.block + i * c.columns + j];
        if (dof < 0 || g == 0.0) continue;
        const double value = dof % 3 == 2 ? g : g * length;
        entries.emplace_back(dof, c.row + i, value);
        square += value * value;
      }
      if (square == 0.0) continue;  // an equation no coordinate can satisfy: dependent
      norm[at(c.row + i)] = std::sqrt(square);
      for (std::size_t k = first; k < entries.size(); ++k)
        entries[k] = {entries[k].row(), entries[k].col(), entries[k].value() / std::sqrt(square)};
    }
  }
  Matrix transpose(system.dofs(), system.rows());
  transpose.setFromTriplets(entries.begin(), entries.end());
  transpose.makeCompressed();
  return transpose;
}

class Qr {
 public:
  explicit Qr(const Matrix& a) : a_(a) { qr_.analyzePattern(a_); }
  int factorise(double threshold) {
    qr_.setPivotThreshold(threshold);
    qr_.factorize(a_);
    return static_cast<int>(qr_.rank());
  }
  int column(Eigen::Index i) const { return qr_.colsPermutation().indices()(i); }

  // The i-th vector w with A w = 0: one of the dependent columns and what it is made of. Not from R
  // itself, which lacks what was below the threshold when the column was put aside.
  Eigen::VectorXd null_vector(Eigen::Index i) const {
    const Eigen::Index rank = qr_.rank();
    const Eigen::VectorXd dependent = a_.col(column(rank + i));
    Eigen::VectorXd x = qr_.matrixQ().transpose() * dependent;
    x.conservativeResize(rank);
    const Matrix r = qr_.matrixR().topLeftCorner(rank, rank);
    r.triangularView<Eigen::Upper>().solveInPlace(x);
    Eigen::VectorXd w = Eigen::VectorXd::Zero(a_.cols());
    for (Eigen::Index k = 0; k < rank; ++k) w[column(k)] = -x[k];
    w[column(rank + i)] = 1.0;
    return w;
  }

 private:
  const Matrix& a_;
  // Natural ordering: a column that depends on earlier ones is the one to be left out.
  Eigen::SparseQR<Matrix, Eigen::NaturalOrdering<int>> qr_;
};

/// A basis of equations: `order` [rows], the `rank` first are kept. Those kept are exchanged for those
/// left out as long as that is worth it; the null vectors are of the basis in the end.
class Basis {
 public:
  Basis(const Matrix& transpose, const Qr& qr, int rank) : transpose_(transpose), rank_(rank) {
    std::vector<int> as_added(at(static_cast<int>(transpose.cols())));
    std::iota(as_added.begin(), as_added.end(), 0);
    take(qr, as_added);
    for (int i = 0; i < most_exchanges && exchange(); ++i) {
    }
  }
  int dependent(std::size_t k) const { return order_[at(rank_) + k]; }
  const std::vector<Eigen::VectorXd>& null_vectors() const { return null_vectors_; }

 private:
  static constexpr int most_exchanges = 100;

  /// What `qr` found of the equations in the order `rows`.
  void take(const Qr& qr, const std::vector<int>& rows) {
    order_.clear();
    null_vectors_.clear();
    for (int i = 0; i < transpose_.cols(); ++i) order_.push_back(rows[at(qr.column(i))]);
    for (Eigen::Index i = 0; i < transpose_.cols() - rank_; ++i) {
      const Eigen::VectorXd w = qr.null_vector(i);
      Eigen::VectorXd& of_rows = null_vectors_.emplace_back(w.size());
      for (Eigen::Index k = 0; k < w.size(); ++k) of_rows[rows[at(static_cast<int>(k))]] = w[k];
    }
  }

  /// The most worthwhile one, of equals the one that leaves out what was added last; false if there is
  /// none.
  bool exchange() {
    double most = worth_exchanging;
    std::size_t in = 0, out = 0;
    const auto gain = [&](std::size_t k, std::size_t i) {
      return std::abs(null_vectors_[k][order_[i]]);
    };
    for (std::size_t k = 0; k < null_vectors_.size(); ++k)
      for (std::size_t i = 0; i < at(rank_); ++i)
        if (gain(k, i) > most) {
          most = gain(k, i);
          in = k;
          out = i;
        }
    if (most == worth_exchanging) return false;
    for (std::size_t i = 0; i < at(rank_); ++i)
      if (gain(in, i) > as_good * most && order_[i] > order_[out]) out = i;
    in += at(rank_);
    std::vector<int> other = order_;
    std::swap(other[in], other[out]);
    Matrix permuted(transpose_.rows(), transpose_.cols());
    for (std::size_t i = 0; i < other.size(); ++i)
      permuted.col(static_cast<Eigen::Index>(i)) = transpose_.col(other[i]);
    permuted.makeCompressed();
    Qr qr(permuted);
    if (qr.factorise(dependent_below) != rank_) return false;
    take(qr, other);
    return true;
  }

  const Matrix& transpose_;
  int rank_;
  std::vector<int> order_;
  std::vector<Eigen::VectorXd> null_vectors_;
};

}  // namespace

RankAnalysis analyse_rank(const System& system, const std::vector<char>& ignored) {
  std::vector<double> norm;
  const Matrix transpose = scaled_transpose(system, ignored, norm);
  RankAnalysis analysis;
  if (transpose.cols() == 0) return analysis;
  Qr qr(transpose);
  analysis.rank = qr.factorise(dependent_below);
  if (analysis.rank == transpose.cols()) return analysis;
  double threshold = 0.1;
  while (qr.factorise(threshold) != analysis.rank && threshold > dependent_below)
    threshold = std::max(0.1 * threshold, dependent_below);
  const Basis basis(transpose, qr, analysis.rank);
  std::vector<Eigen::Triplet<double>> entries;
  int column = 0;
  for (std::size_t i = 0; i < basis.null_vectors().size(); ++i) {
    const int row = basis.dependent(i);
    if (system.is_of_velocity_level(row)) continue;
    if (!ignored.empty() && ignored[at(row)] != 0) continue;
    analysis.dependent.push_back(row);
    Eigen::VectorXd w = basis.null_vectors()[i];
    w /= w.cwiseAbs().maxCoeff();
    for (int k = 0; k < system.rows(); ++k)
      if (std::abs(w[k]) > negligible_in_null_vector)
        entries.emplace_back(k, column, norm[at(k)] > 0.0 ? w[k] / norm[at(k)] : w[k]);
    ++column;
  }
  analysis.null_space.resize(system.rows(), column);
  analysis.null_space.setFromTriplets(entries.begin(), entries.end());
  std::ranges::sort(analysis.dependent, std::greater<>());
  return analysis;
}

Eigen::MatrixXd null_vectors(const Eigen::SparseMatrix<double>& a, double threshold) {
  if (a.cols() == 0) return {};
  Qr qr(a);
  const Eigen::Index rank = qr.factorise(threshold);
  Eigen::MatrixXd vectors(a.cols(), a.cols() - rank);
  for (Eigen::Index i = 0; i < vectors.cols(); ++i) vectors.col(i) = qr.null_vector(i);
  return vectors;
}

}  // namespace yoke
