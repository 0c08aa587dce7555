// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/contact_element.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <yoke/core/error.hpp>

namespace yoke {

namespace {

constexpr std::size_t columns = ContactKinematics::columns;
using Row = std::array<double, columns>;

/// Share of a law's limit at which a run stops. The event must be found by steps that still
/// evaluate the law, and at the limit itself a law may have an infinite stiffness.
constexpr double usable_share_of_limit = 0.99;
constexpr double continued_from = 0.995;  // of the limit: beyond the event, short of the pole

/// A law with an end, continued along its tangent: the step that meets the limit looks beyond it
/// before the event is located. No result comes from there.
struct Continued {
  ElasticLaw law;
  double from = continued_from * law.limit();
  ElasticResponse at_end = law.response(from);

  ElasticResponse operator()(double d) const {
    if (d <= from) return law.response(d);
    const double x = d - from, F = at_end.force, k = at_end.stiffness;
    return {F + k * x, k, at_end.energy + x * (F + 0.5 * k * x)};
  }
  std::string name() const { return law.name(); }
};

/// [m/s^2] added to an acceleration before it is trusted: loads may change within a step.
constexpr double unforeseen_acceleration = 1.0;

/// [m/s] what counts as moving apart: below it a rate may be rounding.
constexpr double slowest_recession = 1e-9;

double dot(const Row& a, const Row& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < columns; ++i) sum += a[i] * b[i];
  return sum;
}

Row times(const std::array<double, columns * columns>& matrix, const Row& v) {
  Row product{};
  for (std::size_t i = 0; i < columns; ++i)
    for (std::size_t j = 0; j < columns; ++j) product[i] += matrix[i * columns + j] * v[j];
  return product;
}

/// Does the rate carry the penetration through twice the band before the acceleration can turn it?
bool leaves_band(double rate, double acceleration) {
  const double strongest = std::abs(acceleration) + unforeseen_acceleration;
  return rate * rate > 4.0 * touch_tolerance * strongest;
}

// The two kinds of "apart" with a memory; margins keep a put-off onset from being taken for them.
bool has_memory(const ContactMemory& m) { return m.release_penetration > 2.0 * touch_tolerance; }
bool is_lifted(const ContactMemory& m) {
  return m.phase == ContactPhase::apart &&
         m.release_penetration > m.permanent_set + 2.0 * touch_tolerance;
}

}  // namespace

ContactElement::ContactElement(std::string name, BodyId a, BodyId b,
                               std::unique_ptr<const ContactGeometry> geometry,
                               std::vector<ContactLaw> laws, double reference_force)
    : ForceElement(std::move(name), {a, b}),
      a_(a),
      b_(b),
      geometry_(std::move(geometry)),
      laws_(std::move(laws)),
      region_names_(geometry_->region_names()) {
  const std::string owner = fmt::format("contact '{}'", this->name());
  require_positive(owner, "reference_force", reference_force, "N");
  if (laws_.size() != region_names_.size())
    throw ModelError(fmt::format("{}: {} laws are given for {} regions", owner, laws_.size(),
                                 region_names_.size()));
  penetration_scale_ = std::numeric_limits<double>::infinity();
  for (ContactLaw& each : laws_) {
    penetration_scale_ = std::min(penetration_scale_, each.elastic.penetration_at(reference_force));
    limits_.push_back(each.penetration_limit());
    if (std::isfinite(limits_.back())) each.elastic = Continued{each.elastic};
  }
}

// ---- force
// ----------------------------------------------------------------------------------------

std::array<double, columns> ContactElement::velocity(const Motion& motion) const {
  const BodyMotion &a = motion[a_], &b = motion[b_];
  return {a.vx, a.vy, a.omega, b.vx, b.vy, b.omega};
}

double ContactElement::rate(const ContactKinematics& k, const Motion& motion) const {
  return dot(k.gradient, velocity(motion));
}

ContactOutput ContactElement::calc_law(const ForceInput& in, const ContactMemory& memory) const {
  ContactKinematics k;
  geometry_->calc_kinematics(in.motion, memory.region, false, k);
  return law(memory.region).evaluate({k.penetration, rate(k, in.motion), memory});
}

void ContactElement::evaluate(const ForceInput& in, const ForceRequest& out) const {
  const ContactMemory& memory = *in.contact;
  if (out.energy != nullptr) *out.energy = {};
  const bool apart = memory.phase == ContactPhase::apart;
  if (apart && !is_lifted(memory)) return;

  const bool want_jacobian = !apart && (out.dQ_dq != nullptr || out.dQ_dv != nullptr);
  ContactKinematics k;
  geometry_->calc_kinematics(in.motion, memory.region, want_jacobian, k);
  const Row& g = k.gradient;
  const Row v = velocity(in.motion);
  const double d_rate = dot(g, v);
  const ContactOutput f = law(memory.region).evaluate({k.penetration, d_rate, memory});

  if (out.energy != nullptr) {
    out.energy->stored = f.stored_energy;
    // Lifted: no force, so what the surface loses while it relaxes is dissipated, D = -dS/dt.
    out.energy->dissipated_power = f.dissipated_power - (apart ? f.force * d_rate : 0.0);
  }
  if (apart) return;
  if (out.Q != nullptr)
    for (std::size_t i = 0; i < columns; ++i) out.Q[i] = -f.force * g[i];
  if (!want_jacobian) return;
  const Row Hv = times(k.hessian, v);
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      const std::size_t entry = i * columns + j;
      if (out.dQ_dq != nullptr)
        out.dQ_dq[entry] = -g[i] * (f.dforce_dpenetration * g[j] + f.dforce_drate * Hv[j]) -
                           f.force * k.hessian[entry];
      if (out.dQ_dv != nullptr) out.dQ_dv[entry] = -f.dforce_drate * g[i] * g[j];
    }
  }
}

// ---- event functions
// ------------------------------------------------------------------------------

void ContactElement::calc_events(const ForceInput& in, double* g) const {
  std::fill_n(g, static_cast<int>(event_count), -1.0);
  if (in.contact->phase == ContactPhase::apart)
    calc_events_apart(in, g);
  else
    calc_events_in_contact(in, g);
}

void ContactElement::calc_events_apart(const ForceInput& in, double* g) const {
  const ContactMemory& memory = *in.contact;
  const double d = geometry_->penetration(in.motion, watched_region(in.motion, memory));
  if (!has_memory(memory)) {
    g[onset] = d - memory.release_penetration;
    ContactKinematics k;
    geometry_->calc_kinematics(in.motion, geometry_->nearest(in.motion), false, k);
    g[closest] = -rate(k, in.motion) - slowest_recession;
    return;
  }
  g[region_end] = geometry_->boundary(in.motion, memory.region) - touch_tolerance;
  if (is_lifted(memory)) {
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
  const ContactLaw& here = law(memory.region);
  ContactKinematics k;
  geometry_->calc_kinematics(in.motion, memory.region, false, k);
  const double d = k.penetration, d_rate = rate(k, in.motion);
  g[kink] = calc_kink(here, memory, d, d_rate);
  // One step may reach far below the end of the contact, where the law means nothing.
  const double end = std::max(d, memory.permanent_set);
  g[fullest] = here.evaluate({end, d_rate, memory}).dforce_dpenetration;
}

/// [m] positive where the contact has passed the corner of its law.
double ContactElement::calc_kink(const ContactLaw& here, const ContactMemory& memory, double d,
                                 double d_rate) const {
  if (!here.dissipation.has_kink()) return -1.0;
  const double side = here.dissipation.kink({d, d_rate, memory}, here.elastic);
  return (memory.past_kink ? -side : side) - touch_tolerance;
}

/// [N] positive where a lifted contact presses again. Below the permanent set the continuation of
/// the law means nothing; the contact has ended there.
double ContactElement::calc_regain(const ForceInput& in, double penetration) const {
  const ContactMemory& memory = *in.contact;
  if (!(penetration > memory.permanent_set)) return -1.0;
  const double stiffness = law(memory.region).elastic.response(penetration).stiffness;
  return calc_law(in, memory).force - stiffness * touch_tolerance;
}

void ContactElement::calc_events_in_contact(const ForceInput& in, double* g) const {
  const ContactMemory& memory = *in.contact;
  const ContactLaw& here = law(memory.region);
  ContactKinematics k;
  geometry_->calc_kinematics(in.motion, memory.region, false, k);
  const double d = k.penetration, d_rate = rate(k, in.motion);

  g[release] = memory.permanent_set - d;
  g[kink] = calc_kink(here, memory, d, d_rate);
  if (here.dissipation.release() == Release::at_zero_force)
    g[pull_off] = calc_pull_off(here, memory, d, d_rate);
  if (here.dissipation.needs_largest_penetration()) {
    if (memory.phase == ContactPhase::compressing)
      g[turn] = -d_rate;
    else
      g[reload] = d - (memory.largest_penetration + touch_tolerance);
  }
  g[region_end] = geometry_->boundary(in.motion, memory.region) - touch_tolerance;
  if (std::isfinite(limit_of(memory.region)))
    g[limit] = d - usable_share_of_limit * limit_of(memory.region);
}

/// -force where it counts. At d = 0 itself `release` is the sharper function, as a force may vanish
/// there with zero slope; but a force that clearly pulls there has passed zero earlier in the step.
double ContactElement::calc_pull_off(const ContactLaw& here, const ContactMemory& memory, double d,
                                     double d_rate) const {
  const double force = here.evaluate({d, d_rate, memory}).force;
  const double noise = here.elastic.response(d).stiffness * 2.0 * touch_tolerance;
  const bool counts = d > memory.permanent_set + 2.0 * touch_tolerance || force < -noise;
  return counts ? -force : -1.0;
}

// ---- transitions
// ----------------------------------------------------------------------------------

/// The region whose formula counts: the one touched or remembered, else the nearest.
int ContactElement::watched_region(const Motion& motion, const ContactMemory& memory) const {
  const bool remembered = memory.phase != ContactPhase::apart || has_memory(memory);
  return remembered ? memory.region : geometry_->nearest(motion);
}

ContactElement::Approach ContactElement::calc_approach(const EventContext& context,
                                                       int region) const {
  const Motion& motion = context.input.motion;
  ContactKinematics k;
  geometry_->calc_kinematics(motion, region, true, k);
  const Row v = velocity(motion);
  double acceleration = dot(v, times(k.hessian, v));
  if (context.acceleration != nullptr)
    for (std::size_t i = 0; i < columns; ++i)
      acceleration += k.gradient[i] * context.acceleration[i];
  return {k.penetration, dot(k.gradient, v), acceleration, k.gradient};
}

/// Does the memory of a snapshot still agree with where the bodies are?
bool ContactElement::goes_on(const Motion& motion, const ContactMemory& memory) const {
  const bool apart = memory.phase == ContactPhase::apart;
  if (apart && !has_memory(memory)) return false;
  const double end = apart && !is_lifted(memory) ? 0.0 : memory.permanent_set;
  return geometry_->penetration(motion, memory.region) > end - touch_tolerance;
}

void ContactElement::initialise_contacts(EventContext& context) const {
  ContactMemory& memory = *context.contact;
  if (goes_on(context.input.motion, memory)) return;
  memory = {};
  const int region = geometry_->nearest(context.input.motion);
  const Approach now = calc_approach(context, region);
  if (now.penetration < -touch_tolerance) return;
  const bool leaves = leaves_band(now.rate, now.acceleration);
  if (now.penetration > touch_tolerance || (leaves && now.rate > 0.0)) {
    begin(context, region, now);
    record(context, "onset", region, now);
    check_limit(context, region, now.penetration);
  } else if (!leaves) {
    memory.release_penetration = std::max(now.penetration, 0.0) + touch_tolerance;
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
      if (apart && has_memory(*context.contact)) handle_forget(context);
      break;
    case region_end:
      if (!apart || has_memory(*context.contact)) handle_region_end(context);
      break;
    case limit:
      if (!apart) {
        const int region = context.contact->region;
        check_limit(context, region, geometry_->penetration(context.input.motion, region));
      }
      break;
    case kink:
      if (!apart || is_lifted(*context.contact)) handle_kink(context);
      break;
    default:
      break;
  }
}

void ContactElement::handle_onset(EventContext& context) const {
  ContactMemory& memory = *context.contact;
  const int region = watched_region(context.input.motion, memory);
  const Approach now = calc_approach(context, region);
  const bool remembered = has_memory(memory);
  if (!is_lifted(memory)) {
    const double threshold = remembered ? memory.permanent_set : 0.0;
    const bool enters = now.rate > 0.0 && leaves_band(now.rate, now.acceleration);
    if (!enters && now.penetration <= threshold + 0.5 * touch_tolerance) {
      memory.release_penetration = std::max(now.penetration, threshold) + touch_tolerance;
      return;
    }
  }
  if (remembered) {
    // The same contact goes on: what it recorded at its first onset stays.
    memory.phase = law(region).dissipation.needs_largest_penetration() ? ContactPhase::restituting
                                                                       : ContactPhase::compressing;
    memory.release_penetration = 0.0;
  } else {
    begin(context, region, now);
  }
  record(context, "onset", region, now);
}

void ContactElement::begin(EventContext& context, int region, const Approach& now) const {
  ContactMemory& memory = *context.contact;
  memory = {};
  memory.phase = ContactPhase::compressing;
  memory.region = region;
  memory.onset_time = context.input.motion.t;
  memory.approach_velocity = std::max(now.rate, 0.0);
  memory.effective_mass = context.effective_mass(now.gradient.data());
  note_side_of_kink(memory, now);
  if (now.rate <= 0.0 && law(region).dissipation.needs_largest_penetration())
    end_compression(memory, now.penetration);
}

void ContactElement::note_side_of_kink(ContactMemory& memory, const Approach& now) const {
  const ContactLaw& here = law(memory.region);
  memory.past_kink = here.dissipation.has_kink() &&
                     here.dissipation.kink({now.penetration, now.rate, memory}, here.elastic) > 0.0;
}

void ContactElement::end_compression(ContactMemory& memory, double penetration) const {
  const ContactLaw& here = law(memory.region);
  memory.phase = ContactPhase::restituting;
  memory.largest_penetration = penetration;
  memory.permanent_set = here.dissipation.permanent_set(memory, here.elastic);
}

void ContactElement::handle_release(EventContext& context, bool lifted) const {
  ContactMemory& memory = *context.contact;
  const int region = memory.region;
  const Approach now = calc_approach(context, region);
  // Just after an onset the integrator's noise can take d below zero once more on its way in.
  if (!lifted && now.rate > 0.0 && leaves_band(now.rate, now.acceleration)) return;
  const double let_go = memory.permanent_set;
  memory.phase = ContactPhase::apart;
  if (lifted && now.penetration > let_go + 2.0 * touch_tolerance) {
    memory.release_penetration = now.penetration;
  } else {
    const bool leaves = now.rate < 0.0 && leaves_band(now.rate, now.acceleration);
    memory.release_penetration =
        leaves ? let_go : std::max(now.penetration, let_go) + touch_tolerance;
  }
  record(context, "release", region, now);
}

void ContactElement::handle_turn(EventContext& context) const {
  ContactMemory& memory = *context.contact;
  const Approach now = calc_approach(context, memory.region);
  end_compression(memory, now.penetration);
  record(context, "turn", memory.region, now);
}

void ContactElement::handle_reload(EventContext& context) const {
  ContactMemory& memory = *context.contact;
  const Approach now = calc_approach(context, memory.region);
  if (now.rate > 0.0 && leaves_band(now.rate, now.acceleration)) {
    memory.phase = ContactPhase::compressing;
    record(context, "reload", memory.region, now);
  } else {
    end_compression(memory, now.penetration);  // creeps past by the margin: the end moves along
  }
}

void ContactElement::handle_forget(EventContext& context) const {
  ContactMemory& memory = *context.contact;
  if (is_lifted(memory) && memory.permanent_set > 2.0 * touch_tolerance) {
    memory.release_penetration = memory.permanent_set;
    return;
  }
  const int region = memory.region;
  memory = {};
  memory.region = region;
  // A rest of rounding must not leave the onset on the wrong side of zero.
  const Approach now = calc_approach(context, region);
  if (!(now.rate < 0.0 && leaves_band(now.rate, now.acceleration)))
    memory.release_penetration = std::max(now.penetration, 0.0) + touch_tolerance;
}

void ContactElement::handle_region_end(EventContext& context) const {
  ContactMemory& memory = *context.contact;
  const double stored_before = calc_law(context.input, memory).stored_energy;
  memory.region = geometry_->successor(context.input.motion, memory.region);
  const Approach now = calc_approach(context, memory.region);
  record(context, "region", memory.region, now);
  note_side_of_kink(memory, now);
  if (memory.phase == ContactPhase::apart) return;

  // The law may be another one: bring the memory to what it expects.
  const DissipativeLaw& dissipation = law(memory.region).dissipation;
  if (!dissipation.needs_largest_penetration()) {
    memory.phase = ContactPhase::compressing;
    memory.largest_penetration = memory.permanent_set = 0.0;
  } else if (memory.phase == ContactPhase::restituting) {
    end_compression(memory, memory.largest_penetration);
  } else if (now.rate < 0.0) {
    end_compression(memory, now.penetration);
  }
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

// ---- results
// --------------------------------------------------------------------------------------

std::vector<Channel> ContactElement::channels() const {
  std::vector<std::string> labels{"apart"};
  labels.insert(labels.end(), region_names_.begin(), region_names_.end());
  return {{"penetration", "m"},           {"penetration_rate", "m/s"},
          {"normal_force", "N"},          {"region", "", std::move(labels)},
          {"contact_point_x", "m"},       {"contact_point_y", "m"},
          {"tangential_velocity", "m/s"}, {"wall_curvature", "1/m"}};
}

void ContactElement::calc_channels(const ForceInput& in, double* values) const {
  const ContactMemory& memory = *in.contact;
  const bool apart = memory.phase == ContactPhase::apart;
  const int region = watched_region(in.motion, memory);
  ContactKinematics k;
  geometry_->calc_kinematics(in.motion, region, false, k);
  const double d_rate = rate(k, in.motion);
  const ContactPlace place = geometry_->calc_place(in.motion, region);
  values[0] = k.penetration;
  values[1] = d_rate;
  values[2] = apart ? 0.0 : law(region).evaluate({k.penetration, d_rate, memory}).force;
  values[3] = apart ? 0.0 : 1.0 + region;
  values[4] = place.point.x();
  values[5] = place.point.y();
  values[6] = place.tangential_velocity;
  values[7] = place.wall_curvature;
}

}  // namespace yoke
