// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The equations of rest that equilibrium() solves, and their derivative.
#pragma once

#include <Eigen/SparseLU>
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/analyses/details/tangent.hpp>
#include <yoke/integrators/analyses/equilibrium.hpp>
#include <yoke/integrators/sundials/newton.hpp>

namespace yoke {

/// The equations of rest, scaled: positions in length scales, forces in `force_`.
class Statics {
 public:
  using Vector = Eigen::VectorXd;

  Statics(const Model& model, const State& start, const EquilibriumOptions& options);

  Dynamics& dynamics() { return dynamics_; }
  const State& state() const { return state_; }
  bool has_loads() const { return std::ranges::find(is_load_, true) != is_load_.end(); }
  void set_load(double share);

  Vector unknowns() const;
  void set(const Vector& x);

  /// F at x; false if it is not finite or a contact is beyond its law.
  bool residual(const Vector& x, Vector& F);

  /// dF/dx at x, with `inertia` [scaled] taken off the diagonal of the forces.
  bool factorise(const Vector& x, double inertia = 0.0);
  bool solve(Vector& b);
  void multiply(const Vector& x, Vector& Jx) const { Jx = matrix_ * x; }

  NonlinearProblem problem();

  /// Positions only, in length scales or rad.
  double move(const Vector& dx) const { return n_ > 0 ? dx.head(n_).cwiseAbs().maxCoeff() : 0.0; }

  /// The body or equation with the largest residual.
  void blame(const Vector& F, Equilibrium& e) const;

  const std::string& farthest_body() const;

  /// The state at rest, ready for a run; contacts as a run would find them.
  State finish();
  std::vector<std::string> touching() const;

 private:
  double size(Eigen::Index i) const { return i % 3 == 2 ? 1.0 : length_; }
  double measure(Eigen::Index row) const;

  void choose_loads(const Model& model, const EquilibriumOptions& options);

  // The largest force at the start, contacts apart: the loads, and springs that are stretched.
  void choose_force();

  void add_forces(Vector& Q, Vector& z_dot);

  void add_inertia(double inertia);
  double mean_mass() const;

  /// Which contacts press at the pose set, at rest. `loading`: where a law knows an unloading
  /// branch, the loading one is meant.
  void find_contacts(const std::function<double(const double*)>& effective_mass, bool loading);

  Dynamics dynamics_;
  System& system_;
  State state_;
  Vector start_;
  Eigen::Index n_ = 0, nz_ = 0, rows_ = 0;
  double length_ = 1.0, force_ = 1.0;
  std::vector<bool> is_load_;
  std::vector<double> share_;
  bool beyond_law_ = false;
  Tangent::Matrix matrix_;
  Eigen::SparseLU<Tangent::Matrix, Eigen::COLAMDOrdering<int>> lu_;
};

}  // namespace yoke
