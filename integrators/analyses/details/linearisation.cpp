// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/details/linearisation.hpp>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include <yoke/integrators/analyses/details/tangent.hpp>

namespace yoke {

namespace {

constexpr double dependent_below = 1e-9;  // of an equation normalised to one
constexpr double at_rest = 1e-7;          // of the fastest mode, in length scales or rad

using Matrix = Eigen::MatrixXd;

/// Motions the joints allow: an orthonormal basis of the null space of G M^-1/2, and an orthonormal
/// basis of its row space with what solves G M^-1/2 x = b there.
class AllowedMotions {
 public:
  AllowedMotions(const Tangent::Matrix& G, const Eigen::VectorXd& root) : root_(root) {
    if (G.rows() == 0) return;
    Matrix transpose = Matrix(G.transpose());
    transpose.array().colwise() /= root.array();
    norm_ = transpose.colwise().norm();
    for (Eigen::Index i = 0; i < norm_.size(); ++i)
      if (norm_[i] > 0.0) transpose.col(i) /= norm_[i];
    qr_.setThreshold(dependent_below);
    qr_.compute(transpose);
    rank_ = qr_.rank();
  }
  Matrix basis() const {
    const Eigen::Index n = root_.size();
    if (rank_ == 0) return Matrix::Identity(n, n);
    Matrix unit = Matrix::Zero(n, n - rank_);
    unit.bottomRows(n - rank_).setIdentity();
    return qr_.householderQ() * unit;
  }
  /// The smallest x with G M^-1/2 x = b, for the columns of b.
  Matrix solve(Matrix b) const {
    const Eigen::Index n = root_.size();
    if (rank_ == 0) return Matrix::Zero(n, b.cols());
    for (Eigen::Index i = 0; i < norm_.size(); ++i) b.row(i) /= norm_[i] > 0.0 ? norm_[i] : 1.0;
    b = qr_.colsPermutation().transpose() * b;
    Matrix x = Matrix::Zero(n, b.cols());
    x.topRows(rank_) = qr_.matrixQR()
                           .topLeftCorner(rank_, rank_)
                           .triangularView<Eigen::Upper>()
                           .transpose()
                           .solve(b.topRows(rank_));
    return qr_.householderQ() * x;
  }

 private:
  const Eigen::VectorXd& root_;
  Eigen::VectorXd norm_;
  Eigen::ColPivHouseholderQR<Matrix> qr_;
  Eigen::Index rank_ = 0;
};

/// N of the positive metric becomes orthonormal in the masses, which leave part of the coordinates
/// out but no motion that the joints allow: N := N L^-T with L L^T = N^T M N.
void make_orthonormal(Linearisation& l) {
  const Eigen::LLT<Matrix> gram(Matrix(l.basis.transpose() * l.mass.asDiagonal() * l.basis));
  if (gram.info() != Eigen::Success)
    throw ModelError(
        "linearisation: a body without mass could move without any mass moving at this state");
  gram.matrixU().solveInPlace<Eigen::OnTheRight>(l.basis);
}

void reduce(Linearisation& l) {
  const bool massless = l.mass.size() > 0 && l.mass.minCoeff() == 0.0;
  const Eigen::VectorXd root = l.metric.cwiseSqrt();
  const AllowedMotions allowed(l.G, root);
  const Matrix unit = allowed.basis();  // M^1/2 N
  l.basis = root.cwiseInverse().asDiagonal() * unit;
  if (massless) {  // twice: the first time removes the large ratios of the metric
    make_orthonormal(l);
    make_orthonormal(l);
  }
  Matrix rate = allowed.solve(-(l.H * l.basis));  // M^1/2 N'
  l.basis_rate = root.cwiseInverse().asDiagonal() * rate;
  if (massless) {  // the same change of the joints, but N^T M N' = 0
    l.basis_rate -= l.basis * (l.basis.transpose() * (l.mass.asDiagonal() * l.basis_rate));
    rate = l.mass.cwiseSqrt().asDiagonal() * l.basis_rate;
  }
  const Matrix N_T = l.basis.transpose();
  l.C_reduced = N_T * (l.C * l.basis);
  l.K_reduced = N_T * (l.K * l.basis) + N_T * (l.C * l.basis_rate) - rate.transpose() * rate;
  const Eigen::Index f = l.basis.cols(), nz = l.z_z.rows();
  l.A = Matrix::Zero(2 * f + nz, 2 * f + nz);
  l.A.block(0, f, f, f).setIdentity();
  l.A.block(f, 0, f, f) = -l.K_reduced;
  l.A.block(f, f, f, f) = -l.C_reduced;
  l.A.block(f, 2 * f, f, nz) = N_T * Matrix(l.Q_z);
  l.A.block(2 * f, 0, nz, f) = l.z_q * l.basis + l.z_v * l.basis_rate;
  l.A.block(2 * f, f, nz, f) = l.z_v * l.basis;
  l.A.block(2 * f, 2 * f, nz, nz) = Matrix(l.z_z);
}

}  // namespace

std::string restlessness(const System& system, const State& state, double rate) {
  const double length = system.scales().length;
  double speed = 0.0, acceleration = 0.0;
  std::size_t fastest = 0, pushed = 0;
  for (Eigen::Index i = 0; i < state.v.size(); ++i) {
    const double size = i % 3 == 2 ? 1.0 : length;
    const auto body = static_cast<std::size_t>(i / 3 + 1);
    if (const double v = std::abs(state.v[i]) / size; v > speed) speed = v, fastest = body;
    if (const double a = std::abs(state.a[i]) / size; a > acceleration)
      acceleration = a, pushed = body;
  }
  const std::vector<Body>& bodies = system.model().bodies();
  if (speed > at_rest * std::max(rate, 1e-3))
    return fmt::format(
        "the state is no equilibrium: '{}' moves ({:.3g} length scales or rad per s); the "
        "coefficients are those of the instant",
        bodies[fastest].name, speed);
  if (acceleration > at_rest * std::max(rate * rate, 1e-3))
    return fmt::format(
        "the state is no equilibrium: '{}' is accelerated ({:.3g} length scales or rad per s^2); "
        "the coefficients are those of the instant",
        bodies[pushed].name, acceleration);
  return {};
}

Linearisation linearise_sparse(Dynamics& dynamics, const State& state,
                               std::span<const double> share) {
  const System& system = dynamics.system();
  Linearisation l;
  l.state = state;
  if (const std::string sliding = follows_reactions(dynamics.system(), state); !sliding.empty())
    throw ModelError(fmt::format(
        "linearisation: '{}' slides at this state, and its friction follows the reactions it makes; "
        "linearise about a state at rest",
        sliding));
  Tangent tangent = calc_tangent(dynamics.system(), l.state, share);
  l.mass = Eigen::Map<const Eigen::VectorXd>(system.mass().data(), system.dofs());
  const std::vector<double> metric = metric_of_masses(system);
  l.metric = Eigen::Map<const Eigen::VectorXd>(metric.data(), system.dofs());
  l.C = -tangent.Q_v;
  l.K = tangent.K_lambda - tangent.Q_q;
  l.G = std::move(tangent.G);
  l.H = std::move(tangent.H);
  l.Q_z = std::move(tangent.Q_z);
  l.z_q = std::move(tangent.z_q);
  l.z_v = std::move(tangent.z_v);
  l.z_z = std::move(tangent.z_z);
  l.freedom = system.dofs() - system.rows() + static_cast<int>(system.dropped_rows().size());
  return l;
}

Linearisation linearise_at(Dynamics& dynamics, const State& state, std::span<const double> share) {
  const System& system = dynamics.system();
  Linearisation l = linearise_sparse(dynamics, state, share);
  reduce(l);
  l.freedom = static_cast<int>(l.basis.cols());
  if (!l.A.allFinite())
    throw ModelError("linearisation: a derivative of an element is not finite at this state");
  const double rate = l.K_reduced.size() > 0 ? std::sqrt(l.K_reduced.cwiseAbs().maxCoeff()) : 0.0;
  l.warning = restlessness(system, l.state, rate);
  return l;
}

}  // namespace yoke
