// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/tests/random/generator.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <yoke/core/error.hpp>
#include <yoke/tests/random/build.hpp>
#include <yoke/tests/random/numbers.hpp>

namespace yoke::tests::random {

namespace {

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : r_(seed) {
    d_.seed = seed;
    d_.family = families()[seed % families().size()];
  }

  Description description() {
    const bool slots = d_.family == "slot";
    d_.size = r_.decades(-2, 2) * 0.5;
    const bool loops = d_.family == "loop" || d_.family == "overclosed";
    d_.duration = slots ? r_.between(0.1, 0.3) : r_.between(0.5, loops ? 2.5 : 1.2);
    if (d_.family == "change-point") {
      parallelograms();
    } else {
      bodies(slots);
      tree();
      if (d_.family == "loop" || d_.family == "overclosed") close(r_.among(1, 3), false);
      if ((d_.family == "driven" || slots) && r_.chance(0.5)) close(r_.among(1, 2), false);
      if (d_.family == "overclosed") close(r_.among(1, 3), true);
    }
    gravity();
    springs();
    if (d_.family == "driven" || (slots && r_.chance(0.3))) drivers();
    if (d_.family != "change-point") loads();
    if (slots)
      for (int n = r_.among(1, 2); n > 0; --n) slot();
    // Where a change point lets reactions grow without bound, pins with friction wedge.
    if (d_.seed >= second_series && d_.family != "change-point") {
      if (d_.family != "tree") light_rods();
      friction();
    }
    return std::move(d_);
  }

 private:
  // ---- bodies

  BodyData body(const Vec2& at, int decades) {
    BodyData b;
    b.name = fmt::format("body{}", d_.bodies.size() + 1);
    b.mass = r_.decades(-(decades / 2), std::max(1, decades));
    const double gyration = d_.size * r_.between(0.1, 0.5);
    b.inertia = b.mass * gyration * gyration;
    b.at = at;
    b.angle = r_.between(-3.0, 3.0);
    b.velocity = d_.size * r_.in_circle();
    b.omega = r_.between(-3.0, 3.0);
    return b;
  }

  void bodies(bool slots) {
    const int most = r_.chance(0.5) ? 4 : 10;  // small ones are worth more: they are understood
    const int count = r_.among(slots ? 1 : d_.family == "tree" ? 1 : 2, most);
    // With slots rarely all six decades: a light pin on a heavy contact is all vibration.
    const int decades = slots && r_.chance(0.8) ? r_.among(1, 2) : r_.among(1, 6);
    // One heavy body that drives light ones through their dead centres.
    const int heavy = decades > 2 && r_.chance(0.4) ? r_.below(count) : -1;
    for (int i = 0; i < count; ++i) {
      parent_.push_back(i == 0 || r_.chance(0.3) ? 0 : r_.among(std::max(0, i - 2), i));
      const Vec2 direction = r_.direction();
      d_.bodies.push_back(body(place(parent_.back()) + d_.size * r_.between(0.5, 1.2) * direction,
                               heavy < 0 ? decades : 1));
      if (i == heavy) make_heavy(d_.bodies.back(), decades);
    }
  }

  static void make_heavy(BodyData& b, int decades) {
    for (int k = 0; k < decades; ++k) {
      b.mass *= 10.0;
      b.inertia *= 10.0;
    }
  }

  Vec2 place(int body) const { return body == 0 ? Vec2(0.0, 0.0) : of(body).at; }
  const BodyData& of(int body) const { return d_.bodies[static_cast<std::size_t>(body) - 1]; }
  int count() const { return static_cast<int>(d_.bodies.size()); }
  double mass(int body) const {
    return body == 0 ? std::numeric_limits<double>::infinity() : of(body).mass;
  }
  double inertia(int body) const {
    return body == 0 ? std::numeric_limits<double>::infinity() : of(body).inertia;
  }
  /// A point of a body, as far from its centre as neighbours are at most.
  Vec2 point_of(int body) { return place(body) + 0.6 * d_.size * r_.in_circle(); }
  Vec2 between(int a, int b) {
    const double share = r_.between(0.1, 0.9);
    return (1.0 - share) * place(a) + share * place(b) + 0.3 * d_.size * r_.in_circle();
  }

  // ---- joints

  std::string next(const char* kind) { return fmt::format("{}{}", kind, ++names_); }

  JointData joint(JointKind kind, int a, int b) {
    static const char* const names[] = {"pin",  "guide", "weld",  "rod",
                                        "line", "gear",  "motor", "actuator"};
    JointData j;
    j.kind = kind;
    j.name = next(names[static_cast<std::size_t>(kind)]);
    j.a = a;
    j.b = b;
    j.at = between(a, b);
    j.along = r_.direction();
    j.other = j.at + d_.size * j.along;
    if (kind == JointKind::distance) {
      do {
        j.at = point_of(a);
        j.other = point_of(b);
      } while ((j.other - j.at).norm() < 0.2 * d_.size);
    }
    if (kind == JointKind::point_on_line)
      j.other = j.at + d_.size * r_.between(-1.0, 1.0) * j.along;
    return j;
  }

  void tree() {
    for (int b = 1; b <= count(); ++b) {
      const int a = parent_[static_cast<std::size_t>(b) - 1];
      const double draw = r_.unit();
      if (draw < 0.55)
        d_.joints.push_back(joint(JointKind::revolute, a, b));
      else if (draw < 0.68)
        d_.joints.push_back(joint(JointKind::prismatic, a, b));
      else if (draw < 0.73)
        d_.joints.push_back(joint(JointKind::weld, a, b));
      else if (draw < 0.83)
        d_.joints.push_back(joint(JointKind::distance, a, b));
      else if (draw < 0.92)
        d_.joints.push_back(joint(JointKind::point_on_line, b, a));
      else
        spring(a, b);
    }
  }

  int rank() const {
    const Model model = build(d_);
    const State start = model.start_state();
    return random::rank(relative_singular_values(model, start.q, 0.0, d_.size));
  }

  /// Keeps a joint if it closes a loop as wanted: independent of the others and without locking the
  /// mechanism, or whatever it does to it.
  bool keep(const JointData& j, bool any) {
    const int before = rank();
    const Model old = build(d_);
    int rows = 0;
    d_.joints.push_back(j);
    const Model model = build(d_);
    rows = model.constraints().back()->rows();
    const int now = rank();
    const int freedoms = 3 * count() - now;
    if (any || (now == before + rows && freedoms >= (is_driver(j) ? 0 : 1))) return true;
    d_.joints.pop_back();
    return false;
  }

  std::optional<std::pair<int, int>> pair() {
    for (int tries = 0; tries < 20; ++tries) {
      const int a = r_.among(0, count()), b = r_.among(1, count());
      if (a != b) return std::pair(a, b);
    }
    return std::nullopt;
  }

  void close(int joints, bool any) {
    for (int tries = 0; tries < 10 && joints > 0; ++tries) {
      const auto bodies = pair();
      if (!bodies) return;
      const auto& [a, b] = *bodies;
      const double draw = r_.unit();
      JointData j;
      if (draw < 0.35) {
        j = joint(JointKind::revolute, a, b);
      } else if (draw < 0.62) {
        j = joint(JointKind::distance, a, b);
      } else if (draw < 0.8) {
        j = joint(JointKind::point_on_line, b, a);
      } else if (draw < 0.9) {
        j = joint(JointKind::prismatic, a, b);
      } else {
        j = joint(JointKind::gear, a, b);
        j.carrier = r_.among(0, count());
        j.ratio = r_.sign() * r_.between(0.5, 2.0);
        if (j.carrier == a || j.carrier == b) continue;
      }
      if (keep(j, any)) --joints;
    }
  }

  /// Rods on two pins in place of a constraint of their length: without mass, or without inertia of
  /// their own.
  void light_rods() {
    for (int n = r_.among(0, 2); n > 0; --n) {
      const auto bodies = pair();
      if (!bodies) return;
      const JointData length = joint(JointKind::distance, bodies->first, bodies->second);
      if (!keep(length, false)) continue;
      d_.joints.pop_back();
      BodyData rod = body(0.5 * (length.at + length.other), 1);
      if (r_.chance(0.7)) rod.mass = 0.0;
      rod.inertia = 0.0;
      d_.bodies.push_back(rod);
      for (const auto& [to, at] :
           {std::pair(length.a, length.at), std::pair(length.b, length.other)}) {
        JointData pin = joint(JointKind::revolute, to, count());
        pin.at = at;
        d_.joints.push_back(pin);
      }
    }
  }

  void friction() {
    for (JointData& j : d_.joints) {
      if (j.kind != JointKind::revolute || !r_.chance(0.25)) continue;
      j.friction = r_.between(0.02, 0.4);
      j.radius = d_.size * r_.between(0.01, 0.1);
      if (r_.chance(0.5)) j.threshold = d_.size * r_.between(0.003, 0.03);
    }
  }

  void drivers() {
    int wanted = r_.among(1, 2);
    for (int tries = 0; tries < 10 && wanted > 0; ++tries) {
      const auto bodies = pair();
      if (!bodies) return;
      const auto& [a, b] = *bodies;
      const bool turns = r_.chance(0.6);
      JointData j = joint(turns ? JointKind::angle_driver : JointKind::displacement_driver, a, b);
      j.at = point_of(b);
      const double unit = turns ? 1.0 : d_.size;
      if (r_.chance(0.4)) {
        j.wave.rate = unit * r_.sign() * r_.between(0.2, turns ? 3.0 : 0.4);
      } else {
        j.wave.amplitude = unit * r_.sign() * r_.between(0.05, 0.3);
        j.wave.frequency = r_.between(1.0, 8.0);
      }
      if (keep(j, false)) --wanted;
    }
  }

  /// Cranks of equal length, parallel, with couplers between their tips: they pass through the line
  /// of their pivots, where the constraints are dependent.
  void parallelograms() {
    const int loops = r_.among(1, 3);
    const int decades = r_.among(1, 4);
    const Vec2 base = r_.direction();
    const Vec2 crank = d_.size * unit_vector(r_.between(0.3, 1.2));
    const Vec2 turned = {base.x() * crank.x() - base.y() * crank.y(),
                         base.y() * crank.x() + base.x() * crank.y()};
    const double rate = -r_.between(1.5, 4.0);  // towards the line
    d_.duration = r_.between(0.5, 1.0);
    Vec2 foot(0.0, 0.0);
    for (int i = 0; i <= loops; ++i) {
      const Vec2 tip = foot + turned;
      BodyData b = body(0.5 * (foot + tip), decades);
      b.omega = rate;
      b.velocity = 0.5 * rate * perp(turned);
      d_.bodies.push_back(b);
      JointData pivot = joint(JointKind::revolute, 0, count());
      pivot.at = foot;
      d_.joints.push_back(pivot);
      if (i > 0) {
        const Vec2 last = previous_ + turned;
        BodyData coupler = body(0.5 * (last + tip), decades);
        coupler.omega = 0.0;
        coupler.velocity = rate * perp(turned);
        d_.bodies.push_back(coupler);
        JointData left = joint(JointKind::revolute, previous_crank_, count());
        left.at = last;
        JointData right = joint(JointKind::revolute, count(), count() - 1);
        right.at = tip;
        d_.joints.push_back(left);
        d_.joints.push_back(right);
        previous_crank_ = count() - 1;
      } else {
        previous_crank_ = count();
      }
      previous_ = foot;
      foot += d_.size * r_.between(0.6, 1.6) * base;
    }
  }

  // ---- forces

  void gravity() {
    if (!r_.chance(0.6)) return;
    ForceData f;
    f.kind = ForceKind::gravity;
    f.name = "gravity";
    const double size = d_.size * r_.between(0.5, 6.0);
    f.vector = size * r_.direction();
    d_.forces.push_back(f);
  }

  /// A spring between any two bodies of about the frequency the lighter would have on it alone.
  void spring(int a, int b) {
    ForceData f;
    f.a = a;
    f.b = b;
    const bool torsion = r_.chance(0.3);
    f.kind = torsion ? ForceKind::torsion : ForceKind::spring;
    f.name = next(torsion ? "coil" : "spring");
    const double omega = r_.chance(0.1) ? r_.between(20.0, 60.0) : r_.between(0.5, 8.0);
    const double load = torsion ? std::min(inertia(a), inertia(b)) : std::min(mass(a), mass(b));
    f.stiffness = load * omega * omega;
    if (r_.chance(0.4)) f.damping = 2.0 * r_.between(0.0, 0.5) * load * omega;
    if (torsion) {
      f.stretch = r_.between(-1.0, 1.0);
    } else {
      do {
        f.at = point_of(a);
        f.other = point_of(b);
      } while ((f.other - f.at).norm() < 0.3 * d_.size);
      f.stretch = (f.other - f.at).norm() * r_.between(-0.3, 0.6);
    }
    d_.forces.push_back(f);
  }

  void springs() {
    for (int n = r_.among(0, 3); n > 0; --n)
      if (const auto bodies = pair()) spring(bodies->first, bodies->second);
  }

  void loads() {
    for (int n = r_.chance(0.4) ? r_.among(1, 2) : 0; n > 0; --n) {
      ForceData f;
      f.b = r_.among(1, count());
      f.at = point_of(f.b);
      f.frequency = r_.between(0.0, 6.0);
      f.phase = r_.between(0.0, 3.0);
      const double draw = r_.unit();
      const double rate = r_.between(0.5, 4.0);
      if (draw < 0.45) {
        f.kind = ForceKind::load;
        f.name = next("load");
        f.vector = of(f.b).mass * d_.size * rate * r_.direction();
        f.body_frame = r_.chance(0.5);
      } else if (draw < 0.75) {
        f.kind = ForceKind::torque;
        f.name = next("torque");
        f.magnitude = of(f.b).inertia * rate * r_.sign();
      } else {
        f.kind = ForceKind::drag;
        f.name = next("drag");
        f.damping = of(f.b).mass * rate * 0.3;
      }
      d_.forces.push_back(f);
    }
  }

  // ---- contacts

  /// About all the energy a contact can meet [J].
  double energy() const {
    double sum = 0.0;
    for (const BodyData& b : d_.bodies) {
      sum += 0.5 * (b.mass * b.velocity.squaredNorm() + b.inertia * b.omega * b.omega);
      for (const ForceData& f : d_.forces)
        if (f.kind == ForceKind::gravity) sum += b.mass * f.vector.norm() * 0.2 * d_.size;
    }
    for (const ForceData& f : d_.forces) sum += 0.5 * f.stiffness * f.stretch * f.stretch;
    return sum;
  }

  /// A pin within the clearance of a slot.
  SlotData placed_slot(double& clearance) {
    SlotData s;
    const auto bodies = pair();
    s.pin_body = bodies ? bodies->second : 1;
    s.slot_body = bodies ? bodies->first : 0;
    if (s.slot_body != 0 && r_.chance(0.3)) std::swap(s.pin_body, s.slot_body);
    s.arc_radius = d_.size * r_.between(0.3, 1.5);
    s.half_width = d_.size * r_.between(0.02, 0.06);
    clearance = s.half_width * (r_.chance(0.5) ? 0.1 : 0.01) * r_.between(1.0, 5.0);
    s.radius = s.half_width - clearance;
    s.angle = r_.between(0.6, 3.5);
    s.direction = r_.between(-3.0, 3.0);
    s.pin = between(s.slot_body, s.pin_body);
    const double along = s.direction + 0.35 * s.angle * r_.between(-1.0, 1.0);
    const double across = s.arc_radius + clearance * r_.between(-0.8, 0.8);
    s.center = s.pin - across * unit_vector(along);
    return s;
  }

  /// True if the pin can move across the slot: laws with an effective mass need it.
  bool gives_way(const SlotData& s) {
    JointData across;
    across.kind = JointKind::displacement_driver;
    across.name = "across";
    across.a = s.slot_body;
    across.b = s.pin_body;
    across.at = s.pin;
    across.along = s.pin - s.center;
    const int before = rank();
    d_.joints.push_back(across);
    const int after = rank();
    d_.joints.pop_back();
    return after > before;
  }

  void slot() {
    double clearance = 0.0;
    SlotData s = placed_slot(clearance);
    for (int tries = 0; tries < 10 && !gives_way(s); ++tries) s = placed_slot(clearance);
    if (!gives_way(s)) return;
    s.name = next("slot");
    const int laws = r_.chance(0.7) ? 1 : 3;
    double lightest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < laws; ++k) {
      s.laws.push_back(law(s, clearance, k == 0 && laws == 3));
      const ContactLaw made = make_law(s.laws.back());
      const double deep = std::min(0.3 * clearance, 0.5 * made.penetration_limit());
      lightest = std::min(lightest, made.elastic.response(deep).force);
    }
    s.reference_force = 0.01 * lightest;
    d_.slots.push_back(s);
  }

  /// A pair of laws of the catalogue, stiff enough to take up the energy of the whole mechanism.
  LawData law(const SlotData& s, double clearance, bool inner) {
    for (;;) {
      LawData law;
      const DissipativeNote& damping = dissipative_catalog()[static_cast<std::size_t>(
          r_.below(static_cast<int>(dissipative_catalog().size())))];
      law.dissipative = damping.name;
      law.damping.restitution = r_.between(0.4, 0.99);
      law.damping.slowest_approach = d_.size * 1e-3 * r_.between(1.0, 10.0);
      law.damping.q = r_.between(2.0, 4.0);
      law.damping.tensile = r_.chance(0.5) ? TensilePhase::keep : TensilePhase::clamp;
      if (damping.name == "herbert-mcwhannell") law.damping.empirical = r_.chance(0.3);
      const ElasticNote& elastic = elastic_catalog()[static_cast<std::size_t>(
          r_.below(static_cast<int>(elastic_catalog().size())))];
      law.elastic = damping.linear_only ? "power" : elastic.name;
      law.n = damping.linear_only ? 1.0 : r_.between(1.0, 1.6);
      ElasticArguments& a = law.arguments;
      a.conformity = inner ? Conformity::external : Conformity::internal;
      a.pin_radius = s.radius;
      a.wall_radius = inner ? s.arc_radius - s.half_width : s.half_width;
      a.length = s.radius * r_.between(0.5, 2.0);
      a.reading = elastic.readings[static_cast<std::size_t>(
          r_.below(static_cast<int>(elastic.readings.size())))];
      const double stiffer = r_.between(1.0, 10.0);
      a.pin = a.wall = Material{1e9, 0.3, "scaled"};
      law.K = 1e9;
      try {
        const ContactLaw trial = make_law(law);
        const double deep = std::min(0.3 * clearance, 0.5 * trial.penetration_limit());
        const double factor = stiffer * energy() / trial.elastic.response(deep).energy;
        a.pin.E = a.wall.E = 1e9 * factor;
        law.K = 1e9 * factor;
        const ContactLaw made = make_law(law);
        const double taken =
            made.elastic.response(std::min(deep, 0.5 * made.penetration_limit())).energy;
        if (std::isfinite(taken) && taken > 0.5 * energy()) return law;
      } catch (const ModelError&) {  // not of these radii, or not with this restitution
      }
    }
  }

  Random r_;
  Description d_;
  std::vector<int> parent_;
  int names_ = 0;
  Vec2 previous_{0.0, 0.0};
  int previous_crank_ = 0;
};

}  // namespace

const std::vector<std::string>& families() {
  static const std::vector<std::string> all = {"tree", "loop",        "overclosed", "driven",
                                               "slot", "loop",        "loop",       "slot",
                                               "tree", "change-point"};
  return all;
}

Description generate(std::uint64_t seed) { return Generator(seed).description(); }

}  // namespace yoke::tests::random
