// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/geometry/wall.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

constexpr int no_region = -1;
constexpr double end_slack = 1e-9;  // share of a piece that is its end

/// A point of the wall that sticks out: in the range where `begin` is passed and `end` is not.
struct Edge {
  Vec2 point{0.0, 0.0};
  Vec2 begin{0.0, 0.0}, end{0.0, 0.0};  // directions along the curve; 0: unbounded
  int before = no_region, after = no_region;
};

class WallProfile {
 public:
  explicit WallProfile(WallAlong wall)
      : wall_(std::move(wall)), curve_(wall_.curve), sign_(wall_.disc_on_left ? 1.0 : -1.0) {
    const std::size_t count = curve_.pieces();
    before_.assign(count, no_region);
    after_.assign(count, no_region);
    const bool ring = curve_.closed() && count > 1;
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0 || ring) before_[i] = static_cast<int>((i + count - 1) % count);
      if (i + 1 < count || ring) after_[i] = static_cast<int>((i + 1) % count);
    }
    for (const CurveCorner& corner : corners_of(curve_)) {
      const std::size_t i = corner.before, j = (i + 1) % count;
      const CurvePoint end = curve_.piece(i).at(curve_.piece(i).end());
      const CurvePoint start = curve_.piece(j).at(0.0);
      before_[j] = after_[i] = add({.point = start.point,
                                    .begin = end.tangent,
                                    .end = start.tangent,
                                    .before = static_cast<int>(i),
                                    .after = static_cast<int>(j)});
    }
    if (curve_.closed() || !std::isfinite(curve_.length())) return;
    const CurvePoint first = curve_.piece(0).at(0.0);
    const CurvePoint last = curve_.piece(count - 1).at(curve_.piece(count - 1).end());
    first_edge_ = before_[0] = add({.point = first.point, .end = first.tangent, .after = 0});
    last_edge_ = after_[count - 1] =
        add({.point = last.point, .begin = last.tangent, .before = static_cast<int>(count - 1)});
  }

  double half_width() const { return 0.0; }

  std::vector<SlotRegion> regions() const {
    std::vector<SlotRegion> kinds(curve_.pieces(), SlotRegion::wall);
    kinds.resize(curve_.pieces() + edges_.size(), SlotRegion::edge);
    return kinds;
  }

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

  Touch touch(int region, const Vec2& p) const {
    if (is_wall(region)) {
      const CurveOffset offset = curve_.piece(static_cast<std::size_t>(region)).offset(p);
      return {region, -sign_ * offset.distance, -sign_ * offset.normal, -sign_ * offset.bend(),
              -sign_ * offset.curvature};
    }
    const Vec2 from = p - edge_of(region).point;
    const double distance = from.norm();
    if (!(distance > 0.0)) return {region, 0.0, Vec2(1.0, 0.0), 0.0, infinite};
    return {region, -distance, -from / distance, -1.0 / distance, infinite};
  }

  int nearest(const Vec2& p) const {
    const CurvePlace place = curve_.nearest_local(p);
    const int here = static_cast<int>(place.piece);
    // Beyond an end or a corner the nearest point of the piece is that end. The edge's own range does
    // not tell: of a curve that turns far, it holds points that are close to other parts.
    const double end = curve_.piece(place.piece).end(), slack = end_slack * end;
    for (const auto& [edge, there] : {std::pair{before_[place.piece], place.u <= slack},
                                      {after_[place.piece], place.u >= end - slack}})
      if (there && edge != no_region && !is_wall(edge) && boundary(edge, p) < 0.0) return edge;
    if (first_edge_ != no_region && touch(here, p).distance > wall_.thickness) {
      const auto away = [&](int edge) { return (p - edge_of(edge).point).squaredNorm(); };
      return away(first_edge_) < away(last_edge_) ? first_edge_ : last_edge_;
    }
    return here;
  }

  double boundary(int region, const Vec2& p) const {
    const auto [before, after] = beyond(region, p);
    return std::max(before, after);
  }

  int successor(int region, const Vec2& p) const {
    const auto [before, after] = beyond(region, p);
    const bool back = before >= after;
    if (!is_wall(region)) return back ? edge_of(region).before : edge_of(region).after;
    const std::size_t piece = static_cast<std::size_t>(region);
    return back ? before_[piece] : after_[piece];
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
    constexpr int parts = 400;
    for (int k = 0; k <= parts; ++k) {
      const double s = curve_.length() * k / parts;
      const double hollow = sign_ * curve_.at(s).curvature * wall_.disc_radius;
      if (!(hollow < 1.0))
        throw ModelError(fmt::format(
            "{}: {:g} m along the curve its radius is {:g} m, not greater than the {:g} m of the "
            "disc that is to fit into it",
            owner, s, wall_.disc_radius / hollow, wall_.disc_radius));
    }
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  bool is_wall(int region) const { return region < static_cast<int>(curve_.pieces()); }
  const Edge& edge_of(int region) const {
    return edges_[static_cast<std::size_t>(region) - curve_.pieces()];
  }
  int add(const Edge& edge) {
    edges_.push_back(edge);
    return static_cast<int>(curve_.pieces() + edges_.size()) - 1;
  }

  /// [m] how far p is beyond the beginning and the end of a region; -infinity where it has none.
  std::pair<double, double> beyond(int region, const Vec2& p) const {
    double before = -infinite, after = -infinite;
    if (is_wall(region)) {
      const std::size_t i = static_cast<std::size_t>(region);
      if (before_[i] == no_region && after_[i] == no_region) return {-1.0, -1.0};
      const CurvePiece& piece = curve_.piece(i);
      const double u = piece.foot(p);
      if (before_[i] != no_region) before = -u * piece.at(0.0).speed;
      if (after_[i] != no_region) after = (u - piece.end()) * piece.at(piece.end()).speed;
      return {before, after};
    }
    const Edge& edge = edge_of(region);
    if (edge.before != no_region) before = -edge.begin.dot(p - edge.point);
    if (edge.after != no_region) after = edge.end.dot(p - edge.point);
    return {before, after};
  }

  WallAlong wall_;
  Curve curve_;
  double sign_;                      // 1 if the disc is on the left
  std::vector<int> before_, after_;  // the regions next to each piece
  std::vector<Edge> edges_;          // regions behind the pieces
  int first_edge_ = no_region, last_edge_ = no_region;
};

}  // namespace

Slot wall_profile(const WallAlong& wall) {
  return Slot(WallProfile(wall), wall.curve.origin(), 0.0);
}

}  // namespace yoke
