// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A contact between two bodies a and b, whatever their shapes: the mechanics and the state machine.
// From the geometry it takes, for each region, the penetration d(q), its gradient g and Hessian H
// over (x, y, angle) of a and b; from the law F(d, d'):
//   d' = g v           Q = -F g^T           dQ/dv = -F_r g^T g
//   d'' = g a + v^T H v                     dQ/dq = -(F_d g^T g + F_r g^T (H v)^T) - F H
// with F_d, F_r the derivatives of F by penetration and rate.
//
// A law that follows the curvature k of the wall (wall_law.hpp) stores U(d, k), and k changes along the
// wall. A frictionless elastic contact is conservative: pressure on a disc points to its centre, and
// what moves the centre by dp does the work -dU. So the force is the gradient of U(d(q), k(q)); with
// c = dk/dq, C = dc/dq:
//   Q = -F g^T - U_k c^T                  -Q v = F d' + U_k k' = dU/dt + D
//   dQ/dq = the above - F_k g^T c - c^T (U_dk g + U_kk c) - U_k C
// The second term is a small force along the wall, towards where it is softer. F g^T alone would take
// U_k k' from nowhere: on a closed path a pin could gain energy.
//
// Friction (core/friction_law.hpp) acts along the wall at the point of contact, with the row s(q) of
// contact_geometry.hpp and S = ds/dq, on N = max(F, 0):
//   v_t = s v - surface speed      Q -= T(N, v_t, z) s^T      z' = f(N, v_t, z) while in contact
//   dQ/dq -= s^T (T_N dN/dq + T_v (S^T v)^T) + T S            dQ/dv -= s^T (T_N dN/dv + T_v s)
// What drives a belt does the work T times its speed. z is zero while apart; a release counts what the
// bristles store as dissipated.
//
// Coulomb's law itself (FrictionLaw::holds) is no force while the surfaces stick: the row s v = surface
// speed is then one of the equations of motion, of velocity level, with the multiplier T (calc_hold).
// Sliding has the direction of memory.grip, so that T is smooth between events.
//
// The state machine. Between events the formula of one region is continued smoothly, whatever the
// sign of d; transitions happen at located events only:
//   apart        no force. `onset` when d of the nearest region crosses zero upwards.
//   compressing  the law's force. `release` when d falls below zero or, depending on the law, where
//                the force would become tensile. `turn` at d' = 0, only if the law needs the end of
//                compression.
//   restituting  after `turn`, until `release` at the permanent set, or until a reload passes the
//                largest penetration (`reload`), which is compression again.
//   region       in contact, when the point of contact passes into the next region.
//   closest      apart, at the deepest or nearest point of an approach (d' = 0): no transition,
//                but a touch that began and ended within one step is detected and located. A step
//                may hold more, from a release to beyond the next touch: those of a contact that is
//                apart are looked into (may_hide).
//   kink         where the law declares a corner of its formula: the integrator restarts.
//   fullest      lifted (below), where the law's force is largest over d: no transition, but a
//                force that appeared and vanished within one step is detected.
//   grip         where friction that holds reaches its limit, or sliding ends. What becomes of it is
//                settled for all contacts together (core/equations/grips/grips.hpp).
//   failure      at 99 % of the largest penetration for which the elastic law is valid. Within the
//                step that meets it, the law is continued along its tangent.
// Two kinds of "apart" have a memory; memory.release_penetration distinguishes them:
//   dented       released at a permanent set > 0. The next contact begins at that penetration, on
//                the unloading line, until d falls below zero and the memory is cleared.
//   lifted       released at zero force with d above the permanent set: the surface relaxes behind
//                the pin without a force. Its stored energy continues to fall with d and counts as
//                dissipated (D = -dS/dt). The contact resumes where the law's force becomes
//                positive again, and ends finally at the permanent set.
// A third kind is behind the wall: what comes through the material from its back, as a pin that has
// left an open slot, is deep within at once. It stays apart, with a note, until it is in front.
// Where two regions have different laws, the stored energy jumps from one law's to the other's as
// the contact passes over; the jump counts as dissipation (of either sign). So the energy ledger
// stays balanced through every transition.
//
// Rounding. At an event d is zero up to rounding, with either sign, and a function that starts on
// the wrong side of zero never crosses it: a pin could pass through a wall, or stick to it. The
// criterion is whether the present rate carries d out of a band of +-touch_tolerance whatever the
// acceleration does (`leaves_band`). If it does not, an onset is postponed, and a release leads to
// "apart"; in both cases the next onset waits until d has grown by the tolerance. Its function is
// then certainly negative, and a pressing load is caught that little later. The same margin applies
// to the ends of regions, reloads and the return from "lifted". So nothing fires twice without a
// movement in between. What is small is told by the scales of the model and of the law, never by a
// unit: a mechanism written in other units has the same events.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <yoke/contact/geometry/contact_geometry.hpp>
#include <yoke/contact/laws/local_law.hpp>
#include <yoke/core/force.hpp>

namespace yoke {

struct Sliding;  // core/equations/grips/grip_rules.hpp

/// [m] The band around zero within which a penetration is not told from rounding: the geometric
/// mean of the rounding of lengths and of a penetration, so as far above the one as below the other
/// (1e-11 m for a pin that bears 100 N at 4 um in a mechanism of 0.1 m). `length` [m] is the model's
/// length scale, `penetration` [m] that of the contact, `rounding` [m] that of coordinates, which
/// counts far from the origin only.
double touch_tolerance(double length, double penetration, double rounding = 0.0);

class ContactElement final : public ForceElement {
 public:
  /// One law per region. `reference_force` [N] > 0 defines penetration_scale(). Throws ModelError.
  ContactElement(std::string name, BodyId a, BodyId b,
                 std::unique_ptr<const ContactGeometry> geometry, std::vector<ContactLaw> laws,
                 double reference_force);

  void evaluate(const ForceInput& in, const ForceRequest& out) const override;
  bool dissipates() const override { return true; }
  /// With friction on a surface that moves along itself.
  bool supplies() const override { return has_friction_ && geometry_->surface_speed() != 0.0; }
  /// "bristles" [m], if a region's friction law has a state.
  std::vector<Channel> states() const override;

  bool may_hold() const override { return may_hold_; }
  void calc_hold(const ForceInput& in, const ConstraintRequest& out) const override;
  double holding_force(const ForceInput& in) const override;
  void grip_changed(Grip before, EventContext& context) const override;

  /// Those of its laws (changeable()), as "pin.restitution"; where regions have several such laws, after
  /// the region: "pin.outer.restitution".
  std::vector<Parameter> parameters() const override;
  void check_parameters(const double* values) const override;

  int contacts() const override { return 1; }
  /// In contact if the start pose penetrates, or touches and approaches; an onset is recorded then.
  /// One that penetrates is taken for the impact that would have led there, and a note says so.
  /// A memory that agrees with the positions of the bodies is kept: the run continues a snapshot.
  void initialise_contacts(EventContext& context) const override;
  /// The smallest penetration under the reference force among the regions' laws.
  double penetration_scale() const override { return penetration_scale_; }

  /// The event functions; see the head of this file. Those that do not apply are -1.
  enum Event {
    onset,       ///< penetration crosses zero, or a remembered dent, upwards
    release,     ///< penetration falls to the permanent set, zero of most laws
    pull_off,    ///< the force would become tensile
    turn,        ///< end of compression
    reload,      ///< passes the largest penetration again
    forget,      ///< a remembered dent, or being behind the wall, is over
    region_end,  ///< into the next region
    limit,       ///< of the penetrations the law is valid for
    closest,     ///< deepest point of an approach
    kink,        ///< corner of the law
    fullest,     ///< lifted: where the law's force is largest
    grip,        ///< friction begins or ceases to hold
    event_count  ///< how many there are
  };
  int events() const override { return event_count; }
  bool may_hide(int event) const override { return event == onset || event == forget; }
  void calc_events(const ForceInput& in, double* g) const override;
  void handle_event(int event, EventContext& context) const override;

  /// While apart: of the nearest region, region "apart", forces 0. The last one, friction_force [N] > 0
  /// against a positive tangential velocity, only with friction.
  std::vector<Channel> channels() const override;
  void calc_channels(const ForceInput& in, double* values) const override;

  void draw(Drawing& drawing) const override { geometry_->draw(drawing); }

 private:
  struct Approach {
    double penetration, rate, acceleration;  // [m, m/s, m/s^2] d, d', d''
    double curvature;                        // [1/m] of the wall
    std::array<double, ContactKinematics::columns> gradient;
  };

  /// The normal force, and its derivatives by the coordinates and velocities of both bodies.
  struct Pressure {
    double force = 0.0;
    std::array<double, ContactKinematics::columns> by_q{}, by_v{};
  };

  double touch(const ForceInput& in) const;
  bool leaves_band(const ForceInput& in, const Approach& now) const;
  double margin(const ForceInput& in, const Approach& now, double end) const;
  bool remembers(const ForceInput& in, const ContactMemory& memory) const;
  static bool behind(const ContactMemory& memory);
  bool lifted(const ForceInput& in, const ContactMemory& memory) const;
  /// The normal force, with what the law stores and dissipates; where the law follows the curvature of
  /// the wall in the second.
  void evaluate_normal(const ForceInput& in, const ForceRequest& out, Pressure& pressure) const;
  void evaluate_following(const ForceInput& in, const ForceRequest& out, Pressure& pressure) const;
  void add_friction(const ForceInput& in, const ForceRequest& out, const Pressure& pressure) const;
  bool slides(const ContactMemory& memory) const;
  bool holds(int region) const { return law(region).friction.holds(); }
  Sliding sliding_velocity(const ForceInput& in) const;
  void handle_grip(EventContext& context) const;
  void take_grip(EventContext& context) const;
  void note_wedging(EventContext& context) const;
  FrictionOutput calc_friction(const ForceInput& in, double normal_force, double sliding) const;
  void let_bristles_go(EventContext& context, int region) const;
  void pass_bristles_on(EventContext& context, int from, int to) const;
  double friction_energy(const EventContext& context, int region) const;
  const ContactLaw& law(int region) const { return laws_[static_cast<std::size_t>(region)]; }
  /// The law with the numbers it has now.
  BoundLaw law(int region, const ForceInput& in) const {
    const int first = first_parameter_[static_cast<std::size_t>(region)];
    return {law(region), first < 0 ? nullptr : in.parameters + first};
  }
  void find_parameters(const std::string& owner);
  double limit_of(int region) const { return limits_[static_cast<std::size_t>(region)]; }
  std::array<double, ContactKinematics::columns> velocity(const Motion& motion) const;
  double rate(const ContactKinematics& k, const Motion& motion) const;
  ContactOutput calc_law(const ForceInput& in, const ContactMemory& memory) const;
  int watched_region(const ForceInput& in, const ContactMemory& memory) const;
  bool goes_on(const ForceInput& in, const ContactMemory& memory) const;
  Approach calc_approach(const EventContext& context, int region) const;

  void calc_events_apart(const ForceInput& in, double* g) const;
  void calc_events_lifted(const ForceInput& in, double* g) const;
  void calc_events_in_contact(const ForceInput& in, double* g) const;
  double calc_pull_off(const ForceInput& in, const LocalLaw& here, double d, double d_rate) const;
  double calc_regain(const ForceInput& in, double penetration) const;
  double calc_kink(const ForceInput& in, double d, double d_rate) const;

  void handle_onset(EventContext& context) const;
  void handle_release(EventContext& context, bool pulled_off) const;
  void handle_turn(EventContext& context) const;
  void handle_reload(EventContext& context) const;
  void handle_forget(EventContext& context) const;
  void handle_region_end(EventContext& context) const;
  void handle_kink(EventContext& context) const;
  void assume_approach(EventContext& context, const Approach& now) const;
  void note_side_of_kink(EventContext& context, const Approach& now) const;
  void come_through(EventContext& context, int region, const Approach& now) const;
  void begin(EventContext& context, int region, const Approach& now) const;
  bool works_without_mass(const EventContext& context, const Approach& now) const;
  void end_compression(EventContext& context, double penetration) const;
  void check_limit(EventContext& context, int region, double penetration) const;
  void record(EventContext& context, const char* kind, int region, const Approach& now) const;

  BodyId a_, b_;
  std::unique_ptr<const ContactGeometry> geometry_;
  std::vector<ContactLaw> laws_;  // continued beyond their limits
  std::vector<double> limits_;    // [m] where they end, infinite if they do not
  std::vector<std::string> region_names_;
  std::vector<int> first_parameter_;  // of each region's law, -1: it has none
  double penetration_scale_ = 0.0;
  double reference_force_;  // [N]
  bool has_friction_ = false, has_bristles_ = false, may_hold_ = false;
};

}  // namespace yoke
