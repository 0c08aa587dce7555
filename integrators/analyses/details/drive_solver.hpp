// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#pragma once

#include <Eigen/SparseQR>
#include <vector>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/analyses/inverse_dynamics.hpp>
#include <yoke/integrators/run/constraint_summary.hpp>

namespace yoke {

/// As errors and summaries call it.
inline constexpr const char* inverse_dynamics_name = "inverse dynamics";

/// The drives of a motion that is given: M a - Q = B u - G^T lambda for u and lambda.
class DriveSolver {
 public:
  DriveSolver(Dynamics& dynamics, const std::vector<Drive>& drives)
      : dynamics_(dynamics), drives_(drives) {
    const System& system = dynamics.system();
    const int dofs = degrees_of_freedom(dynamics);
    if (static_cast<int>(drives.size()) != dofs)
      throw ModelError(fmt::format("{}: {} drives are given for {} degrees of freedom",
                                   inverse_dynamics_name, drives.size(), dofs));
    for (const Drive& d : drives) columns_.push_back({column(d.body, d), column(d.against, d)});
    for (int i = 0; i < system.rows(); ++i)
      if (!system.is_dropped(i)) kept_.push_back(i);
  }

  /// Multipliers into `state`, the drives [N, N m] into u.
  void solve(State& state, Eigen::VectorXd& u) {
    System& system = dynamics_.system();
    system.bind(state);
    system.set_motion(state.t, state.q.data(), state.v.data());
    check_motion(state);
    const int n = system.dofs(), m = static_cast<int>(kept_.size());
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n + 1);
    system.add_unloaded_forces(b.data(), nullptr, nullptr);
    Eigen::VectorXd size = b.head(n).cwiseAbs();
    for (int i = 0; i < n; ++i) {
      const double inertia = system.mass()[static_cast<std::size_t>(i)] * state.a[i];
      size[i] += std::abs(inertia);
      b[i] -= inertia;
    }
    if (!b.allFinite())
      throw ModelError(
          fmt::format("{}: forces at t = {:.9g} s are not finite", inverse_dynamics_name, state.t));
    // Q - M a = G^T lambda - B u
    state.lambda.setZero();
    Eigen::VectorXd x, balance = b.head(n);
    Eigen::SparseMatrix<double> A = matrix(n, m);
    solve_linear(A, balance, state.t, x);
    for (int round = 0; !system.loaded().empty(); ++round) {
      const Eigen::VectorXd before = x;
      set_multipliers(x, state);
      balance = b.head(n);
      A = matrix(n, m, load_slopes(state.lambda, balance));
      solve_linear(A, balance, state.t, x);
      if ((x - before).cwiseAbs().maxCoeff() <= same_reactions * x.cwiseAbs().maxCoeff()) break;
      if (round == most_rounds)
        throw ModelError(
            fmt::format("{}: at t = {:.9g} s the friction of '{}' wedges: no reactions satisfy it",
                        inverse_dynamics_name, state.t,
                        system.forces()[system.loaded().front()].element->name()));
    }
    const double left = (A * x - balance).cwiseAbs().maxCoeff();
    if (left > allowed_imbalance * (size.maxCoeff() + 1e-300))
      throw ModelError(fmt::format(
          "{}: at t = {:.9g} s the accelerations given are not those of the joints: {:g} N or N m "
          "are left over",
          inverse_dynamics_name, state.t, left));
    set_multipliers(x, state);
    u = x.tail(static_cast<Eigen::Index>(drives_.size()));
  }

  /// [W] of drive i at a state.
  double power(std::size_t i, double u, const State& state) const {
    const auto [at, against] = columns_[i];
    return u * ((at >= 0 ? state.v[at] : 0.0) - (against >= 0 ? state.v[against] : 0.0));
  }

 private:
  static constexpr double allowed_violation = 1e-6;  // of a given motion, in length scales or rad
  static constexpr double allowed_imbalance = 1e-6;  // of the forces, in parts of the largest
  static constexpr double same_reactions = 1e-12;
  static constexpr int most_rounds = 30;
  int column(const std::string& body, const Drive& d) const {
    if (body.empty()) return -1;
    const BodyId id = dynamics_.system().model().find_body(body);
    return id == ground ? -1 : 3 * (id.index - 1) + static_cast<int>(d.coordinate);
  }

  void check_motion(const State& state) {
    System& system = dynamics_.system();
    std::vector<double> phi(static_cast<std::size_t>(system.rows()));
    system.calc_position_level(phi.data());
    int worst = 0;
    if (system.norm(phi.data(), &worst) <= allowed_violation) return;
    throw ModelError(fmt::format("{}: the motion given violates '{}' by {:g} {} at t = {:.9g} s",
                                 inverse_dynamics_name, system.equation_name(worst),
                                 phi[static_cast<std::size_t>(worst)],
                                 system.measure(worst) == Measure::length ? "m" : "rad", state.t));
  }

  void solve_linear(const Eigen::SparseMatrix<double>& A, const Eigen::VectorXd& b, double t,
                    Eigen::VectorXd& x) {
    qr_.compute(A);
    if (qr_.rank() < A.cols())
      throw ModelError(
          fmt::format("{}: at t = {:.9g} s the drives cannot act on all degrees of freedom",
                      inverse_dynamics_name, t));
    x = qr_.solve(b);
  }

  void set_multipliers(const Eigen::VectorXd& x, State& state) const {
    for (std::size_t i = 0; i < kept_.size(); ++i)
      state.lambda[kept_[i]] = x[static_cast<Eigen::Index>(i)];
  }

  std::vector<int> places() const {
    std::vector<int> place(static_cast<std::size_t>(dynamics_.system().rows()), -1);
    for (std::size_t i = 0; i < kept_.size(); ++i)
      place[static_cast<std::size_t>(kept_[i])] = static_cast<int>(i);
    return place;
  }

  using Entries = std::vector<Eigen::Triplet<double>>;

  /// Newton's terms of forces that depend on reactions: Q - dQ/dlambda lambda into b, -dQ/dlambda.
  Entries load_slopes(const Eigen::VectorXd& lambda, Eigen::VectorXd& b) {
    System& system = dynamics_.system();
    const std::vector<int> place = places();
    Entries entries;
    system.set_multipliers(lambda.data());
    for (const std::size_t index : system.loaded()) {
      const ForceSlot& f = system.forces()[index];
      std::vector<double> Q(static_cast<std::size_t>(f.columns));
      Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(f.load_rows, f.columns);  // row-major blocks
      f.element->evaluate(system.force_input(f), {.Q = Q.data(), .dQ_dlambda = slope.data()});
      for (int j = 0; j < f.columns; ++j) {
        const int dof = system.dof()[static_cast<std::size_t>(f.dofs + j)];
        if (dof < 0) continue;
        b[dof] +=
            Q[static_cast<std::size_t>(j)] - slope.col(j).dot(lambda.segment(f.load, f.load_rows));
        for (int l = 0; l < f.load_rows; ++l)
          if (const int equation = place[static_cast<std::size_t>(f.load + l)]; equation >= 0)
            entries.emplace_back(dof, equation, -slope(l, j));
      }
    }
    system.set_multipliers(nullptr);
    return entries;
  }

  Eigen::SparseMatrix<double> matrix(int n, int m, Entries entries = {}) const {
    const System& system = dynamics_.system();
    const std::vector<int> place = places();
    for (const ConstraintSlot& c : system.constraints())
      for (int i = 0; i < c.rows; ++i)
        for (int j = 0; j < c.columns; ++j) {
          const int dof = system.dof()[static_cast<std::size_t>(c.dofs + j)];
          const int equation = place[static_cast<std::size_t>(c.row + i)];
          if (dof >= 0 && equation >= 0)
            entries.emplace_back(dof, equation, system.G()[c.block + i * c.columns + j]);
        }
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const int drive = m + static_cast<int>(k);
      if (columns_[k].at >= 0) entries.emplace_back(columns_[k].at, drive, -1.0);
      if (columns_[k].against >= 0) entries.emplace_back(columns_[k].against, drive, 1.0);
    }
    Eigen::SparseMatrix<double> A(n, m + static_cast<int>(columns_.size()));
    A.setFromTriplets(entries.begin(), entries.end());
    A.makeCompressed();
    return A;
  }

  struct Columns {
    int at, against;
  };
  Dynamics& dynamics_;
  const std::vector<Drive>& drives_;
  std::vector<Columns> columns_;
  std::vector<int> kept_;
  Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr_;
};

}  // namespace yoke
