// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/geometry/wall.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <yoke/contact/geometry/region_chain.hpp>
#include <yoke/core/curves/bend_range.hpp>
#include <yoke/core/drawing/drawing.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

class WallProfile {
 public:
  explicit WallProfile(WallAlong wall)
      : wall_(std::move(wall)),
        curve_(wall_.curve),
        sign_(wall_.disc_on_left ? 1.0 : -1.0),
        chain_(curve_, 0.0, {-sign_}) {
    for (const CurveCorner& corner : corners_of(curve_)) {
      const int i = static_cast<int>(corner.before),
                j = static_cast<int>((corner.before + 1) % curve_.pieces());
      const CurvePoint end = end_of(corner.before),
                       start = curve_.piece(static_cast<std::size_t>(j)).at(0.0);
      const int edge = chain_.add({.center = start.point,
                                   .t_begin = end.tangent,
                                   .t_end = start.tangent,
                                   .before = i,
                                   .after = j});
      chain_.link(i, true, edge);
      chain_.link(j, false, edge);
    }
    if (curve_.closed() || !std::isfinite(curve_.length())) return;
    const std::size_t last_piece = curve_.pieces() - 1;
    const int last_wall = static_cast<int>(last_piece);
    const CurvePoint first = curve_.piece(0).at(0.0), last = end_of(last_piece);
    first_edge_ = chain_.add({.center = first.point, .t_end = first.tangent, .after = 0});
    last_edge_ = chain_.add({.center = last.point, .t_begin = last.tangent, .before = last_wall});
    chain_.link(0, false, first_edge_);
    chain_.link(last_wall, true, last_edge_);
  }

  double half_width() const { return 0.0; }

  std::vector<SlotRegion> regions() const {
    std::vector<SlotRegion> kinds(curve_.pieces(), SlotRegion::wall);
    kinds.resize(curve_.pieces() + chain_.rounds().size(), SlotRegion::edge);
    return kinds;
  }

  std::vector<CurvatureRange> curvatures() const { return chain_.curvatures(); }
  bool follows(int region) const { return chain_.follows(region); }
  CurvatureField curvature_field(const Touch& touch) const { return chain_.curvature_field(touch); }
  Touch touch(int region, const Vec2& p) const { return chain_.touch(region, p); }
  double boundary(int region, const Vec2& p) const { return chain_.boundary(region, p); }
  int successor(int region, const Vec2& p) const { return chain_.successor(region, p); }

  std::vector<WallLine> outline() const {
    WallLine line;
    if (!std::isfinite(curve_.length())) {
      const CurvePoint at = curve_.at(0.0);
      line.points = {at.point - curve_.origin(), at.point + at.tangent - curve_.origin()};
      line.endless = true;
    } else {
      line.points = curve_.sample(curve_.length() / points_of_drawn_curve);
      for (Vec2& p : line.points) p -= curve_.origin();
      line.closed = curve_.closed();
    }
    if (!wall_.disc_on_left) std::ranges::reverse(line.points);
    return {line};
  }

  int nearest(const Vec2& p) const {
    const CurvePlace place = curve_.nearest_local(p);
    const int wall = static_cast<int>(place.piece);
    const int here = chain_.region_at(wall, place.u, p);
    if (!chain_.is_side(here) || first_edge_ == RegionChain::none) return here;
    if (!(touch(here, p).distance > wall_.thickness)) return here;
    const auto away = [&](int edge) { return (p - chain_.round_of(edge).center).squaredNorm(); };
    return away(first_edge_) < away(last_edge_) ? first_edge_ : last_edge_;
  }

  void check(std::string_view owner) const {
    require_simple(owner, curve_);
    for (const CurveCorner& corner : corners_of(curve_))
      if (sign_ * corner.turn > 0.0)
        throw ModelError(fmt::format(
            "{}: into the corner behind piece {} of the curve ({:g} rad) the disc would touch two "
            "sides at once; make each side a contact of its own",
            owner, corner.before + 1, corner.turn));
    if (!std::isfinite(curve_.length())) return;
    for (std::size_t i = 0; i < curve_.pieces(); ++i) {
      const CurvePiece& piece = curve_.piece(i);
      const BendRange bends = bend_range(piece, 0.0, piece.end());
      const double hollow = (sign_ > 0.0 ? bends.high : -bends.low) * wall_.disc_radius;
      if (!(hollow < 1.0 - 1e-9))
        throw ModelError(fmt::format(
            "{}: {:g} m along the curve its radius is {:g} m, not greater than the {:g} m of the "
            "disc that is to fit into it",
            owner, curve_.length_to({i, sign_ > 0.0 ? bends.u_high : bends.u_low}),
            wall_.disc_radius / hollow, wall_.disc_radius));
    }
  }

 private:
  CurvePoint end_of(std::size_t piece) const {
    return curve_.piece(piece).at(curve_.piece(piece).end());
  }

  WallAlong wall_;
  Curve curve_;
  double sign_;  // 1 if the disc is on the left
  RegionChain chain_;
  int first_edge_ = RegionChain::none, last_edge_ = RegionChain::none;
};

}  // namespace

Slot wall_profile(const WallAlong& wall) {
  return Slot(WallProfile(wall), wall.curve.origin(), 0.0);
}

}  // namespace yoke
