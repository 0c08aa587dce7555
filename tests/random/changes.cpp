// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/tests/random/changes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include <yoke/tests/random/numbers.hpp>

namespace yoke::tests::random {

namespace {

/// Every point, direction and angle of a description: p -> rotate(angle, mirror p) + offset.
class Mover {
 public:
  explicit Mover(Changed& c) : c_(c) {}

  void move() {
    for (BodyData& b : c_.d.bodies) {
      point(b.at);
      vector(b.velocity);
      b.angle = c_.angle + handed(b.angle);
      b.omega = handed(b.omega);
    }
    for (JointData& j : c_.d.joints) {
      point(j.at);
      point(j.other);
      vector(j.along);
      if (j.kind == JointKind::angle_driver) {
        j.wave.rate = handed(j.wave.rate);
        j.wave.amplitude = handed(j.wave.amplitude);
      }
    }
    for (ForceData& f : c_.d.forces) {
      point(f.at);
      point(f.other);
      if (f.kind == ForceKind::load && f.body_frame)
        f.vector = flipped(f.vector);  // in axes that turn along
      else
        vector(f.vector);
      f.magnitude = handed(f.magnitude);
      if (f.kind == ForceKind::torsion) f.stretch = handed(f.stretch);
    }
    for (SlotData& s : c_.d.slots) {
      point(s.pin);
      point(s.center);
      s.direction = c_.angle + handed(s.direction);
    }
  }

 private:
  double handed(double a) const { return c_.mirrored ? -a : a; }
  Vec2 flipped(const Vec2& v) const { return c_.mirrored ? Vec2(v.x(), -v.y()) : v; }
  void vector(Vec2& v) const { v = rotate(c_.angle, flipped(v)); }
  void point(Vec2& p) const {
    vector(p);
    p += c_.offset;
  }

  Changed& c_;
};

template <class T>
void shuffle(std::vector<T>& list, Random& r) {
  for (std::size_t i = list.size(); i > 1; --i)
    std::swap(list[i - 1], list[static_cast<std::size_t>(r.below(static_cast<int>(i)))]);
}

void reorder(Description& d, Random& r) {
  std::vector<int> order(d.bodies.size());
  std::iota(order.begin(), order.end(), 1);
  shuffle(order, r);
  std::vector<int> place(d.bodies.size() + 1, 0);  // new index of an old one
  std::vector<BodyData> bodies;
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[static_cast<std::size_t>(order[i])] = static_cast<int>(i) + 1;
    bodies.push_back(d.bodies[static_cast<std::size_t>(order[i]) - 1]);
  }
  d.bodies = bodies;
  const auto renumber = [&](int& body) { body = place[static_cast<std::size_t>(body)]; };
  for (JointData& j : d.joints) {
    renumber(j.a);
    renumber(j.b);
    renumber(j.carrier);
    const bool either = j.kind == JointKind::revolute || j.kind == JointKind::weld ||
                        j.kind == JointKind::distance || j.kind == JointKind::prismatic;
    if (either && r.chance(0.5)) {
      std::swap(j.a, j.b);
      if (j.kind == JointKind::distance) std::swap(j.at, j.other);
    }
  }
  for (ForceData& f : d.forces) {
    renumber(f.a);
    renumber(f.b);
  }
  for (SlotData& s : d.slots) {
    renumber(s.pin_body);
    renumber(s.slot_body);
  }
  shuffle(d.joints, r);
  shuffle(d.forces, r);
  shuffle(d.slots, r);
}

void add_bystanders(Description& d, Random& r) {
  constexpr int count = 20;
  const std::size_t own = d.bodies.size();
  for (int i = 0; i < count; ++i) {
    // Where the others are and as fast, so that length and time scales change little.
    const BodyData& like = d.bodies[static_cast<std::size_t>(r.below(static_cast<int>(own)))];
    if (like.mass == 0.0 || like.inertia == 0.0) continue;
    BodyData b = like;
    b.name = fmt::format("bystander{}", i);
    b.at += 0.1 * d.size * r.in_circle();
    b.velocity = 0.1 * d.size * r.in_circle();
    b.omega = 0.0;
    d.bodies.push_back(b);
  }
}

}  // namespace

const std::vector<Change>& all_changes() {
  static const std::vector<Change> all = {Change::turn,    Change::shift, Change::mirror,
                                          Change::reorder, Change::units, Change::bystanders};
  return all;
}

std::string name_of(Change change) {
  static const std::array<const char*, 6> names = {"turn",    "shift", "mirror",
                                                   "reorder", "units", "bystanders"};
  return names.at(static_cast<std::size_t>(change));
}

Changed changed(const Description& d, Change change) {
  Changed c{.d = d};
  c.original = std::make_shared<const Description>(d);
  Random r(d.seed * 8 + static_cast<std::uint64_t>(change) + 1000);
  switch (change) {
    case Change::turn:
      c.angle = r.between(-3.0, 3.0);
      Mover(c).move();
      break;
    case Change::shift:
      c.offset = 100.0 * d.size * r.direction();
      Mover(c).move();
      break;
    case Change::mirror:
      c.mirrored = true;
      Mover(c).move();
      break;
    case Change::reorder:
      reorder(c.d, r);
      break;
    case Change::units:
      c.d.units.length = r.decades(-3, 6);
      c.d.units.mass = r.decades(-3, 6);
      c.d.units.time = r.decades(-3, 6);
      break;
    case Change::bystanders:
      add_bystanders(c.d, r);
      break;
  }
  return c;
}

}  // namespace yoke::tests::random
