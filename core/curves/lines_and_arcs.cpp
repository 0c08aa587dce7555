// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/curves/lines_and_arcs.hpp>

#include <cmath>
#include <limits>
#include <utility>

#include <yoke/core/curves/pieces/exact_pieces.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

void require_finite_point(std::string_view owner, std::string_view what, const Vec2& p) {
  if (!p.allFinite())
    throw ModelError(fmt::format("{}: {} = ({}, {}) must be finite", owner, what, p.x(), p.y()));
}

/// One corner of a polyline: where its arc begins and ends.
struct Fillet {
  Vec2 begin{0.0, 0.0}, end{0.0, 0.0}, center{0.0, 0.0};
  double setback = 0.0, turn = 0.0;
};

Fillet fillet_at(const Vec2& before, const Vec2& corner, const Vec2& after, double radius) {
  const Vec2 in = (corner - before).normalized(), out = (after - corner).normalized();
  Fillet f;
  f.turn = std::atan2(cross(in, out), in.dot(out));
  f.setback = radius * std::tan(0.5 * std::abs(f.turn));
  f.begin = corner - f.setback * in;
  f.end = corner + f.setback * out;
  f.center = f.begin + (f.turn > 0.0 ? radius : -radius) * perp(in);
  return f;
}

}  // namespace

Curve line_segment(const Vec2& from, const Vec2& to) {
  require_finite_point("line segment", "from", from);
  require_finite_point("line segment", "to", to);
  const Vec2 along = to - from;
  const double length = along.norm();
  require_positive("line segment", "length", length, "m");
  return Curve(std::make_shared<LinePiece>(Vec2(0.0, 0.0), along / length, length), from);
}

Curve straight_line(const Vec2& through, const Vec2& along) {
  require_finite_point("straight line", "through", through);
  require_finite_point("straight line", "along", along);
  require_positive("straight line", "length of `along`", along.norm(), "");
  return Curve(std::make_shared<LinePiece>(Vec2(0.0, 0.0), along.normalized(),
                                           std::numeric_limits<double>::infinity()),
               through);
}

Curve circular_arc(const CircularArc& arc) {
  require_finite_point("circular arc", "center", arc.center);
  require_positive("circular arc", "radius", arc.radius, "m");
  require_finite("circular arc", "start", arc.start);
  const double sweep = std::abs(arc.angle);
  if (!(sweep > 0.0 && sweep <= 2.0 * pi * (1.0 + 1e-15)))
    throw ModelError(fmt::format(
        "circular arc: angle = {:g} rad must not be 0 and at most 2 pi rad in size", arc.angle));
  const bool closed = sweep >= 2.0 * pi * (1.0 - 1e-15);
  return Curve(std::make_shared<ArcPiece>(Vec2(0.0, 0.0), arc.radius, arc.start, arc.angle, closed),
               arc.center);
}

Curve circle(const Vec2& center, double radius) {
  return circular_arc({.center = center, .radius = radius, .start = 0.0, .angle = 2.0 * pi});
}

Curve polyline(const std::vector<Vec2>& points, const PolylineOptions& options) {
  const std::size_t n = points.size();
  require_not_negative("polyline", "fillet", options.fillet, "m");
  if (n < (options.closed ? 3U : 2U))
    throw ModelError(
        fmt::format("polyline: {} points are too few; at least {}", n, options.closed ? 3 : 2));
  for (const Vec2& p : points) require_finite_point("polyline", "point", p);
  // What each side loses at its ends, and the arcs at the corners; ends have none.
  std::vector<Fillet> fillets(n);
  for (std::size_t i = 0; i < n; ++i) {
    const bool end = !options.closed && (i == 0 || i == n - 1);
    fillets[i] =
        end ? Fillet{.begin = points[i], .end = points[i]}
            : fillet_at(points[(i + n - 1) % n], points[i], points[(i + 1) % n], options.fillet);
  }
  std::vector<Curve> parts;
  const auto add_arc = [&](const Fillet& f) {
    if (!(f.setback > 0.0) || std::abs(f.turn) < 1e-9) return;
    const Vec2 from = f.begin - f.center;
    parts.push_back(circular_arc({.center = f.center,
                                  .radius = options.fillet,
                                  .start = std::atan2(from.y(), from.x()),
                                  .angle = f.turn}));
  };
  for (std::size_t i = 0; i < (options.closed ? n : n - 1); ++i) {
    const std::size_t next = (i + 1) % n;
    const double side = (points[next] - points[i]).norm();
    require_positive(fmt::format("polyline, side {}", i + 1), "length", side, "m");
    const double taken = fillets[i].setback + fillets[next].setback;
    if (taken > side)
      throw ModelError(fmt::format(
          "polyline: side {} of {:g} m is too short for fillets of {:g} m radius, which "
          "take {:g} m of it",
          i + 1, side, options.fillet, taken));
    if (taken < side) parts.push_back(line_segment(fillets[i].end, fillets[next].begin));
    if (options.closed || next != n - 1) add_arc(fillets[next]);
  }
  return chain(parts);
}

}  // namespace yoke
