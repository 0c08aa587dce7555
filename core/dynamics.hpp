// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The equations of motion at acceleration level, and the projections that keep a state on the
// constraints. One sparse matrix serves them all:
//
//   [ M  G^T ] [ a      ]   [ Q     ]      accelerations and multipliers
//   [ G  0   ] [ lambda ] = [ gamma ]
//
//   [ M  G^T ] [ dq ]   [  0   ]           nearest position on Phi = 0, in the metric of the masses
//   [ G  0   ] [ .  ] = [ -Phi ]
//
//   [ M  G^T ] [ dv ]   [  0             ] nearest velocity on G v + Phi_t = 0
//   [ G  0   ] [ .  ] = [ -(G v + Phi_t) ]
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <yoke/core/sparse.hpp>
#include <yoke/core/system.hpp>

namespace yoke {

/// Outcome of a numerical operation; `why` names the equation or body when it failed.
struct Outcome {
  bool ok = true;
  std::string why;
  explicit operator bool() const { return ok; }
};

/// Force a joint exerts on its reaction_body() (the last of its bodies, unless it says otherwise),
/// at the joint, in global axes.
struct Reaction {
  Vec2 force{0.0, 0.0};  // [N]
  double moment = 0.0;   // [N m] about the joint's reaction point
};

/// Gains of Baumgarte's stabilisation: G v' = gamma - 2 alpha (G v + Phi_t) - beta^2 Phi.
struct Baumgarte {
  double alpha = 0.0;  // [1/s]
  double beta = 0.0;   // [1/s]
};

class Dynamics {
 public:
  explicit Dynamics(const Model& model);

  System& system() { return system_; }
  const System& system() const { return system_; }

  /// Forgets the factorisation, so that a run starts from a fresh one.
  void reset();

  /// a [dofs], lambda [rows], z_dot, quadrature rates at (t, q, v, z); pointers but a may be null.
  /// False if the matrix is singular or a result is not finite. Innermost loop; allocates nothing.
  bool calc_accelerations(double t, const double* q, const double* v, const double* z, double* a,
                          double* lambda, double* z_dot, double* quadrature_rates,
                          const Baumgarte* stabilisation = nullptr);
  /// The same for a State: fills a and lambda.
  bool calc_accelerations(State& state);

  /// Moves q to the nearest position on the constraints. False: no convergence (see worst_row()).
  bool project_positions(double t, double* q);
  /// Moves v to the nearest velocity allowed at q, which must be projected already.
  bool project_velocities(double t, const double* q, double* v);
  /// Both, and accelerations and multipliers.
  bool project(State& state);

  /// Assembly at the start: like project(), but explains a failure by naming the worst equation, or
  /// the equation that is redundant or in conflict. On success the state is consistent.
  Outcome assemble(State& state);

  /// [kg] 1/(d A d^T), d [columns] in the local coordinates of a force element, with the
  /// factorisation of the last calc_accelerations.
  double effective_mass(const ForceSlot& slot, const double* direction);

  /// The reaction of constraint i at the motion evaluated last, for given multipliers.
  Reaction reaction(std::size_t constraint, const double* lambda) const;

  /// Largest violation of the equations measured in lengths [m] and angles [rad] together,
  /// unscaled.
  double position_violation(const State& state);
  double velocity_violation(const State& state);

  int worst_row() const { return worst_row_; }
  double worst_residual() const { return worst_residual_; }
  const FactorCounters& counters() const { return lu_->counters(); }
  long evaluations() const { return evaluations_; }
  const SparseMatrix& matrix() const { return matrix_; }

 private:
  struct Stamp {
    int entry;  // in the blocks of G
    int lower;  // slot of G
    int upper;  // slot of G^T
  };

  void build_matrix();
  void stamp(std::size_t constraint);
  bool factorise_at(double t, const double* q);
  bool improve_position(double* q);
  bool same_as_factorised(double t, const double* q) const;
  Outcome explain_singular(const State& state);
  double position_tolerance(const double* q) const;

  System system_;
  SparseMatrix matrix_;
  std::vector<Stamp> stamps_;
  std::vector<std::size_t> stamp_start_;  // [constraints + 1]
  std::optional<SparseLU> lu_;
  std::vector<double> b_;  // right-hand side and solution, one entry more for the ground
  std::vector<double> phi_;
  std::vector<double> residual_;
  std::vector<double> zero_;  // velocities, where none matter
  std::vector<double> q_factorised_;
  double t_factorised_ = 0.0;
  bool factorised_ = false;
  int worst_row_ = 0;
  double worst_residual_ = 0.0;
  long evaluations_ = 0;
};

}  // namespace yoke
