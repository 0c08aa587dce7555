// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/pin_in_slot.hpp>

#include <utility>

#include <yoke/contact/contact_element.hpp>
#include <yoke/contact/details/disc_geometry.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

namespace {

WallLaw law_for(const SlotLaws& laws, SlotRegion region) {
  if (laws.each) return *laws.each;
  switch (region) {
    case SlotRegion::inner:
    case SlotRegion::left:
      return *laws.inner;
    case SlotRegion::outer:
    case SlotRegion::right:
      return *laws.outer;
    default:
      return *laws.cap;
  }
}

/// A pin may start within a wall, but not behind it.
void require_inside(const std::string& owner, const Pin& pin, const Slot& slot) {
  const Vec2 p = rotate(-slot.angle(), pin.at - slot.origin());
  const Touch touch = slot.touch(slot.nearest(p), p);
  const double beyond = touch.distance - slot.half_width();
  if (beyond > pin.radius)
    throw ModelError(fmt::format(
        "{}: the pin's centre ({:g}, {:g}) m is {:g} m behind the wall '{}' in the start pose; it "
        "must be in the slot",
        owner, pin.at.x(), pin.at.y(), beyond,
        region_name(slot.regions()[static_cast<std::size_t>(touch.region)])));
}

std::unique_ptr<ForceElement> contact_with(const PinInSlot& p, const std::string& name,
                                           const Slot& slot, const Model& model) {
  const std::string owner = fmt::format("slot '{}'", name);
  slot.check(owner, p.pin.radius);
  require_finite(owner, "pin x", p.pin.at.x());
  require_finite(owner, "pin y", p.pin.at.y());
  require_inside(owner, p.pin, slot);
  return std::make_unique<ContactElement>(
      name, p.pin.body, p.slot.body,
      std::make_unique<DiscGeometry>(model, p.pin.body, p.pin.at, p.pin.radius, p.slot.body, slot),
      laws_along(owner, slot, p.pin.radius, p.reference_force,
                 [&](SlotRegion region) { return law_for(p.law, region); }),
      p.reference_force);
}

}  // namespace

std::unique_ptr<ForceElement> PinInSlot::build(const Model& model) const {
  return contact_with(*this, name, slot.slot, model);
}

Elements PinInSlot::elements(const Model& model) const {
  Elements made;
  made.forces.push_back(build(model));
  for (const Slot& other : slot.slot.others())
    made.forces.push_back(contact_with(
        *this, fmt::format("{} {}", name, region_name(other.regions().front())), other, model));
  return made;
}

}  // namespace yoke
