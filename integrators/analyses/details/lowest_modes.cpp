// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <Spectra/GenEigsSolver.h>
#include <Spectra/SymEigsSolver.h>

#include <yoke/integrators/analyses/details/lowest_modes.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

#include <yoke/core/equations/linear/index.hpp>
#include <yoke/core/equations/linear/sparse.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

constexpr double first_shift = 1e-8;  // of the largest stiffness over mass
constexpr double beside = 0.05;       // of the range of the values found, below the lowest
constexpr double near_enough = 0.3;   // of the range: a shift that need not be improved
constexpr double zero_share = 1e-8;   // of the range: a motion without stiffness
constexpr double nothing = 1e-18;     // of the largest: below all that numbers can tell
constexpr int max_rounds = 6;
constexpr double converged = 1e-12;
constexpr int max_restarts = 3000, least_restarts = 20;
constexpr double patience = 6e5;  // unknowns times restarts of the general problem

using Vector = Eigen::VectorXd;

/// Stiffness over mass of the stiffest coordinate [1/s^2], a bound for what the scales are.
double largest_rate_squared(const Linearisation& l) {
  double largest = 0.0;
  for (int k = 0; k < l.K.outerSize(); ++k)
    for (Linearisation::Sparse::InnerIterator it(l.K, k); it; ++it)
      largest = std::max(largest,
                         std::abs(it.value()) / std::sqrt(l.metric[it.row()] * l.metric[it.col()]));
  return largest > 0.0 ? largest : 1.0;
}

/// [ (K + s C + s^2 M)  -Q_z  G^T ]   in the coordinates M^1/2 x, divided by the largest rate
/// [ z_q + s z_v  z_z - s     .   ]   squared; equations of G normalised to one
/// [ G             .          .   ]
class Shifted {
 public:
  Shifted(const Linearisation& l, double shift, double unit)
      : n_(l.mass.size()), nz_(l.z_z.rows()), rows_(l.G.rows()), root_(l.metric.cwiseSqrt()) {
    Vector norm = Vector::Zero(rows_);
    for (int k = 0; k < l.G.outerSize(); ++k)
      for (Linearisation::Sparse::InnerIterator it(l.G, k); it; ++it)
        norm[it.row()] += std::pow(it.value() / root_[it.col()], 2);
    const Eigen::Index lambda = n_ + nz_;
    for (Eigen::Index i = 0; i < n_; ++i)
      if (l.mass[i] > 0.0) add(i, i, shift * shift / unit);
    add_block(l.K, 0, 0, [&](auto i, auto j) { return 1.0 / (root_[i] * root_[j] * unit); });
    add_block(l.C, 0, 0, [&](auto i, auto j) { return shift / (root_[i] * root_[j] * unit); });
    add_block(l.Q_z, 0, n_, [&](auto i, auto) { return -1.0 / (root_[i] * unit); });
    add_block(l.z_q, n_, 0, [&](auto, auto j) { return 1.0 / root_[j]; });
    add_block(l.z_v, n_, 0, [&](auto, auto j) { return shift / root_[j]; });
    add_block(l.z_z, n_, n_, [](auto, auto) { return 1.0; });
    for (Eigen::Index i = 0; i < nz_; ++i) add(n_ + i, n_ + i, -shift);
    for (int k = 0; k < l.G.outerSize(); ++k)
      for (Linearisation::Sparse::InnerIterator it(l.G, k); it; ++it) {
        const double value = it.value() / (root_[it.col()] * std::sqrt(norm[it.row()]));
        add(lambda + it.row(), it.col(), value);
        add(it.col(), lambda + it.row(), value);
      }
    for (Eigen::Index i = 0; i < rows_; ++i)
      if (norm[i] == 0.0) add(lambda + i, lambda + i, 1.0);  // left out as redundant
    factorise();
  }
  bool regular() const { return regular_; }
  /// b [n + nz] becomes the solution.
  void solve(Vector& b) {
    std::ranges::fill(work_, 0.0);
    std::copy_n(b.data(), b.size(), work_.data());
    lu_->solve(work_.data());
    std::copy_n(work_.data(), b.size(), b.data());
  }

 private:
  void add(Eigen::Index i, Eigen::Index j, double value) {
    entries_.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
  }
  template <class Factor>
  void add_block(const Linearisation::Sparse& m, Eigen::Index row, Eigen::Index column,
                 const Factor& factor) {
    for (int k = 0; k < m.outerSize(); ++k)
      for (Linearisation::Sparse::InnerIterator it(m, k); it; ++it)
        add(row + it.row(), column + it.col(), it.value() * factor(it.row(), it.col()));
  }
  void factorise() {
    const int size = static_cast<int>(n_ + nz_ + rows_);
    PatternBuilder pattern(size);
    for (const Eigen::Triplet<double>& e : entries_) pattern.add(e.row(), e.col());
    std::vector<int> slot;
    SparseMatrix matrix = pattern.compile(slot);
    for (std::size_t i = 0; i < entries_.size(); ++i)
      matrix.value[at(slot[i])] += entries_[i].value();
    lu_ = std::make_unique<SparseLU>(matrix);
    regular_ = lu_->factorise(matrix);
    work_.assign(at(size) + 1, 0.0);
  }

  Eigen::Index n_, nz_, rows_;
  Vector root_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::unique_ptr<SparseLU> lu_;
  std::vector<double> work_;
  bool regular_ = false;
};

/// x -> (K - sigma)^-1 x on the allowed motions, symmetric: what Spectra iterates with.
class InverseStiffness {
 public:
  using Scalar = double;
  InverseStiffness(const Linearisation& l, Shifted& shifted)
      : l_(&l), shifted_(&shifted), n_(l.mass.size()) {}
  Eigen::Index rows() const { return n_; }
  Eigen::Index cols() const { return n_; }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Vector>(out, n_) = only_masses(motion(Eigen::Map<const Vector>(in, n_)));
  }
  /// The whole motion: what has no mass follows from the joints.
  Vector motion(const Vector& of_masses) const {
    Vector b = only_masses(of_masses);
    shifted_->solve(b);
    return b;
  }

 private:
  Vector only_masses(Vector x) const {
    for (Eigen::Index i = 0; i < n_; ++i)
      if (l_->mass[i] == 0.0) x[i] = 0.0;
    return x;
  }

  const Linearisation* l_;
  Shifted* shifted_;
  Eigen::Index n_;
};

/// (x, v/rate, z) -> (A - shift)^-1 (x, v/rate, z), with x and v in M^1/2.
class InverseRate {
 public:
  using Scalar = double;
  InverseRate(const Linearisation& l, Shifted& shifted, double shift, double unit)
      : l_(&l), shifted_(&shifted), shift_(shift), unit_(unit), root_(l.metric.cwiseSqrt()) {}
  Eigen::Index rows() const { return 2 * root_.size() + l_->z_z.rows(); }
  Eigen::Index cols() const { return rows(); }
  // v = shift x + a,  -(K + shift C) x - C a + Q_z z - G^T lambda = M (shift v + b),
  // z_q x + z_v v + z_z z = shift z + c
  void perform_op(const double* in, double* out) const {
    const Eigen::Index n = root_.size(), nz = l_->z_z.rows();
    const double rate = std::sqrt(unit_);
    const Vector a = Eigen::Map<const Vector>(in, n);
    const Vector b = rate * Eigen::Map<const Vector>(in + n, n);
    const Vector c = Eigen::Map<const Vector>(in + 2 * n, nz);
    const Vector at_v = a.cwiseQuotient(root_);
    Vector right(n + nz);
    Vector inertial = b + shift_ * a;
    for (Eigen::Index i = 0; i < n; ++i)
      if (l_->mass[i] == 0.0) inertial[i] = 0.0;
    right.head(n) = -(inertial + (l_->C * at_v).cwiseQuotient(root_)) / unit_;
    right.tail(nz) = c - l_->z_v * at_v;
    shifted_->solve(right);
    Eigen::Map<Vector>(out, n) = right.head(n);
    Eigen::Map<Vector>(out + n, n) = (shift_ * right.head(n) + a) / rate;
    Eigen::Map<Vector>(out + 2 * n, nz) = right.tail(nz);
  }

 private:
  const Linearisation* l_;
  Shifted* shifted_;
  double shift_, unit_;
  Vector root_;
};

[[noreturn]] void give_up(int count) {
  throw ModelError(fmt::format(
      "modes: the {} lowest eigenvalues of the linearised equations were not found: ask "
      "for fewer or more of them",
      count));
}

// A start that the joints allow: one application removes the rest.
template <class Operator>
Vector start_vector(const Operator& op) {
  Vector v(op.rows()), w(op.rows());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = std::cos(1.0 + 2.4 * static_cast<double>(i));
  op.perform_op(v.data(), w.data());
  op.perform_op(w.data(), v.data());
  return v;
}

struct Squares {
  Vector values;  // [1/s^2]
  Eigen::MatrixXd vectors;
};

/// The `count` values of K x = value M x above `sigma` [1/s^2] and next to it.
Squares squares_near(const Linearisation& l, int count, double sigma, double unit) {
  // K - sigma M: the shift of s^2 enters like that of a stiffness.
  Linearisation shifted_stiffness = l;
  Linearisation::Sparse mass(l.K.rows(), l.K.cols());
  mass.setIdentity();
  mass.diagonal() = l.mass;
  shifted_stiffness.K -= sigma * mass;
  Shifted shifted(shifted_stiffness, 0.0, unit);
  if (!shifted.regular()) give_up(count);
  InverseStiffness op(l, shifted);
  const Eigen::Index krylov = std::min<Eigen::Index>(l.mass.size(), std::max(2 * count + 10, 30));
  Spectra::SymEigsSolver<InverseStiffness> solver(op, count, krylov);
  const Vector start = start_vector(op);
  solver.init(start.data());
  if (solver.compute(Spectra::SortRule::LargestMagn, max_restarts, converged) < count)
    give_up(count);
  Squares found{.values = solver.eigenvalues(), .vectors = solver.eigenvectors()};
  if (l.mass.minCoeff() == 0.0)
    for (Eigen::Index i = 0; i < found.values.size(); ++i)
      found.vectors.col(i) = op.motion(found.vectors.col(i)) / found.values[i];
  for (double& value : found.values) value = sigma + unit / value;
  return found;
}

Linearisation without_damping(const Linearisation& l) {
  Linearisation plain = l;
  const Linearisation::Sparse transpose = l.K.transpose();
  plain.K = 0.5 * (l.K + transpose);
  plain.C.setZero();
  plain.Q_z.resize(l.K.rows(), 0);
  plain.z_q.resize(0, l.K.rows());
  plain.z_v.resize(0, l.K.rows());
  plain.z_z.resize(0, 0);
  return plain;
}

}  // namespace

LowestModes lowest_undamped(const Linearisation& l, int count) {
  const double unit = largest_rate_squared(l);
  // Where they are, roughly; then again from just below them, where the iteration separates them
  // best, until the shift is no longer far away in comparison with what lies between them.
  double sigma = -first_shift * unit, range = 0.0;
  Squares found;
  for (int round = 0; round < max_rounds; ++round) {
    found = squares_near(l, count, sigma, unit);
    const double lowest = found.values.minCoeff(), highest = found.values.maxCoeff();
    range = std::max(highest - lowest, std::abs(highest));
    if (lowest - sigma < near_enough * range || range < nothing * unit) break;
    sigma = lowest - beside * range;
  }
  LowestModes modes;
  const double zero = std::max(zero_share * range, nothing * unit);
  for (Eigen::Index i = 0; i < found.values.size(); ++i) {
    const double square = std::abs(found.values[i]) <= zero ? 0.0 : found.values[i];
    modes.values.push_back(square >= 0.0 ? std::complex<double>(0.0, std::sqrt(square))
                                         : std::complex<double>(std::sqrt(-square), 0.0));
    modes.shapes.push_back(
        found.vectors.col(i).cwiseQuotient(l.metric.cwiseSqrt()).cast<std::complex<double>>());
  }
  return modes;
}

LowestModes lowest_general(const Linearisation& l, int count) {
  const double unit = largest_rate_squared(l), rate = std::sqrt(unit);
  // Without what damps, to know how low they are; to the right, where few are.
  double shift = 0.0;
  for (const std::complex<double>& s : lowest_undamped(without_damping(l), (count + 1) / 2).values)
    shift = std::max(shift, beside * std::abs(s));
  shift = std::max(shift, nothing * rate);
  LowestModes modes;
  for (int round = 0; round < max_rounds; ++round) {
    Shifted shifted(l, shift, unit);
    if (!shifted.regular()) give_up(count);
    InverseRate op(l, shifted, shift, unit);
    const Eigen::Index krylov = std::min<Eigen::Index>(op.rows(), std::max(2 * count + 20, 40));
    Spectra::GenEigsSolver<InverseRate> solver(op, count, krylov);
    const Vector start = start_vector(op);
    solver.init(start.data());
    const int restarts = static_cast<int>(std::clamp(patience / static_cast<double>(op.rows()),
                                                     double{least_restarts}, double{max_restarts}));
    const bool complete =
        solver.compute(Spectra::SortRule::LargestMagn, restarts, converged) >= count;
    const Eigen::VectorXcd inverse = solver.eigenvalues();
    if (inverse.size() == 0) give_up(count);
    const Eigen::MatrixXcd vectors = solver.eigenvectors();
    modes = {};
    modes.complete = complete;
    double largest = 0.0;
    for (Eigen::Index i = 0; i < inverse.size(); ++i) {
      modes.values.push_back(shift + 1.0 / inverse[i]);
      largest = std::max(largest, std::abs(modes.values.back()));
      modes.shapes.push_back(vectors.col(i)
                                 .head(l.mass.size())
                                 .cwiseQuotient(l.metric.cwiseSqrt().cast<std::complex<double>>()));
    }
    if (!complete || shift < near_enough * largest || largest < nothing * rate) break;
    shift = beside * largest;
  }
  return modes;
}

}  // namespace yoke
