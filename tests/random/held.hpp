// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The statics of a mechanism: without drivers, loads and contacts, and with springs where a body
// could fall for ever. Its potential energy is then bounded below, so that it has an equilibrium.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include <yoke/tests/random/description.hpp>

namespace yoke::tests::random {

/// Bodies that can go only so far from each other: joined by a pin, a weld, a rod or a spring that
/// is not stretched to many times the size of the mechanism by its weight.
class HeldTogether {
 public:
  explicit HeldTogether(const Description& d) : group_(d.bodies.size() + 1) {
    for (const BodyData& b : d.bodies) stiff_ += 3.0 * b.mass;
    std::iota(group_.begin(), group_.end(), 0);
    for (const JointData& j : d.joints)
      if (j.kind == JointKind::revolute || j.kind == JointKind::weld ||
          j.kind == JointKind::distance)
        join(j.a, j.b);
    for (const ForceData& f : d.forces)
      if (f.kind == ForceKind::spring && f.stiffness > stiff_) join(f.a, f.b);
  }
  double stiff() const { return stiff_; }  // [N/m]
  bool by_the_ground(int body) const { return at(body) == at(0); }
  void join(int a, int b) {
    const int from = at(a), to = at(b);
    std::ranges::replace(group_, from, to);
  }

 private:
  int at(int body) const { return group_[static_cast<std::size_t>(body)]; }
  std::vector<int> group_;
  double stiff_ = 0.0;
};

inline Description make_held(Description d) {
  std::erase_if(d.joints, is_driver);
  for (JointData& j : d.joints) j.friction = 0.0;  // what holds may hold anywhere
  std::erase_if(d.forces, [](const ForceData& f) {
    return f.kind == ForceKind::load || f.kind == ForceKind::torque || f.kind == ForceKind::drag;
  });
  d.slots.clear();
  HeldTogether held(d);
  for (int body = 1; body <= static_cast<int>(d.bodies.size()); ++body) {
    if (held.by_the_ground(body)) continue;
    const BodyData& b = d.bodies[static_cast<std::size_t>(body) - 1];
    ForceData f;
    f.kind = ForceKind::spring;
    f.name = fmt::format("holds_{}", b.name);
    f.b = body;
    f.other = b.at + Vec2(0.2 * d.size, 0.0);
    f.at = f.other + Vec2(0.3 * d.size, 0.4 * d.size);
    f.stiffness = 10.0 * held.stiff();
    d.forces.push_back(f);
    held.join(body, 0);
  }
  return d;
}

}  // namespace yoke::tests::random
