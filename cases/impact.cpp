// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/impact.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <yoke/contact/contact_element.hpp>
#include <yoke/core/model.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke::cases {

namespace {

constexpr double gap_share = 0.01;      // of the largest penetration: free flight before the touch
constexpr double patience = 1e4;        // durations of an elastic impact
constexpr double resolved_share = 0.1;  // a rebound may have a tenth of the speed
constexpr const char* contact = "contact";

/// Two flat faces across the x axis, at the centres of their bodies: d = x_a - x_b.
class FlatFaces final : public ContactGeometry {
 public:
  FlatFaces(BodyId a, BodyId b) : a_(a), b_(b) {}
  std::vector<std::string> region_names() const override { return {"face"}; }
  int nearest(const Motion&) const override { return 0; }
  double penetration(const Motion& motion, int) const override {
    return motion[a_].x - motion[b_].x;
  }
  void calc_kinematics(const Motion& motion, int region, bool want_hessian,
                       ContactKinematics& out) const override {
    out.penetration = penetration(motion, region);
    out.gradient = {1.0, 0.0, 0.0, -1.0, 0.0, 0.0};
    if (want_hessian) out.hessian = {};
  }
  ContactPlace calc_place(const Motion& motion, int) const override {
    return {{motion[b_].x, motion[b_].y}, motion[a_].vy - motion[b_].vy, 0.0};
  }

 private:
  BodyId a_, b_;
};

struct FacesContact {
  BodyId a, b;
  ContactLaw law;
  double reference_force;

  std::unique_ptr<ForceElement> build(const Model&) const {
    return std::make_unique<ContactElement>(contact, a, b, std::make_unique<FlatFaces>(a, b),
                                            std::vector<ContactLaw>{law}, reference_force);
  }
};

/// The largest values seen where they were located.
struct Extremes {
  double penetration = 0.0;
  double force = 0.0;
};

/// Watches a central impact between two bodies that nothing else acts on.
class Gauge final : public ForceElement {
 public:
  Gauge(BodyId a, BodyId b, const Impact& impact, std::shared_ptr<Extremes> extremes)
      : ForceElement("gauge", {a, b}, {.position = false, .velocity = false}),
        a_(a),
        b_(b),
        law_(impact.law),
        mass_(impact.mass),
        extremes_(std::move(extremes)) {
    memory_.phase = ContactPhase::compressing;
    memory_.approach_velocity = impact.speed;
    memory_.effective_mass = impact.mass;
  }

  void evaluate(const ForceInput&, const ForceRequest&) const override {}

  enum Event { deepest, strongest, event_count };
  int events() const override { return event_count; }
  void calc_events(const ForceInput& in, double* g) const override {
    const double d = in.motion[a_].x - in.motion[b_].x;
    const double rate = in.motion[a_].vx - in.motion[b_].vx;
    g[deepest] = -rate;
    g[strongest] = -1.0;
    // The law of unloading needs a memory that only the contact has; its force falls anyway.
    if (d <= 0.0 || (law_.dissipation.needs_largest_penetration() && rate <= 0.0)) return;
    const ContactOutput f = law_.evaluate({d, rate, memory_});
    g[strongest] = -(f.dforce_dpenetration * rate - f.dforce_drate * f.force / mass_);
  }
  void handle_event(int event, EventContext& context) const override {
    const Motion& motion = context.input.motion;
    const double d = motion[a_].x - motion[b_].x;
    const double rate = motion[a_].vx - motion[b_].vx;
    if (event == deepest) extremes_->penetration = std::max(extremes_->penetration, d);
    // At the end of compression `rate` is zero up to rounding: the law of compression still holds.
    note_force(d, rate);
  }
  void note_force(double d, double rate) const {
    if (d < 0.0) return;
    extremes_->force = std::max(extremes_->force, law_.evaluate({d, rate, memory_}).force);
  }

 private:
  BodyId a_, b_;
  ContactLaw law_;
  double mass_;
  ContactMemory memory_;
  std::shared_ptr<Extremes> extremes_;
};

struct GaugeDescription {
  BodyId a, b;
  const Impact& impact;
  std::shared_ptr<Extremes> extremes;

  std::unique_ptr<ForceElement> build(const Model&) const {
    return std::make_unique<Gauge>(a, b, impact, extremes);
  }
};

/// Largest penetration without dissipation: U(d) = m v^2/2. At most the limit of the law.
double elastic_penetration(const Impact& impact) {
  const ElasticLaw& law = impact.law.elastic;
  const double energy = 0.5 * impact.mass * impact.speed * impact.speed;
  const double limit = std::min(law.limit(), 1e3);
  if (!(law.response(limit).energy > energy)) return limit;
  double low = 0.0, high = std::min(limit, 1e-9);
  while (law.response(high).energy < energy) {
    low = high;
    high = std::min(2.0 * high, limit);
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (law.response(middle).energy < energy ? low : high) = middle;
  }
  return high;
}

void check(const Impact& impact) {
  require_positive("impact", "speed", impact.speed, "m/s");
  require_positive("impact", "mass", impact.mass, "kg");
  require_range("impact", "rtol", impact.relative_tolerance, 1e-13, 1e-2);
}

const EventRecord& find_event(const Result& run, const char* kind) {
  for (const EventRecord& event : run.events)
    if (event.kind == kind) return event;
  throw ModelError(fmt::format("impact: the contact has no {}: {}", kind, run.summary.reason));
}

}  // namespace

std::optional<double> power_of(const ElasticLaw& law) {
  if (std::isfinite(law.limit())) return std::nullopt;
  const auto exponent = [&](double d) {
    const ElasticResponse r = law.response(d);
    return d * r.stiffness / r.force;
  };
  const double n = exponent(1e-6);
  if (!(std::abs(exponent(1e-3) - n) < 1e-13 * n && std::abs(exponent(1e-9) - n) < 1e-13 * n))
    return std::nullopt;
  return std::round(n * 1e12) / 1e12;
}

ImpactOutcome simulate_impact(const Impact& impact) {
  check(impact);
  const double depth = elastic_penetration(impact);
  const double force = impact.law.elastic.response(depth).force;
  const bool wall = impact.setup == Impact::Setup::wall;
  const double gap = gap_share * depth;
  const double mass_a = wall ? impact.mass : 1.5 * impact.mass, mass_b = 3.0 * impact.mass;
  const double inertia = impact.mass * depth * depth;

  Model model;
  const BodyId a = model.add({.name = "a",
                              .mass = mass_a,
                              .inertia = inertia,
                              .pose = {{-gap, 0.0}, 0.0},
                              .twist = {{impact.speed, 0.0}, 0.0}});
  const BodyId b = wall ? ground : model.add({.name = "b", .mass = mass_b, .inertia = inertia});
  const auto extremes = std::make_shared<Extremes>();
  model.add(FacesContact{a, b, impact.law, force});
  model.add(GaugeDescription{a, b, impact, extremes});

  SimulationOptions options{
      .until = (gap + patience * depth) / impact.speed,
      .relative_tolerance = impact.relative_tolerance,
      .formulation = impact.formulation,
      .samples = 0,
      .length_scale = resolved_share * depth,
      .time_scale = depth / impact.speed,
  };
  const long events = impact.law.dissipation.needs_largest_penetration() ? 3 : 2;
  options.observer = [events](const Progress& now) { return now.events < events; };
  const Result run = simulate(model, options);
  if (run.summary.stop == Stop::failed)
    throw ModelError(fmt::format("impact: {}", run.summary.reason));
  if (run.summary.stop == Stop::completed)
    throw ModelError(
        fmt::format("impact: the surfaces have not parted within {:g} s", options.until));

  const EventRecord& onset = find_event(run, "onset");
  const EventRecord& release = find_event(run, "release");
  ImpactOutcome outcome;
  outcome.restitution = -release.speed / impact.speed;
  outcome.duration = release.t - onset.t;
  outcome.permanent_set = run.final.contacts.front().permanent_set;
  outcome.steps = run.summary.steps;

  ContactMemory memory;  // as the contact had it at the touch
  memory.phase = ContactPhase::compressing;
  memory.approach_velocity = impact.speed;
  memory.effective_mass = impact.mass;
  const auto force_at = [&](const EventRecord& e) {
    return impact.law.evaluate({e.penetration, e.speed, memory}).force;
  };
  outcome.max_penetration = extremes->penetration;
  outcome.max_force = std::max(extremes->force, force_at(onset));
  if (events == 3) {
    const EventRecord& turn = find_event(run, "turn");
    outcome.max_penetration = std::max(outcome.max_penetration, turn.penetration);
    outcome.max_force = std::max(outcome.max_force, force_at(turn));
  }

  // A contact let go before the penetration is zero: the surface relaxes, and what it still stored
  // is dissipated.
  State last = run.final;
  if (release.penetration > outcome.permanent_set + 2.0 * touch_tolerance) {
    SimulationOptions rest = options;
    rest.observer = nullptr;
    rest.until = last.t + 2.0 * release.penetration / -release.speed;
    last = simulate(model, last, rest).final;
  }
  outcome.dissipated = last.energy.sum();
  const auto kinetic = [&](const Eigen::VectorXd& v) {
    return 0.5 * mass_a * v[0] * v[0] + (wall ? 0.0 : 0.5 * mass_b * v[3] * v[3]);
  };
  const Eigen::VectorXd start = model.start_state().v;
  outcome.kinetic_loss = kinetic(start) - kinetic(last.v);
  if (!wall)
    outcome.momentum_error =
        std::abs(mass_a * last.v[0] + mass_b * last.v[3] - mass_a * impact.speed) /
        (mass_a * impact.speed);

  if (impact.samples >= 2) {
    SimulationOptions sampled = options;
    sampled.observer = nullptr;
    sampled.until = release.t;
    sampled.samples = impact.samples;
    const Result loop = simulate(model, sampled);
    const Eigen::VectorXd t = loop["t_s"], d = loop["contact.penetration_m"],
                          rate = loop["contact.penetration_rate_m_per_s"],
                          f = loop["contact.normal_force_N"];
    for (Eigen::Index i = 0; i < t.size(); ++i) outcome.loop.push_back({t[i], d[i], rate[i], f[i]});
  }
  return outcome;
}

}  // namespace yoke::cases
