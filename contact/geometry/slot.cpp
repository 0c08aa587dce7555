// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/geometry/slot.hpp>

#include <string>

#include <yoke/core/error.hpp>

namespace yoke {

namespace {
/// "15.8 mm", with at least one decimal as on a drawing.
std::string millimetres(double length) {
  std::string text = fmt::format("{:.9g}", 1e3 * length);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text + " mm";
}
}  // namespace

std::string_view region_name(SlotRegion region) {
  switch (region) {
    case SlotRegion::inner:
      return "inner";
    case SlotRegion::outer:
      return "outer";
    case SlotRegion::cap_start:
    case SlotRegion::cap_end:
      break;
    case SlotRegion::left:
      return "left";
    case SlotRegion::right:
      return "right";
    case SlotRegion::edge:
      return "edge";
    case SlotRegion::corner:
      return "corner";
    case SlotRegion::start:
      return "start";
    case SlotRegion::end:
      return "end";
    case SlotRegion::wall:
      return "wall";
  }
  return "cap";
}

Slot::Slot(const Slot&) = default;
Slot::Slot(Slot&&) noexcept = default;
Slot& Slot::operator=(const Slot&) = default;
Slot& Slot::operator=(Slot&&) noexcept = default;
Slot::~Slot() = default;

void Slot::check_shape(std::string_view owner) const {
  require_finite(owner, "origin x", origin_.x());
  require_finite(owner, "origin y", origin_.y());
  require_finite(owner, "angle", angle_);
  profile_->check(owner);
}

void Slot::check(std::string_view owner, double pin_radius) const {
  check_shape(owner);
  require_positive(owner, "pin radius", pin_radius, "m");
  const std::string width = millimetres(2.0 * half_width()), pin = millimetres(2.0 * pin_radius);
  if (half_width() < pin_radius)
    throw ModelError(
        fmt::format("{}: width {} is smaller than the pin diameter {}", owner, width, pin));
  if (half_width() == pin_radius)
    throw ModelError(fmt::format("{}: width {} equals the pin diameter {}: there is no clearance",
                                 owner, width, pin));
}

}  // namespace yoke
