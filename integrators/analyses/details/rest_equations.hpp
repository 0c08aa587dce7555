// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The equations of rest that equilibrium() solves, and their derivative.
#pragma once

#include <Eigen/SparseLU>
#include <algorithm>
#include <functional>
#include <span>
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
  /// Starts from the z and multipliers of a state at rest that was found before.
  void set_rest(const State& rest) { state_.z = rest.z, state_.lambda = rest.lambda; }
  bool has_loads() const { return std::ranges::find(is_load_, true) != is_load_.end(); }
  /// The loads act multiplied by this part of their load_factor.
  void set_load(double part);
  /// [forces] what each force is multiplied by.
  std::span<const double> share() const { return share_; }
  void set_parameter(std::size_t index, double value) { state_.parameters[index] = value; }

  Eigen::Index positions() const { return n_; }  ///< the first of the unknowns
  Vector unknowns() const;
  void set(const Vector& x);

  /// F at x; false if it is not finite or a contact is beyond its law.
  bool residual(const Vector& x, Vector& F);

  /// dF/dx at x, with `inertia` taken off the diagonal of the forces: the same for every length scale
  /// and rad of every body, because beside a heavy body light ones would be without.
  const Tangent::Matrix& calc_matrix(const Vector& x, double inertia = 0.0);
  /// Its factors.
  bool factorise(const Vector& x, double inertia = 0.0);
  bool solve(Vector& b);
  void multiply(const Vector& x, Vector& Jx) const { Jx = matrix_ * x; }

  NonlinearProblem problem();

  /// Positions only, in length scales or rad.
  double move(const Vector& dx) const { return n_ > 0 ? dx.head(n_).cwiseAbs().maxCoeff() : 0.0; }

  /// Is F at x no more than rounding leaves of the terms it is the sum of?
  bool is_rounding(const Vector& x, const Vector& F);
  /// Work of the forces on the straight way from x to y, scaled like force times length: Gauss's
  /// rule with 5 points, or the slope at x times the way with 1.
  double work(const Vector& x, const Vector& y, int points);
  /// d^T d of the positions, as factorise() adds it.
  double inertial(const Vector& d) const;
  /// Moves the positions of x to the nearest on the joints.
  bool project(Vector& x);
  /// Right-hand sides without the violation of the joints, which is left to project(): under much
  /// inertia even that of rounding would need huge multipliers.
  Vector along_joints(Vector b) const {
    b.tail(rows_).setZero();
    return b;
  }
  /// [1/s^2] Of the largest force per length scale on the mean mass.
  double noticeable_stiffness() const { return force_ / (length_ * system_.mean_mass()); }
  /// The multipliers' part of a step.
  void add_multipliers(const Vector& step, Vector& x) const { x.tail(rows_) += step.tail(rows_); }
  /// x displaced by `size` [length scales or rad] along a direction of the coordinates [n].
  void displace(const Vector& direction, double size_of_move, Vector& x) const;

  double largest_displacement(const Vector& dx) const;  ///< of a centre, in length scales
  double largest_turn(const Vector& dx) const;          ///< [rad]

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
  void moderate();
  bool project_in_metric();

  /// Which contacts press at the pose set, at rest. `loading`: where a law knows an unloading
  /// branch, the loading one is meant.
  void find_contacts(const std::function<double(const double*)>& effective_mass, bool loading);

  Dynamics dynamics_;
  System& system_;
  State state_;
  Vector start_;
  Eigen::Index n_ = 0, nz_ = 0, rows_ = 0;
  double length_ = 1.0, force_ = 1.0, load_factor_ = 1.0;
  std::vector<bool> is_load_;
  std::vector<double> share_;
  double under_ = 1.0;  // 1 + inertia, of the factors
  bool beyond_law_ = false;
  Tangent::Matrix matrix_;
  Eigen::SparseLU<Tangent::Matrix, Eigen::COLAMDOrdering<int>> lu_;
};

}  // namespace yoke
