// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/geometry/curve_slot.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <yoke/contact/geometry/region_chain.hpp>
#include <yoke/core/curves/bend_range.hpp>
#include <yoke/core/drawing/drawing.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr int most_samples = 400;   // of a wall, where it is checked
constexpr double closeness = 1e-6;  // share of the half-width by which walls may seem to meet

class CurveSlotProfile {
 public:
  explicit CurveSlotProfile(CurveSlot slot)
      : slot_(std::move(slot)),
        chain_(slot_.centreline, slot_.half_width, {1.0, -1.0}),
        curve_(slot_.centreline) {
    if (!(std::isfinite(slot_.half_width) && slot_.half_width > 0.0)) return;  // check() says so
    if (!curve_.closed()) {
      make_end(false);
      make_end(true);
    }
    for (const CurveCorner& corner : corners_of(curve_)) make_corner(corner);
  }

  double half_width() const { return slot_.half_width; }

  std::vector<SlotRegion> regions() const {
    std::vector<SlotRegion> kinds;
    for (const RegionChain::Side& side : chain_.sides())
      kinds.push_back(side.sign > 0.0 ? SlotRegion::left : SlotRegion::right);
    for (const RegionChain::Round& round : chain_.rounds()) kinds.push_back(round.kind);
    return kinds;
  }

  std::vector<CurvatureRange> curvatures() const { return chain_.curvatures(); }
  bool follows(int region) const { return chain_.follows(region); }
  CurvatureField curvature_field(const Touch& touch) const { return chain_.curvature_field(touch); }
  Touch touch(int region, const Vec2& p) const { return chain_.touch(region, p); }
  double boundary(int region, const Vec2& p) const { return chain_.boundary(region, p); }
  int successor(int region, const Vec2& p) const { return chain_.successor(region, p); }

  /// The sides, and of each round wall the directions in which a pin touches it.
  std::vector<WallLine> outline() const {
    std::vector<WallLine> lines;
    for (const RegionChain::Side& side : chain_.sides()) lines.push_back(drawn_side(side));
    const std::size_t sides = chain_.sides().size();
    for (std::size_t i = 0; i < chain_.rounds().size(); ++i)
      for (WallLine& line : drawn_round(static_cast<int>(sides + i)))
        lines.push_back(std::move(line));
    return lines;
  }

  int nearest(const Vec2& p) const {
    const CurvePlace place = curve_.nearest_local(p);
    const CurvePoint at = curve_.piece(place.piece).at(place.u);
    const Vec2 from = p - at.point;
    const bool open = slot_.start == SlotEnd::open || slot_.end == SlotEnd::open;
    if (open && !curve_.closed() && !inside(place, from)) return nearest_edge(p);
    const double side = cross(at.tangent, from) >= 0.0 ? 1.0 : -1.0;
    return chain_.region_at(chain_.side_region(place.piece, side), place.u, p);
  }

  void check(std::string_view owner) const {
    require_positive(owner, "half_width", slot_.half_width, "m");
    require_not_negative(owner, "edge_radius", slot_.edge_radius, "m");
    check_ends_meant(owner);
    if (!std::isfinite(curve_.length()))
      throw ModelError(fmt::format("{}: the centreline must have a finite length", owner));
    if (short_piece_)
      throw ModelError(fmt::format(
          "{}: piece {} of the centreline is too short for its corner; the slot of half_width = "
          "{:g} m has no wall there",
          owner, *short_piece_ + 1, slot_.half_width));
    for (const RegionChain::Side& side : chain_.sides()) check_wall(owner, side);
    if (!curve_.closed()) check_end(owner, false), check_end(owner, true);
    require_simple(owner, curve_);
  }

 private:
  /// What is given for ends that there are not would be ignored.
  void check_ends_meant(std::string_view owner) const {
    if (curve_.closed() && (slot_.start != SlotEnd::round || slot_.end != SlotEnd::round))
      throw ModelError(fmt::format(
          "{}: the centreline is closed and has no ends: leave start and end out", owner));
    if (slot_.edge_radius > 0.0 && slot_.start != SlotEnd::open && slot_.end != SlotEnd::open)
      throw ModelError(fmt::format(
          "{}: edge_radius = {:g} m is of the edges at open ends, and neither start nor "
          "end is SlotEnd::open; accepted is 0",
          owner, slot_.edge_radius));
  }

  /// To a flat end half a width further: what is across is a contact of its own.
  WallLine drawn_side(const RegionChain::Side& side) const {
    const CurvePiece& piece = curve_.piece(side.piece);
    WallLine line{.closed = curve_.closed() && curve_.pieces() == 1};
    const auto add = [&](const CurvePoint& at, double beyond) {
      line.points.push_back(at.point + beyond * at.tangent +
                            side.sign * slot_.half_width * perp(at.tangent));
    };
    const double h = slot_.half_width;
    if (side.before == RegionChain::none && !curve_.closed()) add(piece.at(side.low), -h);
    for (int i = 0; i <= points_of_drawn_curve; ++i)
      add(piece.at(side.low + (side.high - side.low) * i / points_of_drawn_curve), 0.0);
    if (side.after == RegionChain::none && !curve_.closed()) add(piece.at(side.high), h);
    if (side.sign > 0.0) std::ranges::reverse(line.points);  // the material is outside
    return line;
  }

  std::vector<WallLine> drawn_round(int region) const {
    const RegionChain::Round& round = chain_.round_of(region);
    const bool convex = round.kind == SlotRegion::edge;
    const double radius = convex ? round.edge_radius : slot_.half_width;
    const double inside = convex ? 1.5 : 0.5;  // of the radius: where the centre of a pin may be
    std::vector<WallLine> lines;
    if (!(radius > 0.0)) return lines;
    bool drawing = false;
    for (int i = 0; i <= points_of_drawn_curve; ++i) {
      const double a = 2.0 * pi * i / points_of_drawn_curve;
      const Vec2 out(std::cos(a), std::sin(a));
      const bool here = nearest(round.center + inside * radius * out) == region;
      if (here && !drawing) lines.emplace_back();
      if (here) lines.back().points.push_back(round.center + radius * out);
      drawing = here;
    }
    if (convex)
      for (WallLine& line : lines) std::ranges::reverse(line.points);
    return lines;
  }

  void make_end(bool at_end) {
    const SlotEnd kind = at_end ? slot_.end : slot_.start;
    const std::size_t piece = at_end ? curve_.pieces() - 1 : 0;
    const CurvePiece& last = curve_.piece(piece);
    const CurvePoint at = last.at(at_end ? last.end() : 0.0);
    const Vec2 outwards = at_end ? at.tangent : Vec2(-at.tangent);
    const int left = chain_.side_region(piece, 1.0), right = chain_.side_region(piece, -1.0);
    if (kind == SlotEnd::round) {
      const int cap = chain_.add({.kind = at_end ? SlotRegion::cap_end : SlotRegion::cap_start,
                                  .center = at.point,
                                  .t_begin = outwards,
                                  .before = left});
      chain_.link(left, at_end, cap);
      chain_.link(right, at_end, cap);
    } else if (kind == SlotEnd::open) {
      const double r = slot_.edge_radius;
      const double s = at_end ? last.length_to(last.end()) - r : r;
      const double u = r > 0.0 ? last.at_length(s) : (at_end ? last.end() : 0.0);
      const CurvePoint mouth = last.at(u);
      for (const int side : {left, right}) {
        RegionChain::Side& wall = chain_.side(side);
        const Vec2 center = mouth.point + wall.sign * (slot_.half_width + r) * perp(mouth.tangent);
        (at_end ? wall.high : wall.low) = u;
        chain_.link(side, at_end,
                    chain_.add({.kind = SlotRegion::edge,
                                .center = center,
                                .edge_radius = r,
                                .t_begin = at_end ? mouth.tangent : Vec2(-mouth.tangent),
                                .before = side}));
      }
    }
  }

  void make_corner(const CurveCorner& corner) {
    const std::size_t i = corner.before, j = (i + 1) % curve_.pieces();
    const CurvePiece &a = curve_.piece(i), &b = curve_.piece(j);
    const double inside = corner.turn > 0.0 ? 1.0 : -1.0;
    const int outer_a = chain_.side_region(i, -inside), outer_b = chain_.side_region(j, -inside);
    const int inner_a = chain_.side_region(i, inside), inner_b = chain_.side_region(j, inside);
    const int rounded = chain_.add({.kind = SlotRegion::corner,
                                    .center = b.at(0.0).point,
                                    .t_begin = a.at(a.end()).tangent,
                                    .t_end = b.at(0.0).tangent,
                                    .before = outer_a,
                                    .after = outer_b});
    chain_.link(outer_a, true, rounded);
    chain_.link(outer_b, false, rounded);
    const auto cut = meeting(a, b, inside * slot_.half_width);
    if (!cut) {
      short_piece_ = a.length_to(a.end()) < b.length_to(b.end()) ? i : j;
      return;
    }
    const auto [u_a, u_b] = *cut;
    const CurvePoint on_a = a.at(u_a);
    const int edge =
        chain_.add({.kind = SlotRegion::edge,
                    .center = on_a.point + inside * slot_.half_width * perp(on_a.tangent),
                    .t_begin = on_a.tangent,
                    .t_end = b.at(u_b).tangent,
                    .before = inner_a,
                    .after = inner_b});
    chain_.side(inner_a).high = u_a;
    chain_.side(inner_b).low = u_b;
    chain_.link(inner_a, true, edge);
    chain_.link(inner_b, false, edge);
  }

  /// Where the walls at the distance `offset` of two neighbours meet, by Newton's method from where
  /// straight neighbours would.
  static std::optional<std::pair<double, double>> meeting(const CurvePiece& a, const CurvePiece& b,
                                                          double offset) {
    const CurvePoint end = a.at(a.end()), start = b.at(0.0);
    const double turn =
        std::atan2(cross(end.tangent, start.tangent), end.tangent.dot(start.tangent));
    const double back = std::abs(offset) * std::tan(0.5 * std::abs(turn));
    double u = a.end() - back / end.speed, w = back / start.speed;
    for (int i = 0; i < 50; ++i) {
      const CurvePoint p = a.at(u), q = b.at(w);
      const Vec2 gap = (q.point + offset * perp(q.tangent)) - (p.point + offset * perp(p.tangent));
      const Vec2 du = p.speed * (1.0 - offset * p.curvature) * p.tangent;
      const Vec2 dw = q.speed * (1.0 - offset * q.curvature) * q.tangent;
      const double det = cross(du, dw);
      const double step_u = cross(gap, dw) / det, step_w = cross(gap, du) / det;
      u += step_u, w += step_w;
      if (!std::isfinite(u) || !std::isfinite(w)) return {};
      if (std::abs(step_u) * p.speed + std::abs(step_w) * q.speed < 1e-15 * std::abs(offset)) break;
    }
    if (!(u > 0.0 && u <= a.end() && w >= 0.0 && w < b.end())) return {};
    return std::pair{u, w};
  }

  // ---- where p is ----

  /// Within the slot, as far as its open ends allow? `from` is p - c at its foot.
  bool inside(const CurvePlace& place, const Vec2& from) const {
    if (from.norm() > slot_.half_width) return false;
    const std::size_t last = curve_.pieces() - 1;
    const double slack = 1e-9 * slot_.half_width;  // the foot of a point at the mouth
    const CurvePoint at = curve_.piece(place.piece).at(place.u);
    const bool past = std::abs(at.tangent.dot(from)) > slack;
    const bool at_start = place.piece == 0 && place.u <= 0.0 && past;
    const bool at_end = place.piece == last && place.u >= curve_.piece(last).end() && past;
    return !(at_start && slot_.start == SlotEnd::open) && !(at_end && slot_.end == SlotEnd::open);
  }

  int nearest_edge(const Vec2& p) const {
    int best = RegionChain::none, region = static_cast<int>(chain_.sides().size());
    double least = infinite;
    for (const RegionChain::Round& round : chain_.rounds()) {
      const bool mouth = round.kind == SlotRegion::edge && round.after == RegionChain::none;
      const double distance = (p - round.center).norm();
      if (mouth && distance < least) least = distance, best = region;
      ++region;
    }
    return best;
  }

  // ---- what is wrong ----

  void check_wall(std::string_view owner, const RegionChain::Side& side) const {
    const CurvePiece& piece = curve_.piece(side.piece);
    const double h = slot_.half_width, from = piece.length_to(side.low),
                 length = piece.length_to(side.high) - from;
    const char* name = side.sign > 0.0 ? "left" : "right";
    const BendRange bends = bend_range(piece, side.low, side.high);
    const double sharpest = side.sign > 0.0 ? bends.high : -bends.low;
    if (!(sharpest * h < 1.0 - 1e-9))
      throw ModelError(fmt::format(
          "{}: the {} wall would have a cusp: {:g} m along the centreline its radius is {:g} m, "
          "not greater than half_width = {:g} m",
          owner, name, curve_.length_to({side.piece, side.sign > 0.0 ? bends.u_high : bends.u_low}),
          1.0 / sharpest, h));
    const int parts = std::clamp(static_cast<int>(4.0 * length / h), 16, most_samples);
    for (int k = 0; k <= parts; ++k) {
      const double s = from + length * k / parts;
      const CurvePoint at = piece.at(piece.at_length(s));
      const double along = curve_.length_to({side.piece, piece.at_length(s)});
      const Vec2 wall = at.point + side.sign * h * perp(at.tangent);
      require_clear(owner, wall, fmt::format("{} wall {:g} m along the centreline", name, along));
    }
  }

  /// No point of a wall is closer to the centreline than the half-width.
  void require_clear(std::string_view owner, const Vec2& wall, std::string_view what) const {
    const double h = slot_.half_width;
    const CurvePlace foot = curve_.nearest_local(wall);
    const double clear = (curve_.piece(foot.piece).at(foot.u).point - wall).norm();
    if (clear < (1.0 - closeness) * h)
      throw ModelError(fmt::format(
          "{}: walls meet: the {} is only {:g} m from the centreline {:g} m along it; half_width = "
          "{:g} m",
          owner, what, clear, curve_.length_to(foot), h));
  }

  /// The same for what closes a round or flat end.
  void check_end(std::string_view owner, bool at_end) const {
    const SlotEnd kind = at_end ? slot_.end : slot_.start;
    if (kind == SlotEnd::open) return;
    const CurvePiece& piece = curve_.piece(at_end ? curve_.pieces() - 1 : 0);
    const CurvePoint at = piece.at(at_end ? piece.end() : 0.0);
    const Vec2 outwards = at_end ? at.tangent : Vec2(-at.tangent);
    constexpr int parts = 32;
    for (int k = -parts; k <= parts; ++k) {
      const double x = static_cast<double>(k) / parts;
      const Vec2 away = kind == SlotEnd::round ? rotate(0.5 * pi * x, outwards)
                                               : Vec2(outwards + x * perp(outwards));
      require_clear(owner, at.point + slot_.half_width * away,
                    at_end ? "end of the slot" : "start of the slot");
    }
  }

  CurveSlot slot_;
  RegionChain chain_;
  Curve curve_;
  std::optional<std::size_t> short_piece_;
};

/// The flat end of a slot: a wall across it, as wide as the slot. A pin elsewhere is `away`.
class FlatEndProfile {
 public:
  FlatEndProfile(const CurvePoint& end, bool at_end, double half_width)
      : point_(end.point),
        outwards_(at_end ? end.tangent : Vec2(-end.tangent)),
        half_width_(half_width),
        at_end_(at_end) {}

  double half_width() const { return half_width_; }
  std::vector<SlotRegion> regions() const {
    return {at_end_ ? SlotRegion::end : SlotRegion::start, SlotRegion::wall};
  }
  std::vector<CurvatureRange> curvatures() const { return {{}, {}}; }
  Touch touch(int region, const Vec2& p) const {
    const double distance = region == 0 ? outwards_.dot(p - point_) : -half_width_;
    return {region, distance, outwards_, 0.0, 0.0};
  }
  std::vector<WallLine> outline() const {
    const Vec2 across = half_width_ * perp(outwards_), wall = point_ + half_width_ * outwards_;
    return {{.points = {wall - across, wall + across}}};
  }
  int nearest(const Vec2& p) const {
    const Vec2 from = p - point_;
    const bool across = std::abs(cross(outwards_, from)) <= half_width_;
    return across && outwards_.dot(from) < 2.0 * half_width_ ? 0 : 1;
  }
  double boundary(int, const Vec2&) const { return -half_width_; }
  int successor(int region, const Vec2&) const { return region; }
  void check(std::string_view owner) const {
    require_positive(owner, "half_width", half_width_, "m");
  }

 private:
  Vec2 point_, outwards_;
  double half_width_;
  bool at_end_;
};

/// At the start or the end of the centreline.
Slot flat_end(const CurveSlot& slot, bool at_end) {
  const Curve& c = slot.centreline;
  const CurvePiece& piece = c.piece(at_end ? c.pieces() - 1 : 0);
  return Slot(FlatEndProfile(piece.at(at_end ? piece.end() : 0.0), at_end, slot.half_width),
              c.origin(), 0.0);
}

}  // namespace

Slot curve_slot(const CurveSlot& slot) {
  Slot whole(CurveSlotProfile(slot), slot.centreline.origin(), 0.0);
  if (slot.centreline.closed()) return whole;
  if (slot.start == SlotEnd::flat) whole.add(flat_end(slot, false));
  if (slot.end == SlotEnd::flat) whole.add(flat_end(slot, true));
  return whole;
}

}  // namespace yoke
