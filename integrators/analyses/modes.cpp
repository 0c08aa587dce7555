// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/modes.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/analyses/details/linearisation.hpp>
#include <yoke/integrators/analyses/details/tangent.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>

namespace yoke {

namespace {

constexpr double dependent_below = 1e-9;   // of an equation normalised to one
constexpr double symmetric_below = 1e-10;  // of the largest entry
constexpr double zero_frequency = 1e-12;   // of the largest squared frequency
constexpr double zero_eigenvalue = 1e-7;   // of the largest, in the general problem
constexpr double at_rest = 1e-7;           // of the fastest mode, in length scales or rad

using Matrix = Eigen::MatrixXd;

/// What moves or is accelerated most, if anything does in comparison with `rate` [1/s].
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

void reduce(Linearisation& l) {
  const Eigen::VectorXd root = l.mass.cwiseSqrt();
  const AllowedMotions allowed(l.G, root);
  const Matrix unit = allowed.basis();  // M^1/2 N
  l.basis = root.cwiseInverse().asDiagonal() * unit;
  const Matrix rate = allowed.solve(-(l.H * l.basis));  // M^1/2 N'
  l.basis_rate = root.cwiseInverse().asDiagonal() * rate;
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

Mode make_mode(std::complex<double> s, Eigen::VectorXcd shape, const Eigen::VectorXd& mass) {
  Mode mode;
  mode.eigenvalue = s;
  const double size = std::abs(s);
  mode.frequency = size / (2.0 * pi);
  mode.damped_frequency = std::abs(s.imag()) / (2.0 * pi);
  mode.damping_ratio = size > 0.0 ? 0.0 - s.real() / size : 0.0;
  double square = 0.0;
  Eigen::Index largest = 0;
  for (Eigen::Index i = 0; i < shape.size(); ++i) {
    square += mass[i] * std::norm(shape[i]);
    if (std::abs(shape[i]) > (1.0 + 1e-9) * std::abs(shape[largest])) largest = i;
  }
  if (square > 0.0) {
    const std::complex<double> phase = std::abs(shape[largest]) / shape[largest];
    shape *= phase / std::sqrt(square);
  }
  mode.shape = std::move(shape);
  return mode;
}

bool undamped(const Linearisation& l) {
  const double size = std::max(l.K_reduced.cwiseAbs().maxCoeff(), 1e-300);
  if (l.z_z.rows() > 0) return false;
  if (l.C_reduced.cwiseAbs().maxCoeff() > symmetric_below * std::sqrt(size)) return false;
  return (l.K_reduced - l.K_reduced.transpose()).cwiseAbs().maxCoeff() < symmetric_below * size;
}

void solve_undamped(Modes& found) {
  const Linearisation& l = found.linearisation;
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(0.5 * (l.K_reduced + l.K_reduced.transpose()));
  const Eigen::VectorXd square = solver.eigenvalues();
  const double zero = zero_frequency * std::max(square.cwiseAbs().maxCoeff(), 1e-12);
  for (Eigen::Index i = 0; i < square.size(); ++i) {
    const Eigen::VectorXcd shape =
        (l.basis * solver.eigenvectors().col(i)).cast<std::complex<double>>();
    if (std::abs(square[i]) <= zero) {
      found.modes.push_back(make_mode(0.0, shape, l.mass));
    } else if (square[i] > 0.0) {
      found.modes.push_back(make_mode({0.0, std::sqrt(square[i])}, shape, l.mass));
    } else {
      found.stable = false;
      const double rate = std::sqrt(-square[i]);
      found.modes.push_back(make_mode(rate, shape, l.mass));
      found.modes.push_back(make_mode(-rate, shape, l.mass));
    }
  }
}

void solve_general(Modes& found) {
  const Linearisation& l = found.linearisation;
  const Eigen::Index f = l.basis.cols();
  const Eigen::EigenSolver<Matrix> solver(l.A);
  if (solver.info() != Eigen::Success)
    throw ModelError("modes: the eigenvalues of the linearised equations were not found");
  const Eigen::VectorXcd s = solver.eigenvalues();
  const double largest = s.cwiseAbs().maxCoeff();
  int zeros = 0;
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    const bool zero = std::abs(s[i]) <= zero_eigenvalue * largest;
    if (!zero && s[i].imag() < 0.0) continue;  // the other one of a pair
    if (zero && ++zeros % 2 == 0) continue;    // position and velocity of one motion
    const std::complex<double> value = zero ? 0.0 : s[i];
    if (value.real() > 1e-9 * largest) found.stable = false;
    const Eigen::VectorXcd p = solver.eigenvectors().col(i).head(f);
    found.modes.push_back(make_mode(value, l.basis * p, l.mass));
  }
}

}  // namespace

Linearisation linearise_at(Dynamics& dynamics, const State& state) {
  const System& system = dynamics.system();
  Linearisation l;
  l.state = state;
  Tangent tangent = calc_tangent(dynamics.system(), l.state);
  l.mass = Eigen::Map<const Eigen::VectorXd>(system.mass().data(), system.dofs());
  l.C = -tangent.Q_v;
  l.K = tangent.K_lambda - tangent.Q_q;
  l.G = std::move(tangent.G);
  l.H = std::move(tangent.H);
  l.Q_z = std::move(tangent.Q_z);
  l.z_q = std::move(tangent.z_q);
  l.z_v = std::move(tangent.z_v);
  l.z_z = std::move(tangent.z_z);
  reduce(l);
  if (!l.A.allFinite())
    throw ModelError("linearisation: a derivative of an element is not finite at this state");
  const double rate = l.K_reduced.size() > 0 ? std::sqrt(l.K_reduced.cwiseAbs().maxCoeff()) : 0.0;
  l.warning = restlessness(system, l.state, rate);
  return l;
}

Linearisation linearise(const Model& model, const State& given) {
  check_model(model);
  check_state(model, given);
  Dynamics dynamics(model);
  const System& system = dynamics.system();
  if (system.dofs() + system.states() > largest_linearisation)
    throw ModelError(fmt::format(
        "linearisation: {} coordinates and element states; dense matrices are made for at most {}",
        system.dofs() + system.states(), largest_linearisation));
  Linearisation l;
  l.state = given;
  if (const Outcome outcome = dynamics.assemble(l.state); !outcome) throw ModelError(outcome.why);
  return linearise_at(dynamics, l.state);
}

Modes modes(const Model& model, const State& state) {
  Modes found;
  found.linearisation = linearise(model, state);
  if (found.linearisation.degrees_of_freedom() == 0) return found;
  if (undamped(found.linearisation))
    solve_undamped(found);
  else
    solve_general(found);
  std::ranges::stable_sort(found.modes,
                           [](const Mode& a, const Mode& b) { return a.frequency < b.frequency; });
  return found;
}

}  // namespace yoke
