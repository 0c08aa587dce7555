// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Interface of force elements: springs, loads, contacts. An element computes the generalised force
// on its own bodies, its derivatives and its energy. It may own states z with z' = f(q, v, z, t),
// changeable parameters, a contact memory and events. It may depend on the reaction of one joint: the
// equations of motion are then solved for both together.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/core/constraint.hpp>
#include <yoke/core/contact_memory.hpp>
#include <yoke/core/motion.hpp>
#include <yoke/core/parameter.hpp>

namespace yoke {

class Drawing;
class Model;

/// A quantity an element reports at every output sample. `labels` not empty: the value is an index
/// into it and is written as text.
struct Channel {
  std::string name;  // for instance "penetration"
  std::string unit;  // for instance "m"; the column is called element.penetration_m
  std::vector<std::string> labels{};  // of a number that stands for a word
  double scale = 1.0;  // of a state z: its typical size, which its error weight is made from
};

/// Energy of one element. Powers are rates of energy leaving (dissipated) or entering (supplied).
struct Energy {
  double potential = 0.0;         // [J] gravity, springs
  double stored = 0.0;            // [J] what contacts would return if they unloaded now
  double dissipated_power = 0.0;  // [W], >= 0 for a passive element
  double supplied_power = 0.0;    // [W] work done on the mechanism per time by a load
};

/// Natural sizes of a model, from geometry and the start state. Independent of where the origin is
/// and of how often anything has turned: error weights and tolerances are built from these.
struct Scales {
  double length = 1.0;  // [m]
  double time = 1.0;    // [s]
};

/// [m/s] Sliding that is not told from rest, for a velocity whose terms have the sum `terms` [m/s].
inline double slowest_sliding(const Scales& scales, double terms) {
  return 1e-12 * scales.length / scales.time +
         64.0 * std::numeric_limits<double>::epsilon() * terms;
}

/// What a force element may read.
struct ForceInput {
  const Motion& motion;                    // poses, velocities, time
  const double* z = nullptr;               // [states()]
  const double* parameters = nullptr;      // [parameters().size()]
  const ContactMemory* contact = nullptr;  // [contacts()]
  Scales scales{};                         // of the model: what is small beside them
  double rounding = 0.0;                   // [m] of the model's coordinates, a few last places
  const double* hold = nullptr;  // [N] what an element that may hold holds now; null if not known
  const double* multipliers = nullptr;  // [rows] of the joint loaded_by(); null if not known
};

/// The blocks that evaluate() computes; null pointers are skipped. Blocks are row-major and zero on
/// entry.
struct ForceRequest {
  double* Q = nullptr;           // [3k] generalised force: N, N, N m about the centre of each body
  double* dQ_dq = nullptr;       // [3k x 3k]
  double* dQ_dv = nullptr;       // [3k x 3k]
  double* dQ_dz = nullptr;       // [3k x nz]
  double* z_dot = nullptr;       // [nz]
  double* dz_dq = nullptr;       // [nz x 3k]
  double* dz_dv = nullptr;       // [nz x 3k]
  double* dz_dz = nullptr;       // [nz x nz]
  double* dQ_dlambda = nullptr;  // [3k x rows] by the multipliers of loaded_by()
  double* dz_dlambda = nullptr;  // [nz x rows]
  Energy* energy = nullptr;      // of the element
};

/// What happened at a located event, as it is written to events.csv.
struct EventRecord {
  double t = 0.0;            // [s]
  std::string element;       // name of the force element
  std::string kind;          // "onset", "release", "region", ...
  std::string region;        // which part of the geometry, after the event
  double speed = 0.0;        // [m/s] penetration rate at the event, > 0 approaching
  double penetration = 0.0;  // [m] at the event
};

/// Given to an element when one of its event functions has crossed zero. The state is projected and
/// the accelerations are consistent.
struct EventContext {
  ForceInput input;                  // at the located event
  ContactMemory* contact = nullptr;  // to be changed
  double* z = nullptr;               // [states()] likewise, together with the memory of a contact
  /// [kg] 1/(d A d^T) for a direction d [3k] in the coordinates of the element's bodies, A the
  /// inverse inertia of the constrained mechanism.
  std::function<double(const double* direction)> effective_mass;
  /// [m/s^2 ...] accelerations [3k] of the element's bodies.
  const double* acceleration = nullptr;
  /// Adds [J] to the dissipated energy of the element, at once; may be negative.
  std::function<void(double)> dissipate{};
  std::function<void(EventRecord)> record{};  // t and element are filled in
  std::function<void(std::string)> fail{};    // stops the run with this reason
  std::function<void()> stop{};               // ends the run here with Stop::by_event
  std::function<void(std::string)> note{};    // into the notes of the summary, with the element
  bool at_rest = false;  // only forces without motion are wanted, many times: no need to know more
  /// A changeable parameter "element.name" of any element. Throws ModelError. A jump of energy that
  /// its change makes is counted as work of this element, if it supplies().
  std::function<double&(std::string_view)> parameter{};
  double* parameters = nullptr;  // State::parameters, for sample() alone
  /// Adds the impulse [N s] at the centre of a body and the angular impulse [N m s]. The velocities
  /// that follow are those the joints allow; what contacts and other events see of the jump they are
  /// told at once. The kinetic energy is counted as work of this element, if it supplies(). Throws
  /// ModelError for the ground, a body without mass or inertia to take it, and what is not finite.
  std::function<void(BodyId, const Vec2& impulse, double angular)> impulse{};
};

/// What the force of an element depends on; determines the sparsity pattern.
struct Dependence {
  bool position = true;  // on q
  bool velocity = true;  // on v
};

/// Base of every force element. Immutable once built; what changes lives in the State.
class ForceElement {
 public:
  /// `bodies` in the order of the blocks.
  ForceElement(std::string name, std::vector<BodyId> bodies, Dependence dependence = {});
  virtual ~ForceElement() = default;

  /// Unique in the model.
  const std::string& name() const { return name_; }
  /// On what the force depends.
  Dependence dependence() const { return dependence_; }
  /// The bodies it acts on, in the order of its blocks. Gravity returns all bodies.
  virtual std::vector<BodyId> bodies(const Model&) const { return bodies_; }

  /// Called once before a run, when the model is complete. Throws ModelError.
  virtual void check(const Model&) const {}

  /// Fills the requested blocks. Called in the innermost loop: must not allocate or throw.
  virtual void evaluate(const ForceInput& in, const ForceRequest& out) const = 0;

  /// The joint of the same model whose multipliers the force depends on, friction from a reaction say;
  /// null: none. Solved for, not lagged (core/equations/loaded_forces.hpp). Where an analysis knows no
  /// reactions, ForceInput::multipliers is null: then the force is the one without load.
  virtual const Constraint* loaded_by() const { return nullptr; }

  virtual bool dissipates() const { return false; }  ///< keeps a quadrature of dissipated_power
  virtual bool supplies() const { return false; }    ///< keeps a quadrature of supplied_power

  virtual std::vector<Channel> states() const { return {}; }  ///< the z it owns: names and units
  /// Writes z at the start, zero on entry.
  virtual void initial_states(double* /*z*/) const {}
  /// What may be changed from run to run, with defaults and ranges.
  virtual std::vector<Parameter> parameters() const { return {}; }
  /// Throws ModelError where values within their ranges do not go together, or the ranges are only known
  /// to something else.
  virtual void check_parameters(const double* /*values*/) const {}

  virtual int contacts() const { return 0; }  ///< how many ContactMemory it owns
  /// Sets the contact memory of a state at which a run starts (touching or not).
  virtual void initialise_contacts(EventContext&) const {}
  /// [m] size of penetration to be resolved; 0: no contact. Sets the error weight of its bodies.
  virtual double penetration_scale() const { return 0.0; }
  /// Number of event functions. Slot i fires when its function crosses zero upwards.
  virtual int events() const { return 0; }
  /// Writes the event functions [events()]: smooth, and -1 where an event does not apply.
  virtual void calc_events(const ForceInput&, double* /*g*/) const {}
  /// What happens where slot fired: changes the contact memory, z or parameters through the
  /// context.
  virtual void handle_event(int /*slot*/, EventContext&) const {}
  /// True if a handled event must not fire again before its function has been negative; false if
  /// the element ensures this itself, as contacts do with a margin.
  virtual bool events_settle() const { return false; }
  /// Whether steps are looked into for a slot, because its function may be positive within one and
  /// at neither end. For elements with contacts only while these are apart, when nothing else keeps
  /// steps short.
  virtual bool may_hide(int /*slot*/) const { return contacts() == 0; }
  /// [s] When sample() is to be called next, from in.motion.t on; infinity: never.
  virtual double next_sample(const ForceInput&) const {
    return std::numeric_limits<double>::infinity();
  }
  /// Called exactly then, at the end of a step, once next_sample() has come; what it does must move
  /// next_sample() on. Parameters are changed through EventContext::parameters. Must not allocate.
  virtual void sample(EventContext&) const {}
  /// Distinguishes elements of one kind whose evaluate() returns the same; part of the fingerprint
  /// of a model.
  virtual std::string signature() const { return {}; }

  /// Dry friction that holds. While the grip of the element's first contact memory is `held`, the
  /// equations of motion have a row s v + s_t = 0 for it, of velocity level, with a multiplier T of its
  /// own: the element feels -s^T T. evaluate() gives no friction then. The element sets a grip to
  /// `undecided` where sliding ends, to `forward` or `backward` where a hold breaks; which grips hold is
  /// settled for all together (core/equations/grips/grips.hpp).
  virtual bool may_hold() const { return false; }
  /// G = s [1 x 3k], phi_t = s_t, gamma = -(ds/dt) v, H = d(s v)/dq, K = d(s^T lambda)/dq.
  virtual void calc_hold(const ForceInput&, const ConstraintRequest&) const {}
  /// [N] the largest |T|.
  virtual double holding_force(const ForceInput&) const { return 0.0; }
  /// Called where a grip has been settled otherwise than it was `before`.
  virtual void grip_changed(Grip /*before*/, EventContext&) const {}

  /// What it reports at every sample.
  virtual std::vector<Channel> channels() const { return {}; }
  /// Writes them [channels().size()].
  virtual void calc_channels(const ForceInput&, double* /*values*/) const {}

  /// What it looks like (core/drawing/drawing.hpp); by default nothing is drawn.
  virtual void draw(Drawing&) const {}

 protected:
  /// As given to the constructor.
  const std::vector<BodyId>& own_bodies() const { return bodies_; }

 private:
  std::string name_;
  std::vector<BodyId> bodies_;
  Dependence dependence_;
};

}  // namespace yoke
