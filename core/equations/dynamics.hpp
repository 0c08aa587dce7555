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

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <yoke/core/equations/linear/saddle_solver.hpp>
#include <yoke/core/equations/loaded_forces.hpp>
#include <yoke/core/equations/redundancy.hpp>
#include <yoke/core/equations/scaled_saddle.hpp>
#include <yoke/core/equations/system.hpp>

namespace yoke {

/// Outcome of a numerical operation; `why` names the equation or body when it failed.
struct Outcome {
  bool ok = true;
  std::string why;
  explicit operator bool() const { return ok; }
};

/// Gains of Baumgarte's stabilisation: G v' = gamma - 2 alpha (G v + Phi_t) - beta^2 Phi.
struct Baumgarte {
  double alpha = 0.0;  // [1/s]
  double beta = 0.0;   // [1/s]
};

/// How far equations are violated: those measured in lengths and those measured in angles.
struct Violation {
  double length = 0.0;  // [m] or [m/s]
  double angle = 0.0;   // [rad] or [rad/s]
  double largest() const { return std::max(length, angle); }
};

/// How much of a violation a projection corrects.
enum class Correction {
  coarse,  ///< nothing within rounding of the largest coordinate; costs least
  smooth,  ///< at least one correction: a method with a history would see one that comes and goes
  exact,   ///< until nothing is gained any more
};

/// Which rows a projection of velocities corrects; the others keep their rate.
enum class Rows { all, of_positions };

class Dynamics {
 public:
  explicit Dynamics(const Model& model, LinearSolver choice = LinearSolver::automatic);

  System& system() { return system_; }
  const System& system() const { return system_; }

  /// Forgets the factorisation, so that a run starts from a fresh one.
  void reset();

  /// Where accelerations are computed.
  struct Instant {
    double t;                   // [s]
    const double *q, *v;        // [dofs]
    const double* z = nullptr;  // [states]
  };
  /// What is written; null pointers but a are skipped.
  struct Accelerations {
    double* a;                           // [dofs]
    double* lambda = nullptr;            // [rows]
    double* z_dot = nullptr;             // [states]
    double* quadrature_rates = nullptr;  // [quadratures]
  };
  /// False if the matrix is singular or a result is not finite. Innermost loop; allocates nothing.
  bool calc_accelerations(const Instant& at, const Accelerations& out,
                          const Baumgarte* stabilisation = nullptr);
  /// The same for a State: fills a and lambda.
  bool calc_accelerations(State& state);
  /// At the motion of the last calc_accelerations(): x [dofs + rows], which solves the saddle system for `b`, is made
  /// the solution with the forces that depend on reactions. False: there is none.
  bool add_loaded_forces(const double* b, double* x) { return !loaded_ || loaded_->solve(b, x); }

  /// All event functions [events] at a motion, where they need them with the forces of friction that
  /// holds. False if these cannot be computed.
  bool calc_events(const Instant& at, double* g);
  /// Lets the elements know reactions, and what friction at rest bears, after calc_accelerations() gave
  /// `lambda` [rows]. Where rows of others carry it, all share so that the greatest use of a limit is as
  /// small as may be, in the sense of least squares.
  void share_hold_forces(const double* lambda);
  /// [rows] The multipliers with that share.
  const double* shared_multipliers() const { return shared_.data(); }

  /// Moves q to the nearest position on the constraints. False: no convergence (see worst_row()).
  bool project_positions(double t, double* q, Correction how = Correction::coarse);
  /// Moves v to the nearest velocity allowed at q, which must be projected already.
  bool project_velocities(double t, const double* q, double* v, Rows which = Rows::all);
  /// Both.
  bool project(double t, double* q, double* v, Correction how = Correction::coarse);
  /// Both, and accelerations and multipliers. At a singular position accelerations are a solution
  /// and multipliers those of least norm, neither the limit from beside it.
  bool project(State& state);

  /// Assembly at the start: like project(), also from far away, and explains a failure by naming
  /// the worst equation or those in conflict. Equations found redundant are left out from now on,
  /// see redundancy(). On success the state is consistent.
  Outcome assemble(State& state);
  const Redundancy& redundancy() const { return redundancy_; }
  /// Empty, or which massless bodies could move at `state` without any mass moving.
  std::string impasse(const State& state);
  /// Leaves these rows out of the matrices; those of formulations must be built anew.
  void leave_out(const std::vector<int>& rows);
  /// Empty, or which equation that was left out as redundant has come to be violated by more than
  /// `bound` [length scales or rad] at q: it was in conflict with the others after all.
  std::string contradiction(double t, const double* q, double bound);

  /// How far the constraints at (t, q) are from being dependent: an estimate, by one step of
  /// inverse iteration from the last call, of the smallest eigenvalue of G W^-1 G^T scaled to a
  /// diagonal of ones, W = metric_of_lengths(); falls like the square of the distance to a singular
  /// position. A matter of geometry: masses, units and the frame change nothing. 0: singular.
  double independence(double t, const double* q, int iterations = 1);
  const std::vector<double>& length_metric() const { return length_metric_; }  ///< [dofs]
  /// The row with the largest part in what is nearly dependent, after independence().
  int weakest_row() const { return weakest_row_; }

  /// [kg] 1/(d A d^T), d [columns] in the local coordinates of a force element, with the
  /// factorisation of the last calc_accelerations.
  double effective_mass(const ForceSlot& slot, const double* direction);
  /// [1/kg] The acceleration along such a direction for a unit of force along it, and in `alone` that of
  /// the bodies without constraints; with the same factorisation.
  double mobility(const ForceSlot& slot, const double* direction, double& alone);
  /// [1/kg or 1/(kg m^2)] The acceleration of a coordinate for a unit of force on it; 0 where the
  /// constraints hold it. With the same factorisation.
  double mobility(int dof);

  /// The reaction of constraint i at the motion evaluated last, for given multipliers.
  Reaction reaction(std::size_t constraint, const double* lambda) const {
    return system_.reaction(constraint, lambda);
  }

  /// Largest violations [m, rad] and [m/s, rad/s], those of left-out equations included.
  Violation position_violation(const State& state);
  Violation velocity_violation(const State& state);

  int worst_row() const { return worst_row_; }
  /// Of the last projection [m or rad], or of position_violation() [length scales or rad].
  double worst_residual() const { return worst_residual_; }
  FactorCounters counters() const;
  long evaluations() const { return evaluations_; }
  /// The saddle matrix, with the blocks of G computed last.
  const SparseMatrix& matrix() { return saddle_->matrix(system_.G(), system_.dropped()); }
  const SaddleSolver& saddle() const { return *saddle_; }

 private:
  static constexpr int max_projection_iterations = 12;

  SaddleLayout layout() const;
  std::vector<JacobianEntry> entries() const;
  bool factorise_at(double t, const double* q);
  bool improve_position(double* q);
  bool improve_velocity(double* v, Rows which = Rows::all);
  bool same_as_factorised(double t, const double* q) const;
  Violation largest_of(const std::vector<double>& residual) const;
  Outcome assemble_from_afar(State& state);
  Outcome settle_redundancy(State& state);
  Outcome finish_assembly(State& state);
  Outcome check_left_out(const State& state, const RankAnalysis& analysis);
  bool project_singular(State& state);
  bool solve_loaded(double* z_dot, double* quadrature_rates);
  Eigen::VectorXd response_to(std::size_t hold);
  void share_with_carried(const double* lambda);
  Outcome explain_positions(const class LeastChange& failed) const;
  double position_tolerance(const double* q) const;
  std::vector<char> dropped_marks() const;  // [rows]

  System system_;
  LinearSolver choice_;
  std::optional<SaddleSolver> saddle_;
  std::optional<LoadedForces> loaded_;  // where forces depend on reactions
  FactorCounters retired_;              // of factorisations of other choices of rows
  std::vector<double> b_;  // right-hand side and solution, one entry more for the ground
  std::vector<double> phi_;
  std::vector<double> residual_;
  std::vector<double> zero_;  // velocities, where none matter
  std::vector<double> q_factorised_;
  double t_factorised_ = 0.0;
  bool factorised_ = false;
  long version_factorised_ = 0;             // System::hold_version()
  Eigen::VectorXd a_there_, lambda_there_;  // of looks at friction that holds
  std::vector<double> hold_forces_, shared_, free_;
  std::vector<std::size_t> held_, carried_;
  Redundancy redundancy_;
  std::vector<double> length_metric_;    // for independence()
  std::optional<ScaledSaddle> lengths_;  // made when it is asked for
  std::vector<double> weakest_;
  int weakest_row_ = 0;
  int worst_row_ = 0;
  // Violation of the position that the factors of its last projection were made at, or infinity.
  double factors_for_ = 0.0;
  double worst_residual_ = 0.0;
  long evaluations_ = 0;
};

}  // namespace yoke
