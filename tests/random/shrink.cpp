// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/tests/random/shrink.hpp>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <yoke/tests/random/checks.hpp>

namespace yoke::tests::random {

namespace {

class Shrinker {
 public:
  Shrinker(Description d, std::function<bool(const Description&)> faulty)
      : d_(std::move(d)), faulty_(std::move(faulty)) {}

  Description smallest() {
    if (!faulty_(d_)) return d_;
    std::size_t before = 0;
    do {
      before = d_.parts();
      drop_bodies();
      drop(&Description::slots);
      drop(&Description::forces);
      drop(&Description::joints);
    } while (d_.parts() < before);
    make_plain();
    return d_;
  }

 private:
  bool keep(const Description& smaller) {
    if (smaller.bodies.empty() || !faulty_(smaller)) return false;
    d_ = smaller;
    return true;
  }

  void drop_bodies() {
    for (int body = static_cast<int>(d_.bodies.size()); body >= 1; --body)
      keep(without_body(d_, body));
  }

  template <class T>
  void drop(std::vector<T> Description::*list) {
    for (std::size_t i = (d_.*list).size(); i-- > 0;) {
      Description smaller = d_;
      (smaller.*list).erase((smaller.*list).begin() + static_cast<std::ptrdiff_t>(i));
      keep(smaller);
    }
  }

  void attempt(const std::function<void(Description&)>& change) {
    Description plainer = d_;
    change(plainer);
    keep(plainer);
  }

  /// Two digits, or none at all.
  static double rounded(double x) {
    if (x == 0.0 || !std::isfinite(x)) return x;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(x))) - 1.0);
    return std::round(x / unit) * unit;
  }
  static Vec2 rounded(const Vec2& p) { return {rounded(p.x()), rounded(p.y())}; }

  void make_plain() {
    for (std::size_t i = 0; i < d_.bodies.size(); ++i) {
      attempt([i](Description& d) { d.bodies[i].angle = 0.0; });
      attempt([i](Description& d) { d.bodies[i].velocity = {0.0, 0.0}; });
      attempt([i](Description& d) { d.bodies[i].omega = 0.0; });
      attempt([i](Description& d) { d.bodies[i].mass = rounded(d.bodies[i].mass); });
      attempt([i](Description& d) { d.bodies[i].inertia = rounded(d.bodies[i].inertia); });
      attempt([i](Description& d) { d.bodies[i].at = rounded(d.bodies[i].at); });
      attempt([i](Description& d) { d.bodies[i].velocity = rounded(d.bodies[i].velocity); });
      attempt([i](Description& d) { d.bodies[i].omega = rounded(d.bodies[i].omega); });
    }
    for (std::size_t i = 0; i < d_.joints.size(); ++i)
      attempt([i](Description& d) {
        JointData& j = d.joints[i];
        j.at = rounded(j.at);
        j.other = rounded(j.other);
        j.along = rounded(j.along);
        j.wave = {rounded(j.wave.rate), rounded(j.wave.amplitude), rounded(j.wave.frequency)};
      });
    for (std::size_t i = 0; i < d_.forces.size(); ++i) {
      attempt([i](Description& d) { d.forces[i].damping = 0.0; });
      attempt([i](Description& d) { d.forces[i].stretch = 0.0; });
      attempt([i](Description& d) {
        ForceData& f = d.forces[i];
        f.at = rounded(f.at);
        f.other = rounded(f.other);
        f.vector = rounded(f.vector);
        f.stiffness = rounded(f.stiffness);
        f.damping = rounded(f.damping);
        f.stretch = rounded(f.stretch);
        f.frequency = rounded(f.frequency);
        f.phase = rounded(f.phase);
      });
    }
    attempt([](Description& d) { d.duration = rounded(d.duration); });
  }

  Description d_;
  std::function<bool(const Description&)> faulty_;
};

}  // namespace

Description without_body(Description d, int body) {
  d.bodies.erase(d.bodies.begin() + body - 1);
  std::erase_if(d.joints, [&](const JointData& j) {
    return j.a == body || j.b == body || (j.kind == JointKind::gear && j.carrier == body);
  });
  std::erase_if(d.forces, [&](const ForceData& f) { return f.a == body || f.b == body; });
  std::erase_if(d.slots,
                [&](const SlotData& s) { return s.pin_body == body || s.slot_body == body; });
  const auto renumber = [&](int& other) {
    if (other > body) --other;
  };
  for (JointData& j : d.joints) {
    renumber(j.a);
    renumber(j.b);
    renumber(j.carrier);
  }
  for (ForceData& f : d.forces) {
    renumber(f.a);
    renumber(f.b);
  }
  for (SlotData& s : d.slots) {
    renumber(s.pin_body);
    renumber(s.slot_body);
  }
  return d;
}

Description shrink(Description d, const std::function<bool(const Description&)>& faulty) {
  return Shrinker(std::move(d), faulty).smallest();
}

Description shrink(Description d, const std::string& kind) {
  return shrink(std::move(d),
                [&](const Description& smaller) { return check(smaller, kind).has(kind); });
}

}  // namespace yoke::tests::random
