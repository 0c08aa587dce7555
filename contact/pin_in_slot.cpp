// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/pin_in_slot.hpp>

#include <cmath>
#include <utility>

#include <yoke/contact/contact_element.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

namespace {

class PinSlotGeometry final : public ContactGeometry {
 public:
  PinSlotGeometry(const Pin& pin, const SlotOn& slot, const Model& model)
      : a_(pin.body),
        b_(slot.body),
        pin_(model.to_local(pin.body, pin.at)),
        slot_(slot.slot),
        clearance_(slot.slot.half_width() - pin.radius),
        origin_(model.to_local(slot.body, slot.slot.origin())),
        x_axis_(model.direction_to_local(slot.body, rotate(slot.slot.angle(), {1.0, 0.0}))) {}

  std::vector<std::string> region_names() const override {
    std::vector<std::string> names;
    for (const SlotRegion region : slot_.regions()) names.emplace_back(region_name(region));
    return names;
  }

  int nearest(const Motion& motion) const override {
    return slot_.nearest(to_profile(motion, place(motion).w));
  }

  double penetration(const Motion& motion, int region) const override {
    return slot_.touch(region, to_profile(motion, place(motion).w)).distance - clearance_;
  }

  void calc_kinematics(const Motion& motion, int region, bool want_hessian,
                       ContactKinematics& out) const override {
    const auto [s, w] = place(motion);
    const Touch touch = slot_.touch(region, to_profile(motion, w));
    const Vec2 n = to_global(motion, touch.normal);
    out.penetration = touch.distance - clearance_;
    out.gradient = gradient(n, s, w);
    if (want_hessian) calc_hessian(touch.bend, n, s, w, out.hessian);
  }

  ContactPlace calc_place(const Motion& motion, int region) const override {
    const auto [s, w] = place(motion);
    const Touch touch = slot_.touch(region, to_profile(motion, w));
    const Vec2 n = to_global(motion, touch.normal);
    const BodyMotion &a = motion[a_], &b = motion[b_];
    const Vec2 to_wall = (slot_.half_width() - touch.distance) * n;  // from the pin's centre
    const Vec2 slip =
        (a.velocity() + a.omega * perp(s + to_wall)) - (b.velocity() + b.omega * perp(w + to_wall));
    return {a.position() + s + to_wall, perp(n).dot(slip), touch.wall_curvature};
  }

  double boundary(const Motion& motion, int region) const override {
    return slot_.boundary(region, to_profile(motion, place(motion).w));
  }

  int successor(const Motion& motion, int region) const override {
    return slot_.successor(region, to_profile(motion, place(motion).w));
  }

 private:
  struct Arms {
    Vec2 s, w;  // [m] from the centres of a and b to the pin's centre, global axes
  };

  Arms place(const Motion& motion) const {
    const BodyMotion &a = motion[a_], &b = motion[b_];
    const Vec2 s = a.to_global(pin_);
    return {s, a.position() - b.position() + s};  // in this order: exact far from the origin
  }

  Vec2 to_profile(const Motion& motion, const Vec2& w) const {
    const Vec2 p = motion[b_].to_local(w) - origin_;
    return {x_axis_.dot(p), cross(x_axis_, p)};
  }

  Vec2 to_global(const Motion& motion, const Vec2& direction) const {
    return motion[b_].to_global(direction.x() * x_axis_ + direction.y() * perp(x_axis_));
  }

  static std::array<double, 6> gradient(const Vec2& n, const Vec2& s, const Vec2& w) {
    return {n.x(), n.y(), n.dot(perp(s)), -n.x(), -n.y(), -n.dot(perp(w))};
  }

  static void calc_hessian(double bend, const Vec2& n, const Vec2& s, const Vec2& w,
                           std::array<double, 36>& H) {
    const std::array<double, 6> tau = gradient(perp(n), s, w);
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) H[6 * i + j] = bend * tau[i] * tau[j];
    const auto add = [&H](std::size_t i, std::size_t j, double value) {
      H[6 * i + j] += value;
      if (i != j) H[6 * j + i] += value;
    };
    add(2, 2, -n.dot(s));
    add(5, 5, -n.dot(w));
    add(2, 5, n.dot(s));
    const Vec2 turned = perp(n);
    for (std::size_t e = 0; e < 2; ++e) {
      const double value = turned[static_cast<Eigen::Index>(e)];
      add(e, 5, value);
      add(3 + e, 5, -value);
    }
  }

  BodyId a_, b_;
  Vec2 pin_;  // [m] in a's frame
  Slot slot_;
  double clearance_;  // [m] half-width minus pin radius
  Vec2 origin_;       // [m] the profile's origin and x axis, in b's frame
  Vec2 x_axis_;
};

}  // namespace

std::unique_ptr<ForceElement> PinInSlot::build(const Model& model) const {
  const std::string owner = fmt::format("slot '{}'", name);
  slot.slot.check(owner, pin.radius);
  require_finite(owner, "pin x", pin.at.x());
  require_finite(owner, "pin y", pin.at.y());
  std::vector<ContactLaw> laws;
  for (const SlotRegion region : slot.slot.regions())
    laws.push_back(region == SlotRegion::inner   ? law.inner
                   : region == SlotRegion::outer ? law.outer
                                                 : law.cap);
  return std::make_unique<ContactElement>(name, pin.body, slot.body,
                                          std::make_unique<PinSlotGeometry>(pin, slot, model),
                                          std::move(laws), reference_force);
}

}  // namespace yoke
