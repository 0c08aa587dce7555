// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The matrices behind the motion, for programs that need them: control, estimation, optimisation.
//
//   M a + G^T lambda = Q + F      Phi(q, t) = 0     G v + Phi_t = 0     G a = gamma
//
//   Mechanics mechanics(model);
//   mechanics.at(run.state());
//   mechanics.accelerations(F, a, lambda);
//
// Coordinates are those of a State: x, y [m], angle [rad] of every body, global. Each call allocates
// nothing, but at() where the matrix needs new pivots. Not for use by two threads at once; the model
// may be shared.
#pragma once

#include <Eigen/Core>
#include <memory>

#include <yoke/core/model.hpp>

namespace yoke {

class Mechanics {
 public:
  /// Assembles the model once, to find redundant equations. Throws ModelError if that fails.
  explicit Mechanics(const Model& model);
  ~Mechanics();
  Mechanics(Mechanics&&) noexcept;
  Mechanics& operator=(Mechanics&&) noexcept;

  int coordinates() const;  ///< n = 3 bodies
  int equations() const;    ///< rows of G; those found redundant are among them, and
                            ///< last a row of zeros for each contact with dry friction
  int freedom() const;      ///< f = n - independent equations

  /// Where all that follows is taken: t, q, v, z, parameters and contacts of `state`. It is not
  /// projected; Phi and G v + Phi_t tell how far it is off. Throws ModelError if it is not of this
  /// model, or if the constraints are dependent there. Dry friction that holds is taken for none: the
  /// freedom is that of the joints.
  void at(const State& state);

  const Eigen::VectorXd& mass_matrix() const;          ///< [n] diagonal of M [kg, kg, kg m^2]
  const Eigen::MatrixXd& constraint_jacobian() const;  ///< G [rows x n]
  const Eigen::VectorXd& positions_off() const;        ///< Phi [rows], [m] or [rad]
  const Eigen::VectorXd& velocities_off() const;       ///< G v + Phi_t [rows]
  const Eigen::VectorXd& gamma() const;                ///< [rows] as asked for by G a = gamma
  /// Q [n]: [N, N, N m] about the centre of each body, of all force elements.
  const Eigen::VectorXd& forces() const;

  /// Accelerations a [n] and multipliers lambda [rows] under the element's forces and F [n]; those
  /// of redundant equations are zero. `a` and `lambda` must have their sizes: Throws ModelError.
  void accelerations(const Eigen::VectorXd& F, Eigen::VectorXd& a, Eigen::VectorXd& lambda);
  /// N [n x f]: G N = 0, N^T M N = 1. Motions the joints allow are N p. (Where a body has no mass or
  /// inertia, next to nothing stands for it in M.)
  const Eigen::MatrixXd& null_space();
  /// [kg] What a force along `direction` (global, any length) at the global point `at` [m] of a body
  /// has to move: 1 / (d A d^T) with A the inverse inertia of the constrained mechanism. Infinity
  /// where nothing gives way. Throws ModelError for the ground or a direction of no length.
  double effective_mass(BodyId body, const Vec2& at, const Vec2& direction);

 private:
  struct Equations;
  std::unique_ptr<Equations> equations_;
};

}  // namespace yoke
