// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// How a contact begins, turns, passes from region to region and ends.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <yoke/contact/details/approach.hpp>
#include <yoke/contact/details/contact_state.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

/// Added to an acceleration before it is trusted, in length scales per square of the time scale:
/// loads may change within a step.
constexpr double unforeseen_acceleration = 1.0;
constexpr double smallest_margin = 1e-3;  // of the band, still above rounding

}  // namespace

/// Does the rate carry the penetration through twice the band before the acceleration can turn it?
bool ContactElement::leaves_band(const ForceInput& in, const Approach& now) const {
  const double time = in.scales.time;
  const double unforeseen = unforeseen_acceleration * in.scales.length / (time * time);
  const double strongest = std::abs(now.acceleration) + unforeseen;
  return now.rate * now.rate > 4.0 * touch(in) * strongest;
}

/// [m] How far above `end` the next onset is, so that its function is negative now: a function that
/// is zero would not be seen to cross it, and the whole flight may be one step. One that is negative by
/// rounding alone is no better: the next look may find it positive.
double ContactElement::margin(const ForceInput& in, const Approach& now, double end) const {
  const double beyond = std::max(now.penetration - end, 0.0), band = touch(in);
  const double least = smallest_margin * band;
  if (!(now.rate < 0.0 && leaves_band(in, now))) return beyond + band;
  return now.penetration < end - least ? 0.0 : beyond + least;
}

/// The region whose formula counts: the one touched or remembered, else the nearest.
int ContactElement::watched_region(const ForceInput& in, const ContactMemory& memory) const {
  const bool remembered = memory.phase != ContactPhase::apart || remembers(in, memory);
  return remembered ? memory.region : geometry_->nearest(in.motion);
}

ContactElement::Approach ContactElement::calc_approach(const EventContext& context,
                                                       int region) const {
  const Motion& motion = context.input.motion;
  ContactKinematics k;
  geometry_->calc_kinematics(motion, region, true, k);
  const ContactRow v = velocity(motion);
  double acceleration = dot(v, times(k.hessian, v));
  if (context.acceleration != nullptr)
    for (std::size_t i = 0; i < columns; ++i)
      acceleration += k.gradient[i] * context.acceleration[i];
  return {k.penetration, dot(k.gradient, v), acceleration, k.curvature, k.gradient};
}

/// Does the memory of a snapshot still agree with where the bodies are?
bool ContactElement::goes_on(const ForceInput& in, const ContactMemory& memory) const {
  if (behind(memory)) return geometry_->penetration(in.motion, geometry_->nearest(in.motion)) > 0.0;
  const bool apart = memory.phase == ContactPhase::apart;
  if (apart && !remembers(in, memory)) return false;
  const double end = apart && !lifted(in, memory) ? 0.0 : memory.permanent_set;
  return geometry_->penetration(in.motion, memory.region) > end - touch(in);
}

void ContactElement::initialise_contacts(EventContext& context) const {
  ContactMemory& memory = *context.contact;
  if (goes_on(context.input, memory)) return;
  memory = {};
  if (has_bristles_ && context.z != nullptr) context.z[0] = 0.0;
  const int region = geometry_->nearest(context.input.motion);
  const Approach now = calc_approach(context, region);
  if (now.penetration < -touch(context.input)) return;
  const bool leaves = leaves_band(context.input, now);
  if (now.penetration > touch(context.input) || (leaves && now.rate > 0.0)) {
    begin(context, region, now);
    if (now.penetration > touch(context.input) && !context.at_rest) assume_approach(context, now);
    record(context, "onset", region, now);
    check_limit(context, region, now.penetration);
  } else {
    memory.release_penetration = margin(context.input, now, 0.0);
  }
}

void ContactElement::handle_event(int event, EventContext& context) const {
  // Two events may be located at the same instant, and the first may have made the second void.
  const bool apart = context.contact->phase == ContactPhase::apart;
  switch (event) {
    case onset:
      if (apart) handle_onset(context);
      break;
    case release:
    case pull_off:
      if (!apart) handle_release(context, event == pull_off);
      break;
    case turn:
      if (context.contact->phase == ContactPhase::compressing) handle_turn(context);
      break;
    case reload:
      if (context.contact->phase == ContactPhase::restituting) handle_reload(context);
      break;
    case forget:
      if (apart && (behind(*context.contact) || remembers(context.input, *context.contact)))
        handle_forget(context);
      break;
    case region_end:
      if (!apart || remembers(context.input, *context.contact)) handle_region_end(context);
      break;
    case limit:
      if (!apart) {
        const int region = context.contact->region;
        check_limit(context, region, geometry_->penetration(context.input.motion, region));
      }
      break;
    case kink:
      if (!apart || lifted(context.input, *context.contact)) handle_kink(context);
      break;
    case grip:
      if (!apart) handle_grip(context);
      break;
    default:
      break;
  }
}

void ContactElement::handle_onset(EventContext& context) const {
  ContactMemory& memory = *context.contact;
  const int region = watched_region(context.input, memory);
  const Approach now = calc_approach(context, region);
  const bool remembered = remembers(context.input, memory);
  if (!remembered && now.penetration > std::max(penetration_scale_, 1e3 * touch(context.input))) {
    come_through(context, region, now);
    return;
  }
  if (!lifted(context.input, memory)) {
    const double threshold = remembered ? memory.permanent_set : 0.0;
    const bool enters = now.rate > 0.0 && leaves_band(context.input, now);
    // What it was put off to has been reached, also if projecting the position has taken it back a little: put off
    // to the same again, it would never be met.
    const double reached = std::max(now.penetration, memory.release_penetration);
    if (!enters && reached <= threshold + 0.5 * touch(context.input)) {
      memory.release_penetration = std::max(now.penetration, threshold) + touch(context.input);
      return;
    }
  }
  if (remembered) {
    // The same contact goes on: what it recorded at its first onset stays.
    memory.phase = law(region).dissipation.needs_largest_penetration() ? ContactPhase::restituting
                                                                       : ContactPhase::compressing;
    memory.release_penetration = 0.0;
    take_grip(context);
  } else {
    begin(context, region, now);
  }
  record(context, "onset", region, now);
}

/// What was apart is deep in a wall at once: it did not come through the surface but from behind, as
/// a pin that has left a slot and goes back through its material. It is apart until it is in front.
void ContactElement::come_through(EventContext& context, int region, const Approach& now) const {
  context.contact->release_penetration = behind_the_wall;
  if (context.note)
    context.note(fmt::format(
        "came from behind the wall '{}' at t = {:.6g} s, where it is {:.3g} m deep; it was taken to be "
        "apart until it was in front of the wall",
        region_names_[static_cast<std::size_t>(region)], context.input.motion.t, now.penetration));
}

void ContactElement::begin(EventContext& context, int region, const Approach& now) const {
  ContactMemory& memory = *context.contact;
  memory = {};
  memory.phase = ContactPhase::compressing;
  memory.region = region;
  memory.onset_time = context.input.motion.t;
  memory.approach_velocity = std::max(now.rate, 0.0);
  memory.effective_mass = context.effective_mass(now.gradient.data());
  take_grip(context);
  if (has_friction_ && !may_hold_) note_wedging(context);
  if (context.fail && !std::isfinite(memory.effective_mass) && !works_without_mass(context, now))
    context.fail(fmt::format(
        "{}: the law '{}' damps with the effective mass of the contact, but at t = {:.9g} s drivers "
        "and joints leave its bodies no motion of their own towards each other: there is none; "
        "take a law that needs no mass",
        region_names_[static_cast<std::size_t>(region)], law(region).name(), memory.onset_time));
  note_side_of_kink(context, now);
  if (now.rate <= 0.0 && law(region).dissipation.needs_largest_penetration())
    end_compression(context, now.penetration);
}

bool ContactElement::works_without_mass(const EventContext& context, const Approach& now) const {
  const ContactMemory& memory = *context.contact;
  const double reference = penetration_scale_;
  const double rate = std::max(now.rate, memory.approach_velocity);
  return std::isfinite(
      law(memory.region, context.input)->evaluate({reference, rate, memory}).force);
}

/// A contact that is found within the wall: the impact that would have led there is assumed before
/// it, or laws that divide by the approach velocity would damp it like glue.
void ContactElement::assume_approach(EventContext& context, const Approach& now) const {
  ContactMemory& memory = *context.contact;
  if (now.penetration >= limit_of(memory.region)) return;
  const BoundLaw here = law(memory.region, context.input);
  const LocalLaw local(*here, now.curvature);
  memory.approach_velocity =
      approach_velocity_to({local.elastic(), here->dissipation}, memory, now.penetration, now.rate);
  note_side_of_kink(context, now);
  // Of no interest where the law does not ask for it.
  ContactMemory faster = memory;
  faster.approach_velocity *= 2.0;
  const bool matters = local.evaluate({now.penetration, now.rate + 1.0, memory}).force !=
                       local.evaluate({now.penetration, now.rate + 1.0, faster}).force;
  if (context.note && matters)
    context.note(fmt::format(
        "starts {:.4g} m deep in the wall at a rate of {:.4g} m/s; its approach velocity is taken "
        "to be {:.4g} m/s, that of the impact which would have led there",
        now.penetration, now.rate, memory.approach_velocity));
}

void ContactElement::note_side_of_kink(EventContext& context, const Approach& now) const {
  ContactMemory& memory = *context.contact;
  const BoundLaw here = law(memory.region, context.input);
  memory.past_kink =
      here->dissipation.has_kink() &&
      here->dissipation.kink({now.penetration, now.rate, memory}, here->elastic) > 0.0;
}

void ContactElement::end_compression(EventContext& context, double penetration) const {
  ContactMemory& memory = *context.contact;
  const BoundLaw here = law(memory.region, context.input);
  memory.phase = ContactPhase::restituting;
  memory.largest_penetration = penetration;
  memory.permanent_set = here->dissipation.permanent_set(memory, here->elastic);
}

void ContactElement::handle_release(EventContext& context, bool pulled_off) const {
  ContactMemory& memory = *context.contact;
  const int region = memory.region;
  const Approach now = calc_approach(context, region);
  // Just after an onset the integrator's noise can take d below zero once more on its way in.
  if (!pulled_off && now.rate > 0.0 && leaves_band(context.input, now)) return;
  const double let_go = memory.permanent_set;
  memory.phase = ContactPhase::apart;
  memory.grip = Grip::none;
  let_bristles_go(context, region);
  if (pulled_off && now.penetration > let_go + 2.0 * touch(context.input)) {
    memory.release_penetration = now.penetration;
  } else {
    memory.release_penetration = let_go + margin(context.input, now, let_go);
  }
  record(context, "release", region, now);
}

void ContactElement::handle_turn(EventContext& context) const {
  ContactMemory& memory = *context.contact;
  const Approach now = calc_approach(context, memory.region);
  end_compression(context, now.penetration);
  record(context, "turn", memory.region, now);
}

void ContactElement::handle_reload(EventContext& context) const {
  ContactMemory& memory = *context.contact;
  const Approach now = calc_approach(context, memory.region);
  if (now.rate > 0.0 && leaves_band(context.input, now)) {
    memory.phase = ContactPhase::compressing;
    record(context, "reload", memory.region, now);
  } else {
    end_compression(context, now.penetration);  // creeps past by the margin: the end moves along
  }
}

void ContactElement::handle_forget(EventContext& context) const {
  ContactMemory& memory = *context.contact;
  if (lifted(context.input, memory) && memory.permanent_set > 2.0 * touch(context.input)) {
    memory.release_penetration = memory.permanent_set;
    return;
  }
  const int region = watched_region(context.input, memory);
  memory = {};
  memory.region = region;
  // A rest of rounding must not leave the onset on the wrong side of zero.
  const Approach now = calc_approach(context, region);
  memory.release_penetration = margin(context.input, now, 0.0);
}

void ContactElement::handle_region_end(EventContext& context) const {
  ContactMemory& memory = *context.contact;
  const double stored_before = calc_law(context.input, memory).stored_energy;
  const int before = memory.region;
  memory.region = geometry_->successor(context.input.motion, memory.region);
  const Approach now = calc_approach(context, memory.region);
  record(context, "region", memory.region, now);
  note_side_of_kink(context, now);
  if (memory.phase == ContactPhase::apart) return;

  // The law may be another one: bring the memory to what it expects.
  const DissipativeLaw& dissipation = law(memory.region).dissipation;
  if (!dissipation.needs_largest_penetration()) {
    memory.phase = ContactPhase::compressing;
    memory.largest_penetration = memory.permanent_set = 0.0;
  } else if (memory.phase == ContactPhase::restituting) {
    end_compression(context, memory.largest_penetration);
  } else if (now.rate < 0.0) {
    end_compression(context, now.penetration);
  }
  pass_bristles_on(context, before, memory.region);
  if (may_hold_) take_grip(context);
  // Laws of different stiffness store different energies at the same penetration.
  if (context.dissipate)
    context.dissipate(stored_before - calc_law(context.input, memory).stored_energy);
  check_limit(context, memory.region, now.penetration);
}

/// The memory changes, so the integrator starts afresh.
void ContactElement::handle_kink(EventContext& context) const {
  context.contact->past_kink = !context.contact->past_kink;
}

void ContactElement::check_limit(EventContext& context, int region, double penetration) const {
  const ContactLaw& here = law(region);
  if (penetration < (usable_share_of_limit - 1e-9) * limit_of(region)) return;
  context.fail(fmt::format(
      "{}: at t = {:.9g} s the penetration {:g} m has reached {:g} % of the {:g} m where "
      "the law '{}' ends",
      region_names_[static_cast<std::size_t>(region)], context.input.motion.t, penetration,
      100.0 * usable_share_of_limit, limit_of(region), here.name()));
}

void ContactElement::record(EventContext& context, const char* kind, int region,
                            const Approach& now) const {
  if (!context.record) return;  // at the start of a run nobody may be listening
  EventRecord event;
  event.kind = kind;
  event.region = region_names_[static_cast<std::size_t>(region)];
  event.speed = now.rate;
  event.penetration = now.penetration;
  context.record(std::move(event));
}

}  // namespace yoke
