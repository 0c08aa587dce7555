// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Friction of a contact.
#include <fmt/format.h>

#include <algorithm>

#include <yoke/contact/details/contact_state.hpp>

namespace yoke {

std::vector<Channel> ContactElement::states() const {
  if (!has_bristles_) return {};
  double scale = 0.0;
  for (const ContactLaw& each : laws_)
    if (each.friction.has_state())
      scale = std::max(scale, each.friction.state_scale(reference_force_));
  return {{.name = "bristles", .unit = "m", .scale = scale}};
}

FrictionOutput ContactElement::calc_friction(const ForceInput& in, double normal_force,
                                             double sliding) const {
  return law(in.contact->region, in)
      ->friction.evaluate({.normal_force = std::max(normal_force, 0.0),
                           .sliding = sliding,
                           .state = has_bristles_ ? in.z[0] : 0.0,
                           .direction = direction_of(in.contact->grip),
                           .reference_force = reference_force_});
}

/// In contact, with friction that is a force now.
bool ContactElement::slides(const ContactMemory& memory) const {
  if (memory.phase == ContactPhase::apart || law(memory.region).friction.none()) return false;
  return !holds(memory.region) || direction_of(memory.grip) != 0.0;
}

Sliding ContactElement::sliding_velocity(const ForceInput& in) const {
  SlipKinematics k;
  geometry_->calc_slip(in.motion, in.contact->region, false, k);
  const ContactRow v = velocity(in.motion);
  const double belt = geometry_->surface_speed();
  double terms = std::abs(belt);
  for (std::size_t i = 0; i < columns; ++i) terms += std::abs(k.row[i] * v[i]);
  return {dot(k.row, v) - belt, slowest_sliding(in.scales, terms)};
}

void ContactElement::calc_hold(const ForceInput& in, const ConstraintRequest& out) const {
  SlipKinematics k;
  const bool want_slope = out.gamma != nullptr || out.H != nullptr || out.K != nullptr;
  geometry_->calc_slip(in.motion, in.contact->region, want_slope, k);
  const ContactRow v = velocity(in.motion);
  if (out.G != nullptr) std::ranges::copy(k.row, out.G);
  if (out.phi_t != nullptr) *out.phi_t = -geometry_->surface_speed();
  if (out.gamma != nullptr) *out.gamma = -dot(v, times(k.slope, v));
  for (std::size_t i = 0; i < columns; ++i) {
    if (out.H != nullptr) {
      out.H[i] = 0.0;
      for (std::size_t j = 0; j < columns; ++j) out.H[i] += v[j] * k.slope[columns * j + i];
    }
    for (std::size_t j = 0; out.K != nullptr && j < columns; ++j)
      out.K[columns * i + j] += *out.lambda * k.slope[columns * i + j];
  }
}

double ContactElement::holding_force(const ForceInput& in) const {
  const double pressure = std::max(calc_law(in, *in.contact).force, 0.0);
  return law(in.contact->region, in)->friction.holding_force(pressure);
}

void ContactElement::handle_grip(EventContext& context) const {
  context.contact->grip =
      grip_after_event(context.input, [&] { return sliding_velocity(context.input); });
}

/// At an onset, or where the contact has come to another law.
void ContactElement::take_grip(EventContext& context) const {
  ContactMemory& memory = *context.contact;
  memory.grip = holds(memory.region)
                    ? grip_at_onset(memory.grip, sliding_velocity(context.input).speed)
                    : Grip::none;
}

/// Sliding whose friction presses the surfaces together more than the normal force holds them apart: as
/// rigid bodies they have no motion, or several (P. Painleve, C. R. Acad. Sci. Paris 1895, 121, 112-115).
/// Compliant ones have one, in which the force grows until sliding has stopped or they part.
void ContactElement::note_wedging(EventContext& context) const {
  const int region = context.contact->region;
  if (law(region).friction.none()) return;
  ContactKinematics k;
  SlipKinematics s;
  geometry_->calc_kinematics(context.input.motion, region, false, k);
  geometry_->calc_slip(context.input.motion, region, false, s);
  const double sliding = sliding_velocity(context.input).speed;
  const double mu = calc_friction(context.input, reference_force_, sliding).dforce_dnormal;
  ContactRow sum = k.gradient, difference = k.gradient;
  for (std::size_t i = 0; i < columns; ++i) sum[i] += s.row[i], difference[i] -= s.row[i];
  const auto mobility = [&](const ContactRow& d) { return 1.0 / context.effective_mass(d.data()); };
  const double along = mobility(k.gradient), across = 0.25 * (mobility(sum) - mobility(difference));
  if (!(along + mu * across <= 0.0) || mu == 0.0 || !context.note) return;
  context.note(fmt::format(
      "slides with a friction that wedges it in (Painleve's paradox) at t = {:.6g} s: the coefficient of "
      "friction is {:.3g}, and beyond {:.3g} friction presses more than the normal force holds apart; "
      "rigid bodies would have no motion, what happens here is up to the elasticity of the contact",
      context.input.motion.t, std::abs(mu), along / std::abs(across)));
}

void ContactElement::grip_changed(Grip before, EventContext& context) const {
  const ContactMemory& memory = *context.contact;
  if (slides(memory)) note_wedging(context);
  const bool begins = before == Grip::none || memory.grip == Grip::none;
  if (rests(memory.grip) == rests(before) && (begins || rests(before))) return;
  if (begins && !rests(memory.grip)) return;
  const Approach now = calc_approach(context, memory.region);
  record(context, rests(memory.grip) ? "stick" : "slip", memory.region, now);
}

void ContactElement::add_friction(const ForceInput& in, const ForceRequest& out,
                                  const Pressure& pressure) const {
  const int region = in.contact->region;
  const bool want_slope = out.dQ_dq != nullptr || out.dz_dq != nullptr;
  SlipKinematics k;
  geometry_->calc_slip(in.motion, region, want_slope, k);
  const ContactRow& s = k.row;
  const ContactRow v = velocity(in.motion);
  const double belt = geometry_->surface_speed();
  const FrictionOutput f = calc_friction(in, pressure.force, dot(s, v) - belt);

  if (out.energy != nullptr) {
    out.energy->stored += f.stored_energy;
    out.energy->dissipated_power += f.dissipated_power;
    out.energy->supplied_power -= f.force * belt;
  }
  if (out.Q != nullptr)
    for (std::size_t i = 0; i < columns; ++i) out.Q[i] -= f.force * s[i];
  const bool state = law(region).friction.has_state();
  if (state && out.z_dot != nullptr) out.z_dot[0] = f.rate;
  if (state && out.dz_dz != nullptr) out.dz_dz[0] = f.drate_dstate;

  if (!wants_jacobian(out)) return;
  const double presses = pressure.force > 0.0 ? 1.0 : 0.0;
  for (std::size_t j = 0; j < columns; ++j) {
    double slip_q = 0.0;
    if (want_slope)
      for (std::size_t i = 0; i < columns; ++i) slip_q += k.slope[columns * i + j] * v[i];
    const double N_q = presses * pressure.by_q[j], N_v = presses * pressure.by_v[j];
    const double T_q = f.dforce_dnormal * N_q + f.dforce_dsliding * slip_q;
    const double T_v = f.dforce_dnormal * N_v + f.dforce_dsliding * s[j];
    for (std::size_t i = 0; i < columns; ++i) {
      const std::size_t entry = columns * i + j;
      if (out.dQ_dq != nullptr) out.dQ_dq[entry] -= s[i] * T_q + f.force * k.slope[entry];
      if (out.dQ_dv != nullptr) out.dQ_dv[entry] -= s[i] * T_v;
    }
    if (!state) continue;
    if (out.dQ_dz != nullptr) out.dQ_dz[j] -= f.dforce_dstate * s[j];
    if (out.dz_dq != nullptr) out.dz_dq[j] = f.drate_dnormal * N_q + f.drate_dsliding * slip_q;
    if (out.dz_dv != nullptr) out.dz_dv[j] = f.drate_dnormal * N_v + f.drate_dsliding * s[j];
  }
}

/// [J] stored in the bristles under the law of a region.
double ContactElement::friction_energy(const EventContext& context, int region) const {
  if (!law(region).friction.has_state()) return 0.0;
  return law(region, context.input)
      ->friction.evaluate({.state = context.z[0], .reference_force = reference_force_})
      .stored_energy;
}

/// The bristles keep their deflection under another law that has some; what they store may change.
void ContactElement::pass_bristles_on(EventContext& context, int from, int to) const {
  if (!has_bristles_ || context.z == nullptr) return;
  if (!law(to).friction.has_state()) return let_bristles_go(context, from);
  if (context.dissipate)
    context.dissipate(friction_energy(context, from) - friction_energy(context, to));
}

/// The contact has ended in this region, or passed on from it into one without bristles.
void ContactElement::let_bristles_go(EventContext& context, int region) const {
  if (!has_bristles_ || context.z == nullptr) return;
  if (context.dissipate) context.dissipate(friction_energy(context, region));
  context.z[0] = 0.0;
}

}  // namespace yoke
