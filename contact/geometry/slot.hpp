// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The shape of a slot: a centreline, a half-width and two end caps. A pin of radius r_p whose
// centre p is at distance D from the centreline penetrates the wall by
//   d = D - (h - r_p),   h half-width [m].
// A new shape is one new file with a profile (see SlotProfile). A wall is a profile too, with h = 0.
// Circular slots: arc_slot.hpp; slots along any curve: curve_slot.hpp.
#pragma once

#include <concepts>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <yoke/core/types.hpp>

namespace yoke {

/// What a disc can touch. `inner` is the wall on the side of the centre of curvature; `left` and
/// `right` are seen along the centreline; `edge` is a convex edge, as at an open end; `corner` the
/// round outside of a corner of the centreline; `start` and `end` flat
/// ends; `wall` anything but a slot.
enum class SlotRegion {
  inner,      ///< wall on the side of the centre of curvature
  outer,      ///< the other wall
  cap_start,  ///< round end where the centreline begins
  cap_end,    ///< round end where it ends
  left,       ///< wall, seen along the centreline
  right,      ///< the other wall
  edge,       ///< convex, as at an open end
  corner,     ///< round outside of a corner of the centreline
  start,      ///< flat end where the centreline begins
  end,        ///< flat end where it ends
  wall        ///< of anything but a slot
};

/// As written to results: its name; "cap" for both caps.
std::string_view region_name(SlotRegion region);

/// Where the pin's centre is relative to one region.
struct Touch {
  int region = 0;         // its number in the profile
  double distance = 0.0;  // [m] D, from the centreline (a cap: from its centre) towards the wall
  Vec2 normal{1.0, 0.0};  // unit gradient of D: towards the wall, the direction of penetration
  double bend = 0.0;      // [1/m] Hessian of D = bend * t t^T, t = perp(normal)
  /// [1/m] of the wall, > 0 convex as the pin sees it (contact from outside), < 0 concave (a bore).
  double wall_curvature = 0.0;
  double u = 0.0;  // where on the wall, as curvature_field() of the same profile understands it
};

/// [1/m] Least, greatest and mean curvature of a wall, sign as in Touch.
struct CurvatureRange {
  double low = 0.0, high = 0.0, mean = 0.0;  // least, greatest, mean
};

/// The curvature of the wall touched as a function of where p is, with n = Touch::normal and
/// t = perp(n): gradient along t, Hessian tt t t^T + tn (t n^T + n t^T). Zero on lines and arcs.
struct CurvatureField {
  double along = 0.0;         // [1/m^2]
  double tt = 0.0, tn = 0.0;  // [1/m^3]
};

/// A wall as it is drawn, its material on the right of the points.
struct WallLine {
  std::vector<Vec2> points{};  // [m] in the frame of the profile
  bool closed = false;         // the last point is joined to the first
  bool endless = false;        // the straight line through the two points
};

/// A shape in its own frame. It has numbered regions, each with a formula that is smooth and
/// can be evaluated beyond the region's own range: steps look ahead. Where two regions meet, D and
/// its gradient agree. Optional, for laws that take the curvature of the wall:
///   std::vector<CurvatureRange> curvatures() const           one for each region
///   CurvatureField curvature_field(const Touch&) const       where it changes along a region
///   bool follows(int region) const                           whether that is known; default: yes
/// Optional, to be drawn: std::vector<WallLine> outline() const.
template <class P>
concept SlotProfile = requires(const P& profile, const Vec2& p, int region,
                               std::string_view owner) {
  { profile.half_width() } -> std::convertible_to<double>;
  /// What each region is, by its number.
  { profile.regions() } -> std::convertible_to<std::vector<SlotRegion>>;
  { profile.touch(region, p) } -> std::convertible_to<Touch>;
  /// The region whose wall is nearest to p.
  { profile.nearest(p) } -> std::convertible_to<int>;
  /// [m] where the region ends: < 0 inside, > 0 beyond, about the distance along the slot.
  { profile.boundary(region, p) } -> std::convertible_to<double>;
  /// The region on the other side of the boundary nearest to p.
  { profile.successor(region, p) } -> std::convertible_to<int>;
  /// Throws ModelError, whose message begins with the owner, if a dimension is wrong.
  {profile.check(owner)};
};

/// A profile put somewhere: its origin at `origin`, its x axis turned by `angle`, in global axes of
/// the start pose. A value; copies share one immutable profile.
class Slot {
 public:
  /// `origin` [m] and `angle` [rad] of the profile's frame, global in the start pose.
  template <SlotProfile P>
  Slot(P profile, const Vec2& origin, double angle)
      : profile_(std::make_shared<const Holder<P>>(std::move(profile))),
        origin_(origin),
        angle_(angle) {}

  // Not inline: GCC 12 would warn of an uninitialised pointer where a user writes a slot into a
  // braced description and a later member of it may throw.
  Slot(const Slot&);
  Slot(Slot&&) noexcept;
  Slot& operator=(const Slot&);
  Slot& operator=(Slot&&) noexcept;
  ~Slot();

  const Vec2& origin() const { return origin_; }  ///< [m]
  double angle() const { return angle_; }         ///< [rad]

  // The profile's functions; p is in the profile's frame [m].
  /// [m]
  double half_width() const { return profile_->half_width(); }
  /// What each region is, by its number.
  std::vector<SlotRegion> regions() const { return profile_->regions(); }
  /// One for each region; empty if the profile does not know them.
  std::vector<CurvatureRange> curvatures() const { return profile_->curvatures(); }
  /// Whether it is known how the curvature changes along the region.
  bool follows(int region) const { return profile_->follows(region); }
  /// How the curvature changes at the place touched.
  CurvatureField curvature_field(const Touch& touch) const {
    return profile_->curvature_field(touch);
  }
  /// As it is drawn; empty if the profile does not know.
  std::vector<WallLine> outline() const { return profile_->outline(); }
  /// Where p is relative to a region.
  Touch touch(int region, const Vec2& p) const { return profile_->touch(region, p); }
  /// The region whose wall is nearest to p.
  int nearest(const Vec2& p) const { return profile_->nearest(p); }
  /// [m] where the region ends: < 0 inside, > 0 beyond.
  double boundary(int region, const Vec2& p) const { return profile_->boundary(region, p); }
  /// The region on the other side of the boundary nearest to p.
  int successor(int region, const Vec2& p) const { return profile_->successor(region, p); }

  /// Walls of the same slot that the pin may touch at the same time, each a contact of its own.
  const std::vector<Slot>& others() const { return others_; }
  /// Adds to others().
  void add(Slot other) { others_.push_back(std::move(other)); }

  /// Throws ModelError if a dimension is wrong.
  void check_shape(std::string_view owner) const;
  /// Also if a pin of this radius [m] has no room.
  void check(std::string_view owner, double pin_radius) const;

 private:
  struct Profile {
    virtual ~Profile() = default;
    virtual double half_width() const = 0;
    virtual std::vector<SlotRegion> regions() const = 0;
    virtual std::vector<CurvatureRange> curvatures() const = 0;
    virtual bool follows(int region) const = 0;
    virtual CurvatureField curvature_field(const Touch& touch) const = 0;
    virtual std::vector<WallLine> outline() const = 0;
    virtual Touch touch(int region, const Vec2& p) const = 0;
    virtual int nearest(const Vec2& p) const = 0;
    virtual double boundary(int region, const Vec2& p) const = 0;
    virtual int successor(int region, const Vec2& p) const = 0;
    virtual void check(std::string_view owner) const = 0;
  };

  template <class P>
  struct Holder final : Profile {
    explicit Holder(P given) : profile(std::move(given)) {}
    double half_width() const override { return profile.half_width(); }
    std::vector<SlotRegion> regions() const override { return profile.regions(); }
    std::vector<CurvatureRange> curvatures() const override {
      if constexpr (requires { profile.curvatures(); }) return profile.curvatures();
      const double unknown = std::numeric_limits<double>::infinity();
      return std::vector<CurvatureRange>(profile.regions().size(), {-unknown, unknown});
    }
    bool follows(int region) const override {
      if constexpr (requires { profile.follows(region); })
        return profile.follows(region);
      else
        return requires(const Touch& t) { profile.curvature_field(t); };
    }
    CurvatureField curvature_field(const Touch& touch) const override {
      if constexpr (requires { profile.curvature_field(touch); })
        return profile.curvature_field(touch);
      else
        return {};
    }
    std::vector<WallLine> outline() const override {
      if constexpr (requires { profile.outline(); }) return profile.outline();
      return {};
    }
    Touch touch(int region, const Vec2& p) const override { return profile.touch(region, p); }
    int nearest(const Vec2& p) const override { return profile.nearest(p); }
    double boundary(int region, const Vec2& p) const override {
      return profile.boundary(region, p);
    }
    int successor(int region, const Vec2& p) const override { return profile.successor(region, p); }
    void check(std::string_view owner) const override { profile.check(owner); }
    P profile;
  };

  std::shared_ptr<const Profile> profile_;
  std::vector<Slot> others_;
  Vec2 origin_;
  double angle_ = 0.0;
};

}  // namespace yoke
