// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The walls at a distance h >= 0 from a curve and what joins them, as regions of a profile
// (slot.hpp): one side of the curve or both, pieces, corners, ends. With D_c the distance of p from
// the curve, > 0 on its left, k its curvature, and s = 1 for the wall on the left, -1 on the right:
//   side   D = s D_c                 wall of curvature s k/(1 - s k h), convex > 0
//   cap, corner  D = |p - c|         concave, radius h
//   edge   D = h + r - |p - c|       convex, radius r
// Slots (curve_slot.hpp) and walls (wall.hpp, h = 0) are made of it.
#pragma once

#include <utility>
#include <vector>

#include <yoke/contact/geometry/slot.hpp>
#include <yoke/core/curves/curve.hpp>

namespace yoke {

class RegionChain {
 public:
  /// No region: the wall ends.
  static constexpr int none = -1;

  /// One wall along one piece of the curve.
  struct Side {
    std::size_t piece = 0;            // of the curve
    double sign = 1.0;                // 1 on the left, -1 on the right
    double low = 0.0, high = 0.0;     // u where the wall begins and ends
    int before = none, after = none;  // the regions there
  };

  /// A wall about a point: concave like a cap, or a convex edge.
  struct Round {
    SlotRegion kind = SlotRegion::edge;       // cap, corner or edge
    Vec2 center{0.0, 0.0};                    // [m]
    double edge_radius = 0.0;                 // [m] of an edge
    Vec2 t_begin{0.0, 0.0}, t_end{0.0, 0.0};  // the region is where these, 0: unbounded,
    int before = none, after = none;          // are passed and not yet passed
  };

  /// Walls along all pieces, each linked to its neighbours: on both sides of the curve, or on one.
  RegionChain(Curve curve, double distance, std::vector<double> signs);

  /// Of a piece, on a side of the curve (by its sign, > 0 left).
  int side_region(std::size_t piece, double sign) const;
  /// The number of the region.
  int add(const Round& round);
  /// What a side has before its beginning, or behind its end.
  void link(int side, bool at_end, int region);
  /// Of a region below sides().size(), to be changed.
  Side& side(int region) { return sides_[static_cast<std::size_t>(region)]; }

  /// The curve the walls follow.
  const Curve& curve() const { return curve_; }
  /// The walls along pieces: the first regions.
  const std::vector<Side>& sides() const { return sides_; }
  /// The walls about points: the regions behind them.
  const std::vector<Round>& rounds() const { return rounds_; }
  /// Whether a region is a wall along a piece.
  bool is_side(int region) const { return region < static_cast<int>(sides_.size()); }
  /// Only if is_side().
  const Side& side_of(int region) const { return sides_[static_cast<std::size_t>(region)]; }
  /// Only if not is_side().
  const Round& round_of(int region) const {
    return rounds_[static_cast<std::size_t>(region) - sides_.size()];
  }

  // The functions of a profile.
  /// One for each region.
  std::vector<CurvatureRange> curvatures() const;
  /// Where p [m] is relative to a region.
  Touch touch(int region, const Vec2& p) const;
  /// Whether the curvature may change along the region.
  bool follows(int region) const;
  /// How it changes at the place touched.
  CurvatureField curvature_field(const Touch& touch) const;
  /// [m] < 0 inside the region, > 0 beyond its end.
  double boundary(int region, const Vec2& p) const;
  /// The region on the other side of that end.
  int successor(int region, const Vec2& p) const;

  /// The region where the foot of p on a side is at u: the side, or the round region at its end that
  /// p is in the range of.
  int region_at(int side, double u, const Vec2& p) const;

 private:
  double curvature_of_wall(double k) const { return k / (1.0 - k * distance_); }
  double curvature_of_wall(const Round& round) const;
  std::pair<double, double> beyond(int region, const Vec2& p) const;

  Curve curve_;
  double distance_;            // [m] h
  std::vector<double> signs_;  // of the walls along each piece
  std::vector<Side> sides_;    // regions: walls along the first piece, along the second, ...
  std::vector<Round> rounds_;  // regions behind them
};

}  // namespace yoke
