// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Curves in closed form: lines, arcs, circles, and paths made of them. Global points in the start
// pose. All throw ModelError for lengths that are not positive and numbers that are not finite.
#pragma once

#include <vector>

#include <yoke/core/curves/curve.hpp>

namespace yoke {

/// From one point to another [m].
Curve line_segment(const Vec2& from, const Vec2& to);

/// Without ends, through a point [m] along a direction of any length but 0.
Curve straight_line(const Vec2& through, const Vec2& along);

/// An arc by its centre and the angle it sweeps.
struct CircularArc {
  Vec2 center{0.0, 0.0};  // [m]
  double radius = 0.0;    // [m] > 0
  double start = 0.0;     // [rad] from the centre to the first point, from the x axis
  double angle = 0.0;     // [rad] swept, > 0 counter-clockwise, not 0, at most 2 pi in size
};
/// A full turn is closed.
Curve circular_arc(const CircularArc& arc);

/// Counter-clockwise from the point on the x axis: the inside is on the left.
Curve circle(const Vec2& center, double radius);

/// Straight from point to point [m], at least two. With `fillet` [m] > 0 each corner is rounded by a
/// tangent arc of that radius; refused where the sides are too short for it. `closed` goes back to
/// the first point.
struct PolylineOptions {
  double fillet = 0.0;  // [m]
  bool closed = false;  // the last point is joined to the first
};
/// Lines, with arcs at the corners if there is a fillet.
Curve polyline(const std::vector<Vec2>& points, const PolylineOptions& options = {});

}  // namespace yoke
