// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The event functions of a contact; what happens where they cross zero is in
// contact_transitions.cpp.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <yoke/contact/details/contact_state.hpp>

namespace yoke {

namespace {

/// What counts as moving apart, in length scales per time scale: below it a rate may be rounding.
constexpr double slowest_recession = 1e-9;

}  // namespace

void ContactElement::calc_events(const ForceInput& in, double* g) const {
  std::fill_n(g, static_cast<int>(event_count), -1.0);
  if (in.contact->phase == ContactPhase::apart)
    calc_events_apart(in, g);
  else
    calc_events_in_contact(in, g);
}

void ContactElement::calc_events_apart(const ForceInput& in, double* g) const {
  const ContactMemory& memory = *in.contact;
  if (!remembers(in, memory)) {
    ContactKinematics k;
    geometry_->calc_kinematics(in.motion, watched_region(in, memory), false, k);
    if (behind(memory)) {
      g[forget] = -k.penetration;
      return;
    }
    g[onset] = k.penetration - memory.release_penetration;
    g[closest] = -rate(k, in.motion) - slowest_recession * in.scales.length / in.scales.time;
    return;
  }
  const double d = geometry_->penetration(in.motion, memory.region);
  g[region_end] = geometry_->boundary(in.motion, memory.region) - touch(in);
  if (lifted(in, memory)) {
    g[onset] = calc_regain(in, d);
    g[forget] = memory.permanent_set - d;
    calc_events_lifted(in, g);
  } else {
    g[onset] = d - memory.release_penetration;
    g[forget] = -d;
  }
}

/// Nothing holds the steps of a lifted contact back: what the law does within one has to be
/// watched.
void ContactElement::calc_events_lifted(const ForceInput& in, double* g) const {
  const ContactMemory& memory = *in.contact;
  ContactKinematics k;
  geometry_->calc_kinematics(in.motion, memory.region, false, k);
  const BoundLaw now = law(memory.region, in);
  const LocalLaw here(*now, k.curvature);
  const double d = k.penetration, d_rate = rate(k, in.motion);
  g[kink] = calc_kink(in, d, d_rate);
  // One step may reach far below the end of the contact, where the law means nothing.
  const double end = std::max(d, memory.permanent_set);
  g[fullest] = here.evaluate({end, d_rate, memory}).dforce_dpenetration;
}

/// [m] positive where the contact has passed the corner of its law.
double ContactElement::calc_kink(const ForceInput& in, double d, double d_rate) const {
  const ContactMemory& memory = *in.contact;
  if (!law(memory.region).dissipation.has_kink()) return -1.0;
  const BoundLaw here = law(memory.region, in);
  const double side = here->dissipation.kink({d, d_rate, memory}, here->elastic);
  return (memory.past_kink ? -side : side) - touch(in);
}

/// [N] positive where a lifted contact presses again. Below the permanent set the continuation of
/// the law means nothing; the contact has ended there.
double ContactElement::calc_regain(const ForceInput& in, double penetration) const {
  const ContactMemory& memory = *in.contact;
  if (!(penetration > memory.permanent_set)) return -reference_force_;
  const double stiffness = law(memory.region, in)->elastic.response(penetration).stiffness;
  return calc_law(in, memory).force - stiffness * touch(in);
}

void ContactElement::calc_events_in_contact(const ForceInput& in, double* g) const {
  const ContactMemory& memory = *in.contact;
  ContactKinematics k;
  geometry_->calc_kinematics(in.motion, memory.region, false, k);
  const BoundLaw now = law(memory.region, in);
  const LocalLaw here(*now, k.curvature);
  const double d = k.penetration, d_rate = rate(k, in.motion);

  g[release] = memory.permanent_set - d;
  g[kink] = calc_kink(in, d, d_rate);
  if (here.dissipation().release() == Release::at_zero_force)
    g[pull_off] = calc_pull_off(in, here, d, d_rate);
  if (here.dissipation().needs_largest_penetration()) {
    if (memory.phase == ContactPhase::compressing)
      g[turn] = -d_rate;
    else
      g[reload] = d - (memory.largest_penetration + touch(in));
  }
  g[region_end] = geometry_->boundary(in.motion, memory.region) - touch(in);
  if (may_hold_) g[grip] = calc_grip_event(*this, in, [&] { return sliding_velocity(in); });
  if (std::isfinite(limit_of(memory.region)))
    g[limit] = d - usable_share_of_limit * limit_of(memory.region);
}

/// -force where it counts. At d = 0 itself `release` is the sharper function, as a force may vanish
/// there with zero slope; but a force that clearly pulls there has passed zero earlier in the step.
double ContactElement::calc_pull_off(const ForceInput& in, const LocalLaw& here, double d,
                                     double d_rate) const {
  const ContactMemory& memory = *in.contact;
  const double margin = 2.0 * touch(in);
  const double force = here.evaluate({d, d_rate, memory}).force;
  const double noise = here.elastic().response(d).stiffness * margin;
  const bool counts = d > memory.permanent_set + margin || force < -noise;
  return counts ? -force : -reference_force_;
}

}  // namespace yoke
