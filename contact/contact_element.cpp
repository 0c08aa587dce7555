// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/contact_element.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <yoke/contact/details/contact_state.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

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

/// The same of a law that follows the curvature.
struct ContinuedFollowing {
  ElasticLaw law;
  double from = continued_from * law.limit();

  GradedResponse operator()(double d, double curvature) const {
    if (d <= from) return law.response(d, curvature);
    GradedResponse r = law.response(from, curvature);
    const double x = d - from;
    r.here.energy += x * (r.here.force + 0.5 * r.here.stiffness * x);
    r.here.force += r.here.stiffness * x;
    r.energy_slope += x * r.force_slope;
    return r;
  }
  ElasticResponse operator()(double d) const { return Continued{law}(d); }
  std::string name() const { return law.name(); }
};

}  // namespace

ContactElement::ContactElement(std::string name, BodyId a, BodyId b,
                               std::unique_ptr<const ContactGeometry> geometry,
                               std::vector<ContactLaw> laws, double reference_force)
    : ForceElement(std::move(name), {a, b}),
      a_(a),
      b_(b),
      geometry_(std::move(geometry)),
      laws_(std::move(laws)),
      region_names_(geometry_->region_names()),
      reference_force_(reference_force) {
  const std::string owner = fmt::format("contact '{}'", this->name());
  require_positive(owner, "reference_force", reference_force, "N");
  if (laws_.size() != region_names_.size())
    throw ModelError(fmt::format("{}: {} laws are given for {} regions", owner, laws_.size(),
                                 region_names_.size()));
  for (const ContactLaw& each : laws_) {
    has_friction_ = has_friction_ || !each.friction.none();
    has_bristles_ = has_bristles_ || each.friction.has_state();
    may_hold_ = may_hold_ || each.friction.holds();
  }
  if (has_friction_ && !geometry_->knows_slip())
    throw ModelError(fmt::format(
        "{}: there is no friction on this geometry: it does not say how the surfaces slide "
        "(ContactGeometry::calc_slip)",
        owner));
  find_parameters(owner);
  penetration_scale_ = std::numeric_limits<double>::infinity();
  for (ContactLaw& each : laws_) {
    penetration_scale_ = std::min(penetration_scale_, each.elastic.penetration_at(reference_force));
    limits_.push_back(each.penetration_limit());
    if (!std::isfinite(limits_.back())) continue;
    if (each.elastic.follows_curvature())
      each.elastic = ContinuedFollowing{each.elastic};
    else
      each.elastic = Continued{each.elastic};
  }
}

/// Regions with the same law share its parameters.
void ContactElement::find_parameters(const std::string& owner) {
  int count = 0;
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    const auto same = std::ranges::find_if(
        laws_, [&](const ContactLaw& earlier) { return earlier.is_same(laws_[i]); });
    const auto first = static_cast<std::size_t>(same - laws_.begin());
    const std::size_t own = laws_[i].parameters().size();
    if (first < i || own == 0) {
      first_parameter_.push_back(first < i ? first_parameter_[first] : -1);
      continue;
    }
    if (laws_[i].elastic.fields() > 0 && std::isfinite(laws_[i].penetration_limit()))
      throw ModelError(
          fmt::format("{}: the law '{}' ends at {:g} m; its stiffness cannot be changeable", owner,
                      laws_[i].name(), laws_[i].penetration_limit()));
    first_parameter_.push_back(count);
    count += static_cast<int>(own);
  }
}

std::vector<Parameter> ContactElement::parameters() const {
  std::vector<Parameter> all;
  const int last = *std::ranges::max_element(first_parameter_);
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    if (first_parameter_[i] != static_cast<int>(all.size())) continue;
    for (Parameter p : laws_[i].parameters()) {
      if (last > 0) p.name = region_names_[i] + "." + p.name;
      all.push_back(std::move(p));
    }
  }
  return all;
}

void ContactElement::check_parameters(const double* values) const {
  for (std::size_t i = 0; i < laws_.size(); ++i)
    if (first_parameter_[i] >= 0) laws_[i].check(values + first_parameter_[i]);
}

double touch_tolerance(double length, double penetration, double rounding) {
  const double size = std::min(length, penetration);  // a soft law may not reach its reference
  return std::max(std::sqrt(std::numeric_limits<double>::epsilon() * length * size), rounding);
}

double ContactElement::touch(const ForceInput& in) const {
  return touch_tolerance(in.scales.length, penetration_scale_, in.rounding);
}

// The two kinds of "apart" with a memory; margins keep a put-off onset from being taken for them.

bool ContactElement::remembers(const ForceInput& in, const ContactMemory& memory) const {
  return memory.release_penetration > 2.0 * touch(in) && !behind(memory);
}

bool ContactElement::behind(const ContactMemory& memory) {
  return memory.phase == ContactPhase::apart && memory.release_penetration == behind_the_wall;
}

bool ContactElement::lifted(const ForceInput& in, const ContactMemory& memory) const {
  return memory.phase == ContactPhase::apart &&
         memory.release_penetration > memory.permanent_set + 2.0 * touch(in) && !behind(memory);
}

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
  const BoundLaw now = law(memory.region, in);
  const LocalLaw here(*now, k.curvature);
  return here.evaluate({k.penetration, rate(k, in.motion), memory});
}

void ContactElement::evaluate(const ForceInput& in, const ForceRequest& out) const {
  const ContactMemory& memory = *in.contact;
  if (out.energy != nullptr) *out.energy = {};
  const bool apart = memory.phase == ContactPhase::apart;
  if (apart && !lifted(in, memory)) return;
  Pressure pressure;
  if (law(memory.region).elastic.follows_curvature())
    evaluate_following(in, out, pressure);
  else
    evaluate_normal(in, out, pressure);
  if (slides(memory)) add_friction(in, out, pressure);
}

void ContactElement::evaluate_normal(const ForceInput& in, const ForceRequest& out,
                                     Pressure& pressure) const {
  const ContactMemory& memory = *in.contact;
  const bool apart = memory.phase == ContactPhase::apart;
  const bool want_jacobian = !apart && wants_jacobian(out);
  ContactKinematics k;
  geometry_->calc_kinematics(in.motion, memory.region, want_jacobian, k);
  const ContactRow& g = k.gradient;
  const ContactRow v = velocity(in.motion);
  const double d_rate = dot(g, v);
  const ContactOutput f = law(memory.region, in)->evaluate({k.penetration, d_rate, memory});

  if (out.energy != nullptr) {
    out.energy->stored = f.stored_energy;
    // Lifted: no force, so what the surface loses while it relaxes is dissipated, D = -dS/dt.
    out.energy->dissipated_power = f.dissipated_power - (apart ? f.force * d_rate : 0.0);
  }
  if (apart) return;
  pressure.force = f.force;
  if (out.Q != nullptr)
    for (std::size_t i = 0; i < columns; ++i) out.Q[i] = -f.force * g[i];
  if (!want_jacobian) return;
  const ContactRow Hv = times(k.hessian, v);
  for (std::size_t j = 0; j < columns; ++j) {
    pressure.by_q[j] = f.dforce_dpenetration * g[j] + f.dforce_drate * Hv[j];
    pressure.by_v[j] = f.dforce_drate * g[j];
  }
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      const std::size_t entry = i * columns + j;
      if (out.dQ_dq != nullptr)
        out.dQ_dq[entry] = -g[i] * pressure.by_q[j] - f.force * k.hessian[entry];
      if (out.dQ_dv != nullptr) out.dQ_dv[entry] = -g[i] * pressure.by_v[j];
    }
  }
}

void ContactElement::evaluate_following(const ForceInput& in, const ForceRequest& out,
                                        Pressure& pressure) const {
  const ContactMemory& memory = *in.contact;
  const bool apart = memory.phase == ContactPhase::apart;
  const bool want_jacobian = !apart && wants_jacobian(out);
  ContactKinematics k;
  CurvatureKinematics c;
  geometry_->calc_kinematics(in.motion, memory.region, want_jacobian, k, c);
  const BoundLaw now = law(memory.region, in);
  const LocalLaw here(*now, k.curvature);
  const ContactRow& g = k.gradient;
  const ContactRow v = velocity(in.motion);
  const double d_rate = dot(g, v);
  const ContactInput input{k.penetration, d_rate, memory};
  const ContactOutput f = here.evaluate(input);
  const GradedResponse e = here.graded(k.penetration);

  if (out.energy != nullptr) {
    out.energy->stored = f.stored_energy;
    const double released = f.force * d_rate + e.energy_slope * dot(c.gradient, v);
    out.energy->dissipated_power = f.dissipated_power - (apart ? released : 0.0);
  }
  if (apart) return;
  pressure.force = f.force;
  if (out.Q != nullptr)
    for (std::size_t i = 0; i < columns; ++i)
      out.Q[i] = -f.force * g[i] - e.energy_slope * c.gradient[i];
  if (!want_jacobian) return;
  const ContactRow Hv = times(k.hessian, v);
  const double force_slope = here.force_slope(input);
  for (std::size_t j = 0; j < columns; ++j) {
    pressure.by_q[j] =
        f.dforce_dpenetration * g[j] + f.dforce_drate * Hv[j] + force_slope * c.gradient[j];
    pressure.by_v[j] = f.dforce_drate * g[j];
  }
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      const std::size_t entry = i * columns + j;
      if (out.dQ_dq != nullptr)
        out.dQ_dq[entry] = -g[i] * pressure.by_q[j] - f.force * k.hessian[entry] -
                           c.gradient[i] * (e.force_slope * g[j] + e.energy_bend * c.gradient[j]) -
                           e.energy_slope * c.hessian[entry];
      if (out.dQ_dv != nullptr) out.dQ_dv[entry] = -g[i] * pressure.by_v[j];
    }
  }
}

std::vector<Channel> ContactElement::channels() const {
  std::vector<std::string> labels{"apart"};
  labels.insert(labels.end(), region_names_.begin(), region_names_.end());
  std::vector<Channel> all = {{"penetration", "m"},           {"penetration_rate", "m/s"},
                              {"normal_force", "N"},          {"region", "", std::move(labels)},
                              {"contact_point_x", "m"},       {"contact_point_y", "m"},
                              {"tangential_velocity", "m/s"}, {"wall_curvature", "1/m"}};
  if (has_friction_) all.push_back({"friction_force", "N"});
  return all;
}

void ContactElement::calc_channels(const ForceInput& in, double* values) const {
  const ContactMemory& memory = *in.contact;
  const bool apart = memory.phase == ContactPhase::apart;
  const int region = watched_region(in, memory);
  ContactKinematics k;
  geometry_->calc_kinematics(in.motion, region, false, k);
  const double d_rate = rate(k, in.motion);
  const ContactPlace place = geometry_->calc_place(in.motion, region);
  values[0] = k.penetration;
  values[1] = d_rate;
  const BoundLaw now = law(region, in);
  const LocalLaw here(*now, k.curvature);
  values[2] = apart ? 0.0 : here.evaluate({k.penetration, d_rate, memory}).force;
  values[3] = apart ? 0.0 : 1.0 + region;
  values[4] = place.point.x();
  values[5] = place.point.y();
  values[6] = place.tangential_velocity;
  values[7] = place.wall_curvature;
  if (!has_friction_) return;
  const double held = in.hold != nullptr ? *in.hold : 0.0;
  values[8] = slides(memory) ? calc_friction(in, values[2], place.tangential_velocity).force : held;
}

}  // namespace yoke
