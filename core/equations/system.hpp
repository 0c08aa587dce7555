// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Evaluates the elements of a model at one state, each into its own local blocks, in storage sized
// once. Knows where the blocks belong; which matrix they go to is the business of the caller
// (dynamics.hpp for the acceleration-level saddle matrix, an implicit integrator for its own).
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <yoke/core/equations/held_row.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

/// Force a joint exerts on its reaction_body() (the last of its bodies, unless it says otherwise),
/// at the joint, in global axes.
struct Reaction {
  Vec2 force{0.0, 0.0};  // [N]
  double moment = 0.0;   // [N m] about the joint's reaction point
};

/// One constraint and where its blocks live.
struct ConstraintSlot {
  const Constraint* element = nullptr;
  int row = 0;  // first of its rows
  int rows = 0;
  int columns = 0;      // 3k
  int dofs = 0;         // offset into System::dof: global coordinate of each local column
  int block = 0;        // offset of its [rows x 3k] block in G (and H)
  int quadrature = -1;  // work done by a driver
  int parameters = 0;   // offset into State::parameters
  int hold = -1;        // of friction that may hold: its force element, index into System::forces()
};

/// One force element and where its data live.
struct ForceSlot {
  const ForceElement* element = nullptr;
  int columns = 0;      // 3k
  int dofs = 0;         // offset into System::dof
  int block = 0;        // offset of its [3k] block in Q
  int states = 0;       // nz
  int z = 0;            // offset into State::z
  int parameters = 0;   // offset into State::parameters
  int contacts = 0;     // offset into State::contacts
  int events = 0;       // offset into the event functions
  int dissipated = -1;  // quadrature indices
  int supplied = -1;
  int row = -1;   // constraint row of friction that may hold
  int load = -1;  // first row of the joint whose multipliers it depends on
  int load_rows = 0;
};

/// Kinetic, potential, stored energy [J]; the quadratures of the State complete the ledger.
struct EnergyTerms {
  double kinetic = 0.0;
  double potential = 0.0;
  double stored = 0.0;
};

class System {
 public:
  explicit System(const Model& model);
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  const Model& model() const { return model_; }
  int dofs() const { return dofs_; }  // 3 nb
  int rows() const { return rows_; }  // constraint equations, and those of friction that may hold
  int states() const { return states_; }  // element states z
  int quadratures() const { return quadratures_; }
  int events() const { return events_; }
  /// Joints, and after them friction that may hold.
  std::span<const ConstraintSlot> constraints() const { return constraints_; }
  std::span<const ConstraintSlot> joints() const { return constraints().first(joint_count_); }
  /// Friction that may hold; rows from joint_rows() on.
  std::span<const ConstraintSlot> holds() const { return constraints().subspan(joint_count_); }
  int joint_rows() const { return joint_rows_; }
  bool is_of_velocity_level(int row) const { return row >= joint_rows_; }
  std::span<const ForceSlot> forces() const { return forces_; }
  /// Global coordinate (0 .. 3 nb - 1) of a local column; -1 for the ground.
  std::span<const int> dof() const { return dof_; }
  std::span<const double> mass() const { return mass_; }  // [3 nb] diagonal of M
  /// Is there a body without mass or without inertia?
  bool has_massless() const { return std::ranges::find(mass_, 0.0) != mass_.end(); }
  /// [kg] Of all bodies; where none has mass, of inertias over the square of the natural length;
  /// where nothing has either, 1: there it only gives equations a unit.
  double mean_mass() const;
  /// "pivot: x" of constraint row i.
  std::string equation_name(int row) const;
  Measure measure(int row) const { return measure_[static_cast<std::size_t>(row)]; }
  /// Dependent rows that are left out of every factorised system, as assembly found them: matrices
  /// put a 1 on their diagonal, their multiplier is zero. Matrices built before do not know.
  void leave_out(const std::vector<int>& rows);
  bool is_left_out(int row) const { return left_out_[static_cast<std::size_t>(row)] != 0; }
  const std::vector<int>& left_out_rows() const { return left_out_rows_; }
  /// Those, and rows of friction that does not hold now: their multiplier is zero too.
  bool is_dropped(int row) const { return dropped_[static_cast<std::size_t>(row)] != 0; }
  const std::vector<int>& dropped_rows() const { return dropped_rows_; }
  std::span<const char> dropped() const { return dropped_; }  // [rows]
  /// Is any friction at rest, with or without a row of its own? As bind() found it.
  bool any_grip() const { return any_grip_; }
  const ContactMemory& grip_memory(const ConstraintSlot& hold) const {
    return contacts_[forces_[static_cast<std::size_t>(hold.hold)].contacts];
  }
  /// Changes with the rows that hold.
  long hold_version() const { return hold_version_; }
  /// What friction at rest bears [holds()], at the motion set last; forgotten when another is set.
  void set_hold_forces(const double* forces);
  /// Forces that depend on the reaction of a joint: indices into forces().
  std::span<const std::size_t> loaded() const { return loaded_; }
  /// Multipliers [rows] that those see from now on, until another motion is set; null: none. The pointer
  /// must outlive the evaluations.
  void set_multipliers(const double* lambda) { multipliers_ = lambda; }
  /// Names of the quadratures, "motor.work" or "slot.dissipated".
  std::vector<std::string> quadrature_names() const;
  /// For each quadrature: work of a load or driver (true) or dissipated energy.
  std::vector<bool> quadratures_of_work() const;

  /// Binds what elements read besides the motion, and notes which friction holds. The pointers must
  /// outlive the evaluations.
  void bind(const State& state);
  /// Sets time, positions [dofs] and velocities [dofs].
  void set_motion(double t, const double* q, const double* v);
  /// Element states [states] to be used from now on.
  void set_states(const double* z) { z_ = z; }
  const Motion& motion() const { return motion_; }
  ForceInput force_input(const ForceSlot& slot) const;
  /// The blocks of a constraint, at the motion set last or at another.
  void evaluate(const ConstraintSlot& c, ConstraintRequest out) const { evaluate(c, motion_, out); }
  void evaluate(const ConstraintSlot& c, const Motion& motion, ConstraintRequest out) const {
    out.parameters = parameters_ + c.parameters;
    c.element->evaluate(motion, out);
  }

  /// Phi [rows] and G (blocks).
  void calc_position_level(double* phi);
  /// Largest |phi| in units of the length scale (lengths) or 1 rad (angles) of the rows that are
  /// not left out; `worst` gets its row.
  double norm(const double* residual, int* worst = nullptr) const;
  /// G v + Phi_t [rows] at the motion set, from the blocks of G computed last.
  void calc_velocity_residual(double* residual);
  const double* G() const { return G_.data(); }
  double* G() { return G_.data(); }
  std::size_t jacobian_size() const { return G_.size(); }  // of all blocks
  /// force[dofs + 1] -= G^T lambda, from the blocks of G; the last entry collects the ground.
  void subtract_constraint_forces(const double* lambda, double* force) const;

  /// The reaction of constraint i at the motion set last, for given multipliers [rows].
  Reaction reaction(std::size_t constraint, const double* lambda) const;

  /// Q [dofs + 1] (added), z_dot [states] and quadrature rates [quadratures] of the force elements;
  /// null where not wanted.
  void add_forces(double* Q, double* z_dot, double* quadrature_rates);
  /// The same of one.
  void add_force(const ForceSlot& force, double* Q, double* z_dot, double* quadrature_rates);
  /// Of those that depend on no reaction, and of those that do.
  void add_unloaded_forces(double* Q, double* z_dot, double* quadrature_rates);
  void add_loaded_forces(double* Q, double* z_dot, double* quadrature_rates);
  /// Power of the drivers, lambda^T Phi_t, into their quadrature rates.
  void add_driver_power(const double* lambda, double* quadrature_rates);
  /// All event functions [events].
  void calc_events(double* g) const;
  /// out [rows] += G x, with the blocks of G computed last, x [dofs].
  void add_jacobian_times(const double* x, double* out) const;
  EnergyTerms calc_energy() const;
  /// Looks for the element that gives a value that is not finite at the motion set last and keeps
  /// its name for the report of a failed run. Off the hot path.
  void blame_not_finite();
  const std::string& not_finite() const { return not_finite_; }
  /// The same of an element whose force no reactions satisfy.
  void blame_wedged(const ForceSlot& force);
  bool wedged() const { return wedged_; }
  void forget_wedged();
  /// The element that owns an event function which is not finite.
  void blame_event(int slot);

  Scales scales() const { return scales_; }
  void set_scales(const Scales& scales) { scales_ = scales; }
  /// Length scale from the layout of the bodies (invariant to shifts and turns of the frame).
  double natural_length() const { return natural_length_; }
  /// [bodies, m^2] How far from a body's centre its joints are at the model's start pose, squared,
  /// on average; not positive or not finite where no joint tells. Or as seen in a pose where the bodies
  /// are turned, one by `turned` [rad], the next by twice that, and so on. Evaluates the constraints there.
  std::vector<double> squared_arms(double turned = 0.0);

 private:
  double length_of_layout();
  double rounding_of_coordinates() const;
  void lay_out_bodies();
  void lay_out_constraints();
  void lay_out_forces();
  void lay_out_holds();
  void reserve_constraints();
  void find_load(ForceSlot& slot, std::size_t& near) const;
  void note_holds();
  void collect_dropped();
  int add_dofs(const std::vector<BodyId>& bodies);

  const Model& model_;
  int dofs_ = 0, rows_ = 0, states_ = 0, quadratures_ = 0, events_ = 0;
  std::vector<ConstraintSlot> constraints_;
  std::vector<ForceSlot> forces_;
  std::vector<int> dof_;
  std::vector<double> mass_;
  std::vector<Measure> measure_;
  std::size_t joint_count_ = 0;
  int joint_rows_ = 0;
  std::vector<std::unique_ptr<const HeldRow>> held_rows_;
  std::vector<char> left_out_, dropped_;  // [rows]
  std::vector<int> left_out_rows_, dropped_rows_;
  std::vector<char> holding_;        // [holds]
  std::vector<double> hold_forces_;  // [holds]
  bool hold_forces_known_ = false, any_grip_ = false;
  long hold_version_ = 0;
  std::vector<BodyMotion> bodies_;
  Motion motion_;
  std::vector<double> G_;
  std::vector<double> phi_t_;
  std::vector<double> Q_;
  const double* z_ = nullptr;
  const double* parameters_ = nullptr;
  std::vector<double> start_parameters_;  // until bind()
  const ContactMemory* contacts_ = nullptr;
  std::vector<std::size_t> loaded_;
  const double* multipliers_ = nullptr;
  Scales scales_;
  double natural_length_ = 1.0;
  double rounding_ = 0.0;  // [m] of the coordinates in the start pose
  std::string not_finite_;
  bool wedged_ = false;
};

}  // namespace yoke
