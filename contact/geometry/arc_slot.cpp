// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/geometry/arc_slot.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/core/error.hpp>

namespace yoke {

namespace {

constexpr int inner = static_cast<int>(SlotRegion::inner);
constexpr int outer = static_cast<int>(SlotRegion::outer);
constexpr int cap_start = static_cast<int>(SlotRegion::cap_start);
constexpr int cap_end = static_cast<int>(SlotRegion::cap_end);

class ArcProfile {
 public:
  ArcProfile(double radius, double angle, double half_width)
      : radius_(radius),
        half_angle_(0.5 * angle),
        half_width_(half_width),
        start_(std::cos(half_angle_), -std::sin(half_angle_)),
        end_(std::cos(half_angle_), std::sin(half_angle_)) {}

  double half_width() const { return half_width_; }

  std::vector<SlotRegion> regions() const {
    return {SlotRegion::inner, SlotRegion::outer, SlotRegion::cap_start, SlotRegion::cap_end};
  }

  std::vector<CurvatureRange> curvatures() const {
    const double in = 1.0 / (radius_ - half_width_), out = -1.0 / (radius_ + half_width_),
                 cap = -1.0 / half_width_;
    return {{in, in, in}, {out, out, out}, {cap, cap, cap}, {cap, cap, cap}};
  }

  std::vector<WallLine> outline() const {
    WallLine line{.closed = true};
    const auto add = [&line](const Vec2& center, double radius, double from, double to) {
      const int parts = std::max(24, static_cast<int>(100.0 * std::abs(to - from)));
      for (int i = 0; i <= parts; ++i) {
        const double a = from + (to - from) * i / parts;
        line.points.push_back(center + radius * Vec2(std::cos(a), std::sin(a)));
      }
    };
    const Vec2 origin(0.0, 0.0);
    add(origin, radius_ + half_width_, -half_angle_, half_angle_);
    add(radius_ * end_, half_width_, half_angle_, half_angle_ + pi);
    add(origin, radius_ - half_width_, half_angle_, -half_angle_);
    add(radius_ * start_, half_width_, pi - half_angle_, 2.0 * pi - half_angle_);
    return {line};
  }

  Touch touch(int region, const Vec2& p) const {
    if (region == cap_start) return touch_cap(cap_start, p - radius_ * start_, -perp(start_));
    if (region == cap_end) return touch_cap(cap_end, p - radius_ * end_, perp(end_));
    const double rho = p.norm();
    const Vec2 radial = rho > 0.0 ? Vec2(p / rho) : Vec2(1.0, 0.0);
    const double bend = rho > 0.0 ? 1.0 / rho : 0.0;
    if (region == inner)
      return {inner, radius_ - rho, -radial, -bend, 1.0 / (radius_ - half_width_)};
    return {outer, rho - radius_, radial, bend, -1.0 / (radius_ + half_width_)};
  }

  int nearest(const Vec2& p) const {
    const double phi = std::atan2(p.y(), p.x());
    if (std::abs(phi) > half_angle_) return phi > 0.0 ? cap_end : cap_start;
    return side(p);
  }

  double boundary(int region, const Vec2& p) const {
    if (region == cap_start) return cross(start_, p);
    if (region == cap_end) return -cross(end_, p);
    return radius_ * (std::abs(std::atan2(p.y(), p.x())) - half_angle_);
  }

  int successor(int region, const Vec2& p) const {
    if (region == cap_start || region == cap_end) return side(p);
    return p.y() > 0.0 ? cap_end : cap_start;
  }

  void check(std::string_view owner) const {
    require_positive(owner, "half_width", half_width_, "m");
    if (!(std::isfinite(radius_) && radius_ > half_width_))
      throw ModelError(fmt::format("{}: radius = {:g} m must be greater than half_width = {:g} m",
                                   owner, radius_, half_width_));
    if (!(half_angle_ > 0.0 && half_angle_ < pi))
      throw ModelError(fmt::format("{}: angle = {:g} rad must be between 0 and 2 pi rad", owner,
                                   2.0 * half_angle_));
    if (half_angle_ > 0.5 * pi && !(radius_ * std::sin(half_angle_) > half_width_))
      throw ModelError(
          fmt::format("{}: angle = {:g} rad lets the two end caps overlap; at most "
                      "{:g} rad",
                      owner, 2.0 * half_angle_, 2.0 * (pi - std::asin(half_width_ / radius_))));
  }

 private:
  int side(const Vec2& p) const { return p.norm() >= radius_ ? outer : inner; }

  /// `from_end` is p - e. A pin exactly at e has no normal; it is nowhere near the wall, and
  /// `along`, the direction in which the slot ends, serves.
  Touch touch_cap(int region, const Vec2& from_end, const Vec2& along) const {
    const double distance = from_end.norm();
    if (distance == 0.0) return {region, 0.0, along, 0.0, -1.0 / half_width_};
    return {region, distance, from_end / distance, 1.0 / distance, -1.0 / half_width_};
  }

  double radius_, half_angle_, half_width_;
  Vec2 start_, end_;  // unit vectors from the centre to the ends of the centreline
};

}  // namespace

Slot arc_slot(const ArcSlot& arc) {
  return Slot(ArcProfile(arc.radius, arc.angle, arc.half_width), arc.center, arc.direction);
}

}  // namespace yoke
