// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/impact.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <yoke/cases/choices/quantity.hpp>
#include <yoke/contact/contact_element.hpp>
#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/model.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

constexpr double gap_share = 0.01;      // of the largest penetration: free flight before the touch
constexpr double patience = 1e4;        // durations of an elastic impact
constexpr double resolved_share = 0.1;  // a rebound may have a tenth of the speed
constexpr double least_share =
    1e-7;  // of the largest penetration: a surface that has still to relax
constexpr const char* contact = "contact";

/// A point of body a on a face across the x axis, at x = `face` of body b, which does not turn:
///   d = x_a + (arm of the point).x - x_b - face
class PointOnFace final : public ContactGeometry {
 public:
  PointOnFace(BodyId a, BodyId b, const Vec2& point, double face)
      : a_(a), b_(b), point_(point), face_(face) {}
  std::vector<std::string> region_names() const override { return {"face"}; }
  int nearest(const Motion&) const override { return 0; }
  double penetration(const Motion& motion, int) const override {
    return motion[a_].x - motion[b_].x + motion[a_].to_global(point_).x() - face_;
  }
  void calc_kinematics(const Motion& motion, int region, bool want_hessian,
                       ContactKinematics& out) const override {
    const Vec2 arm = motion[a_].to_global(point_);
    out.penetration = penetration(motion, region);
    out.gradient = {1.0, 0.0, -arm.y(), -1.0, 0.0, 0.0};
    if (!want_hessian) return;
    out.hessian = {};
    out.hessian[2 * 6 + 2] = -arm.x();
  }
  ContactPlace calc_place(const Motion& motion, int) const override {
    const Vec2 slip = motion[a_].point_velocity(point_) - motion[b_].velocity();
    return {motion[a_].point(point_), slip.y(), 0.0};
  }
  double rate(const Motion& motion) const {
    return motion[a_].vx - motion[b_].vx - motion[a_].omega * motion[a_].to_global(point_).y();
  }

 private:
  BodyId a_, b_;
  Vec2 point_;   // [m] in a's frame
  double face_;  // [m]
};

struct FaceContact {
  BodyId a, b;
  PointOnFace geometry;
  ContactLaw law;
  double reference_force;

  std::unique_ptr<ForceElement> build(const Model&) const {
    return std::make_unique<ContactElement>(contact, a, b, std::make_unique<PointOnFace>(geometry),
                                            std::vector<ContactLaw>{law}, reference_force);
  }
};

/// The largest values seen where they were located.
struct Extremes {
  double penetration = 0.0;
  double force = 0.0;
};

/// Watches a central impact that nothing else acts on.
class Gauge final : public ForceElement {
 public:
  Gauge(BodyId a, BodyId b, const PointOnFace& geometry, const CentralImpact& impact,
        std::shared_ptr<Extremes> extremes)
      : ForceElement("gauge", {a, b}, {.position = false, .velocity = false}),
        geometry_(geometry),
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
    const double d = geometry_.penetration(in.motion, 0);
    const double rate = geometry_.rate(in.motion);
    g[deepest] = -rate;
    g[strongest] = -1.0;
    // The law of unloading needs a memory that only the contact has; its force falls anyway.
    if (d <= 0.0 || d > law_.penetration_limit() ||
        (law_.dissipation.needs_largest_penetration() && rate <= 0.0))
      return;
    const ContactOutput f = law_.evaluate({d, rate, memory_});
    g[strongest] = -(f.dforce_dpenetration * rate - f.dforce_drate * f.force / mass_);
  }
  void handle_event(int event, EventContext& context) const override {
    const double d = geometry_.penetration(context.input.motion, 0);
    const double rate = geometry_.rate(context.input.motion);
    if (event == deepest) extremes_->penetration = std::max(extremes_->penetration, d);
    // At the end of compression `rate` is zero up to rounding: the law of compression still holds.
    note_force(d, rate);
  }
  void note_force(double d, double rate) const {
    if (d < 0.0 || d > law_.penetration_limit()) return;
    extremes_->force = std::max(extremes_->force, law_.evaluate({d, rate, memory_}).force);
  }

 private:
  PointOnFace geometry_;
  ContactLaw law_;
  double mass_;
  ContactMemory memory_;
  std::shared_ptr<Extremes> extremes_;
};

struct GaugeDescription {
  BodyId a, b;
  PointOnFace geometry;
  const CentralImpact& impact;
  std::shared_ptr<Extremes> extremes;

  std::unique_ptr<ForceElement> build(const Model&) const {
    return std::make_unique<Gauge>(a, b, geometry, impact, extremes);
  }
};

constexpr double least_depth = 1e-9;            // [m] the distance of a few atoms
constexpr double greatest_depth = 1e3;          // [m]
constexpr double speed_of_light = 299792458.0;  // [m/s]

/// Largest penetration without dissipation: U(d) = m v^2/2. At most the limit of the law.
double elastic_penetration(const CentralImpact& impact) {
  const ElasticLaw& law = impact.law.elastic;
  const double energy = 0.5 * impact.mass * impact.speed * impact.speed;
  const double limit = std::min(law.limit(), greatest_depth);
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

void check(const CentralImpact& impact) {
  require_positive("impact", "speed", impact.speed, "m/s");
  require_range("impact", "speed", impact.speed, 0.0, speed_of_light, "m/s");
  require_positive("impact", "mass", impact.mass, "kg");
  require_range("impact", "rtol", impact.relative_tolerance, 1e-13, 1e-2);
}

/// Refuses a depth that the engine does not resolve or the law does not mean.
void check_depth(const CentralImpact& impact, double depth) {
  const bool shallow = depth < least_depth;
  if (!shallow && depth < greatest_depth) return;
  throw ModelError(fmt::format(
      "impact: speed = {:g} m/s with mass = {:g} kg would press {} {:.4g} m into the elastic law; "
      "accepted is a depth of {:g} to {:g} m: choose a {} speed or mass",
      impact.speed, impact.mass, shallow ? "only" : "at least", depth, least_depth, greatest_depth,
      shallow ? "greater" : "smaller"));
}

const EventRecord& find_event(const Result& run, const char* kind) {
  for (const EventRecord& event : run.events)
    if (event.kind == kind) return event;
  throw ModelError(fmt::format("impact: the contact has no {}: {}", kind, run.summary.reason));
}

/// The bodies of an impact, just before they touch.
struct Scene {
  Model model;
  std::vector<Body> bodies{};
  bool free = false;  // nothing is fixed: the momentum stays
  std::shared_ptr<Extremes> extremes = std::make_shared<Extremes>();

  BodyId add(const Body& body) {
    bodies.push_back(body);
    return model.add(body);
  }
  void watch(BodyId a, BodyId b, const PointOnFace& geometry, const CentralImpact& impact) {
    model.add(GaugeDescription{a, b, geometry, impact, extremes});
  }
  double kinetic(const Eigen::VectorXd& v) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(3 * i);
      sum += 0.5 * bodies[i].mass * (v[at] * v[at] + v[at + 1] * v[at + 1]) +
             0.5 * bodies[i].inertia * v[at + 2] * v[at + 2];
    }
    return sum;
  }
  double momentum(const Eigen::VectorXd& v) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      sum += bodies[i].mass * v[static_cast<Eigen::Index>(3 * i)];
    return sum;
  }
};

/// What the scale of an impact is, from its elastic law.
struct Scale {
  double depth, force, gap;  // [m, N, m]
};

void build_faces(Scene& scene, const CentralImpact& impact, const Scale& scale) {
  const bool wall = impact.setup == CentralImpact::Setup::wall;
  scene.free = !wall;
  const double inertia = impact.mass * scale.depth * scale.depth;
  const BodyId a = scene.add({.name = "a",
                              .mass = wall ? impact.mass : 1.5 * impact.mass,
                              .inertia = inertia,
                              .pose = {{-scale.gap, 0.0}, 0.0},
                              .twist = {{impact.speed, 0.0}, 0.0}});
  const BodyId b =
      wall ? ground : scene.add({.name = "b", .mass = 3.0 * impact.mass, .inertia = inertia});
  const PointOnFace geometry(a, b, {0.0, 0.0}, 0.0);
  scene.model.add(FaceContact{a, b, geometry, impact.law, scale.force});
  scene.watch(a, b, geometry, impact);
}

void build_slot(Scene& scene, const CentralImpact& impact, const Scale& scale) {
  constexpr double radius = 60e-3, pin_radius = 8e-3;  // [m]
  scene.free = true;
  const double clearance = 4.0 * scale.depth;  // the other wall is out of reach
  const Vec2 start{radius + clearance - scale.gap, 0.0};
  const BodyId pin = scene.add({.name = "pin",
                                .mass = 1.5 * impact.mass,
                                .inertia = 0.75 * impact.mass * pin_radius * pin_radius,
                                .pose = {start, 0.0},
                                .twist = {{impact.speed, 0.0}, 0.0}});
  const BodyId slotted = scene.add({.name = "slotted",
                                    .mass = 3.0 * impact.mass,
                                    .inertia = 3.0 * impact.mass * radius * radius});
  const Slot slot =
      arc_slot({.radius = radius, .angle = 1.0, .half_width = pin_radius + clearance});
  scene.model.add(PinInSlot{.name = contact,
                            .pin = {pin, start, pin_radius},
                            .slot = {slotted, slot},
                            .law = impact.law,
                            .reference_force = scale.force});
  scene.watch(pin, slotted, PointOnFace(pin, slotted, {0.0, 0.0}, radius + clearance), impact);
}

void build_pendulum(Scene& scene, const CentralImpact& impact, const Scale& scale) {
  constexpr double penetrations_per_arm = 1.25e5;
  const double arm = penetrations_per_arm * scale.depth, center = 0.6 * arm;  // [m] from the pivot
  const double mass = 1.5 * impact.mass;
  const double inertia = impact.mass * arm * arm - mass * center * center;
  const double angle = -std::asin(scale.gap / arm);  // hangs along -y when it touches
  const double omega = impact.speed / arm;
  const Vec2 down{std::sin(angle), -std::cos(angle)};
  const Vec2 along{-down.y(), down.x()};
  const BodyId swing = scene.add({.name = "pendulum",
                                  .mass = mass,
                                  .inertia = inertia,
                                  .pose = {center * down, angle},
                                  .twist = {omega * center * along, omega}});
  scene.model.add(Revolute{.name = "pivot", .a = ground, .b = swing, .at = {0.0, 0.0}});
  const PointOnFace geometry(swing, ground, {0.0, center - arm}, 0.0);
  scene.model.add(FaceContact{swing, ground, geometry, impact.law, scale.force});
  scene.watch(swing, ground, geometry, impact);
}

void build(Scene& scene, const CentralImpact& impact, const Scale& scale) {
  switch (impact.setup) {
    case CentralImpact::Setup::two_bodies:
    case CentralImpact::Setup::wall:
      return build_faces(scene, impact, scale);
    case CentralImpact::Setup::slot:
      return build_slot(scene, impact, scale);
    case CentralImpact::Setup::pendulum:
      return build_pendulum(scene, impact, scale);
  }
}

}  // namespace

std::string loop_csv(const std::vector<LoopPoint>& loop) {
  std::string text = "t_s,penetration_m,rate_m_per_s,force_N\n";
  for (const LoopPoint& p : loop) {
    if (p.force == 0.0 && p.penetration < 0.0) continue;  // before the touch
    text += fmt::format("{},{},{},{}\n", exactly(p.t), exactly(p.penetration), exactly(p.rate),
                        exactly(p.force));
  }
  text.pop_back();  // write_text ends the last line
  return text;
}

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

std::string name_of(CentralImpact::Setup setup) {
  switch (setup) {
    case CentralImpact::Setup::two_bodies:
      return "bodies";
    case CentralImpact::Setup::wall:
      return "wall";
    case CentralImpact::Setup::slot:
      return "slot";
    case CentralImpact::Setup::pendulum:
      break;
  }
  return "pendulum";
}

CentralImpact::Setup setup_named(std::string_view name) {
  std::vector<std::string> known;
  for (const CentralImpact::Setup setup : all_setups) {
    known.push_back(name_of(setup));
    if (known.back() == name) return setup;
  }
  throw ModelError(fmt::format("setup '{}'{}", name, suggestion(std::string(name), known)));
}

ImpactOutcome simulate_impact(const CentralImpact& impact) {
  check(impact);
  const double depth = elastic_penetration(impact);
  check_depth(impact, depth);
  const Scale scale{depth, impact.law.elastic.response(depth).force, gap_share * depth};
  Scene scene;
  build(scene, impact, scale);
  const Model& model = scene.model;
  const Extremes& extremes = *scene.extremes;

  SimulationOptions options{
      .until = (scale.gap + patience * depth) / impact.speed,
      .relative_tolerance = impact.relative_tolerance,
      .formulation = impact.formulation,
      .samples = 0,
      .length_scale = resolved_share * depth,
      .time_scale = depth / impact.speed,
      .order = impact.order,
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
  outcome.max_penetration = extremes.penetration;
  outcome.max_force = std::max(extremes.force, force_at(onset));
  if (events == 3) {
    const EventRecord& turn = find_event(run, "turn");
    outcome.max_penetration = std::max(outcome.max_penetration, turn.penetration);
    outcome.max_force = std::max(outcome.max_force, force_at(turn));
  }

  // A contact let go before the penetration is zero: the surface relaxes, and what it still stored
  // is dissipated. The law may press once more on the way.
  State last = run.final;
  if (release.penetration > outcome.permanent_set + least_share * depth) {
    SimulationOptions rest = options;
    rest.observer = nullptr;
    rest.until = last.t + 2.0 * release.penetration / -release.speed;
    const Result relaxing = simulate(model, last, rest);
    if (!relaxing.summary.ok())
      throw ModelError(fmt::format("impact: {}", relaxing.summary.reason));
    last = relaxing.final;
    for (const EventRecord& event : relaxing.events) {
      if (event.kind != "release") continue;
      outcome.restitution = -event.speed / impact.speed;
      outcome.duration = event.t - onset.t;
    }
  }
  outcome.dissipated = last.energy.sum();
  const Eigen::VectorXd start = model.start_state().v;
  outcome.kinetic_loss = scene.kinetic(start) - scene.kinetic(last.v);
  if (scene.free)
    outcome.momentum_error = std::abs(scene.momentum(last.v) / scene.momentum(start) - 1.0);

  if (impact.samples >= 2) {
    SimulationOptions sampled = options;
    sampled.observer = nullptr;
    sampled.until = onset.t + outcome.duration;
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
