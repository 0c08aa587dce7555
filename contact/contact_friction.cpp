// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Friction of a contact.
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
  return law(in.contact->region)
      .friction.evaluate({.normal_force = std::max(normal_force, 0.0),
                          .sliding = sliding,
                          .state = has_bristles_ ? in.z[0] : 0.0,
                          .reference_force = reference_force_});
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
  const FrictionLaw& friction = law(region).friction;
  if (!friction.has_state()) return 0.0;
  return friction.evaluate({.state = context.z[0], .reference_force = reference_force_})
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
