// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Slots along curves: against the arc slot, against brute force, and what is refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/geometry/curve_slot.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/curves/smooth_curves.hpp>
#include <yoke/core/error.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

namespace {

constexpr double h = 8e-3, pin = 7e-3;  // [m] half-width, radius of the pin

CurveSlot along(Curve curve) { return {.centreline = std::move(curve), .half_width = h}; }

Curve bent() {  // sharp corners to both sides
  return polyline({{0.0, 0.0}, {0.06, 0.0}, {0.09, 0.05}, {0.15, 0.04}});
}
Curve wave() {
  return curve_of([](double u) { return Vec2(u, 0.01 * std::sin(50.0 * u)); }, 0.0, 0.2);
}
Curve s_bend() {
  return chain(
      {line_segment({0.0, 0.0}, {0.05, 0.0}),
       circular_arc({.center = {0.05, 0.03}, .radius = 0.03, .start = -0.5 * pi, .angle = 1.2}),
       line_segment(Vec2(0.05 + 0.03 * std::sin(1.2), 0.03 - 0.03 * std::cos(1.2)),
                    Vec2(0.05 + 0.03 * std::sin(1.2), 0.03 - 0.03 * std::cos(1.2)) +
                        0.04 * Vec2(std::cos(1.2), std::sin(1.2)))});
}

/// Turns further than half a circle: its ends' directions point at other parts of it.
Curve hook() {
  return circular_arc({.center = {0.02, 0.01}, .radius = 0.04, .start = 0.4, .angle = 5.0});
}

std::vector<CurveSlot> all_slots() {
  std::vector<CurveSlot> slots = {along(bent()), along(wave()), along(s_bend()), along(hook())};
  for (const SlotEnd end : {SlotEnd::flat, SlotEnd::open}) {
    slots.push_back(along(s_bend()));
    slots.back().end = end;
    if (end == SlotEnd::open) slots.back().edge_radius = 1e-3;
  }
  slots.push_back(along(circle({0.01, 0.02}, 0.05)));
  slots.push_back(along(polyline({{0.0, 0.0}, {0.1, 0.0}, {0.1, 0.08}, {0.0, 0.08}},
                                 {.fillet = 0.02, .closed = true})));
  return slots;
}

/// Points near the centreline, up to the walls.
std::vector<Vec2> points_in(const CurveSlot& slot, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Curve& c = slot.centreline;
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const CurvePoint at = c.at(0.5 * (1.0 + uniform(random)) * c.length());
    const double beyond = 0.5 * h * uniform(random);
    points.push_back(at.point + 0.8 * h * uniform(random) * perp(at.tangent) + beyond * at.tangent);
  }
  return points;
}

}  // namespace

TEST_CASE("a slot along an arc is the arc slot") {
  const ArcSlot arc{
      .center = {0.3, -0.2}, .radius = 60e-3, .direction = 0.7, .angle = 2.1, .half_width = h};
  const Slot reference = arc_slot(arc);
  const CurveSlot slot = along(
      circular_arc({.center = arc.center, .radius = 60e-3, .start = 0.7 - 1.05, .angle = 2.1}));
  const Slot same = curve_slot(slot);
  std::set<int> seen;
  for (const Vec2& p : points_in(slot, 300, 1)) {
    const Vec2 local = rotate(-arc.direction, p - arc.center);
    const Touch expected = reference.touch(reference.nearest(local), local);
    const Touch touch = same.touch(same.nearest(p - same.origin()), p - same.origin());
    seen.insert(touch.region);
    CHECK(touch.distance == Approx(expected.distance).epsilon(1e-13));
    CHECK((touch.normal - rotate(arc.direction, expected.normal)).norm() < 1e-11);
    CHECK(touch.bend == Approx(expected.bend).epsilon(1e-10));
    CHECK(touch.wall_curvature == Approx(expected.wall_curvature).epsilon(1e-13));
  }
  CHECK(seen.size() == 4);
}

TEST_CASE("a spline through 200 points of an arc is the arc to 1e-8 in gap and normal") {
  double before = 0.0;
  for (const int count : {25, 50, 100, 200}) {
    std::vector<Vec2> points;
    for (int i = 0; i < count; ++i) {
      const double a = -1.05 + 2.1 * i / (count - 1);
      points.emplace_back(60e-3 * std::cos(a), 60e-3 * std::sin(a));
    }
    const Slot spline = curve_slot(along(curve_through(points)));
    const ArcSlot arc{.radius = 60e-3, .angle = 2.1, .half_width = h};
    const Slot exact = arc_slot(arc);
    double gap = 0.0, normal = 0.0;
    for (int i = 0; i <= 500; ++i) {
      const double a = -1.049 + 2.098 * i / 500.0, r = 60e-3 + (i % 2 == 0 ? 0.9 : -0.9) * h;
      const Vec2 p(r * std::cos(a), r * std::sin(a));
      const Touch s = spline.touch(spline.nearest(p - spline.origin()), p - spline.origin());
      const Touch e = exact.touch(exact.nearest(p), p);
      gap = std::max(gap, std::abs(s.distance - e.distance));
      normal = std::max(normal, (s.normal - e.normal).norm());
    }
    if (count == 50) CHECK(std::log2(before / gap) > 5.5);
    before = gap;
    if (count == 200) {
      CHECK(gap < 1e-13);
      CHECK(normal < 1e-10);
    }
  }
}

TEST_CASE("the penetration of a pin is its depth in the material, by brute force") {
  for (const CurveSlot& slot : all_slots()) {
    const Slot shape = curve_slot(slot);
    shape.check("slot", pin);
    // The walls as points: of each wall those that no part of the centreline is nearer to than h.
    std::vector<Vec2> wall;
    const Curve& c = slot.centreline;
    constexpr int count = 10000;
    for (int i = 0; i <= count; ++i) {
      const CurvePoint at = c.at(c.length() * i / count);
      for (const double side : {1.0, -1.0}) {
        const Vec2 w = at.point + side * h * perp(at.tangent);
        if (std::abs((c.at(c.length_to(c.nearest(w))).point - w).norm()) > h * (1.0 - 1e-7))
          wall.push_back(w);
      }
    }
    const auto arc_about = [&](const Vec2& center) {
      for (int k = 0; k < 1500; ++k) {
        const Vec2 w = center + rotate(2.0 * pi * k / 1500.0, Vec2(h, 0.0));
        if ((c.at(c.length_to(c.nearest(w))).point - w).norm() > h * (1.0 - 1e-7))
          wall.push_back(w);
      }
    };
    if (!c.closed()) arc_about(c.at(0.0).point);
    if (!c.closed() && slot.end == SlotEnd::round) arc_about(c.at(c.length()).point);
    for (const CurveCorner& corner : corners_of(c))
      arc_about(c.piece(corner.before).at(c.piece(corner.before).end()).point + c.origin());
    for (const Vec2& p : points_in(slot, 60, 3)) {
      const Vec2 local = p - shape.origin();
      const int region = shape.nearest(local);
      const CurvePoint last = c.at(c.length());
      const double left = last.tangent.dot(p - last.point);
      if (!c.closed() && slot.end != SlotEnd::round && left > -1.5e-3) continue;  // see below
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec2& w : wall) nearest = std::min(nearest, (p - w).norm());
      INFO(
          "region " << std::string(region_name(shape.regions()[static_cast<std::size_t>(region)])));
      // No sample is at the tip of an edge.
      const bool edge = shape.regions()[static_cast<std::size_t>(region)] == SlotRegion::edge;
      CHECK(std::abs((h - shape.touch(region, local).distance) - nearest) <
            (edge ? c.length() / count : 2e-7));
    }
  }
}

TEST_CASE("normal and bend are gradient and Hessian, in all regions, and regions join smoothly") {
  std::set<std::string> seen;
  for (const CurveSlot& slot : all_slots()) {
    const Slot shape = curve_slot(slot);
    const std::vector<SlotRegion> kinds = shape.regions();
    for (const Vec2& p : points_in(slot, 200, 5)) {
      const Vec2 local = p - shape.origin();
      const int region = shape.nearest(local);
      seen.insert(std::string(region_name(kinds[static_cast<std::size_t>(region)])));
      const Touch touch = shape.touch(region, local);
      CHECK(touch.normal.norm() == Approx(1.0).epsilon(1e-13));
      constexpr double step = 1e-6;
      Vec2 gradient;
      for (int e = 0; e < 2; ++e) {
        const Vec2 d = step * Vec2::Unit(e);
        const Touch up = shape.touch(region, local + d), down = shape.touch(region, local - d);
        gradient[e] = (up.distance - down.distance) / (2.0 * step);
        const Vec2 t = perp(touch.normal);
        CHECK(((up.normal - down.normal) / (2.0 * step) - touch.bend * t * t[e]).norm() <
              1e-6 * std::max(1.0, touch.bend * touch.bend));
      }
      CHECK((gradient - touch.normal).norm() < 1e-7);
      CHECK(shape.boundary(region, local) <= 1e-9);
      // Just beyond a boundary its successor is the region there, with the same distance.
      const Vec2 t = perp(touch.normal);
      for (const double way : {1.0, -1.0}) {
        double low = 0.0, high = 3e-3;
        if (shape.boundary(region, local + way * high * t) <= 0.0) continue;
        for (int i = 0; i < 60; ++i) {
          const double middle = 0.5 * (low + high);
          (shape.boundary(region, local + way * middle * t) > 0.0 ? high : low) = middle;
        }
        const Vec2 border = local + way * high * t;
        const int next = shape.successor(region, border);
        REQUIRE(next >= 0);
        const Touch here = shape.touch(region, border), there = shape.touch(next, border);
        CHECK(std::abs(here.distance - there.distance) < 1e-9);
        CHECK((here.normal - there.normal).norm() < 1e-6);
      }
    }
  }
  CHECK(seen == std::set<std::string>{"left", "right", "cap", "corner", "edge"});
}

TEST_CASE("a pin leaves through an open end and is apart outside, wherever it goes") {
  CurveSlot slot = along(line_segment({0.0, 0.0}, {0.1, 0.0}));
  slot.end = SlotEnd::open;
  const Slot shape = curve_slot(slot);
  const auto depth = [&](const Vec2& p) {
    return shape.touch(shape.nearest(p), p).distance - (h - pin);
  };
  CHECK(depth({0.05, 0.0}) == Approx(-1e-3));
  CHECK(depth({0.05, 0.0015}) == Approx(0.5e-3));
  CHECK(depth({-0.0, 0.0}) == Approx(-1e-3));
  CHECK(depth({-0.0015, 0.0}) == Approx(0.5e-3));                        // the round end
  CHECK(depth({0.103, 0.002}) == Approx(pin - std::hypot(3e-3, 6e-3)));  // the edge
  CHECK(depth({0.2, 0.3}) < -0.1);
  CHECK(depth({0.05, 0.03}) < 0.0);  // behind a wall: another part of the machine
  CHECK(depth({-0.05, 0.0}) < 0.0);  // behind the round end
  slot.start = SlotEnd::flat;
  const Slot end = curve_slot(slot).others().front();
  const auto end_depth = [&](const Vec2& p) {
    return end.touch(end.nearest(p), p).distance - (h - pin);
  };
  CHECK(end_depth({-0.0015, 0.003}) == Approx(0.5e-3));
  CHECK(end_depth({-0.05, 0.0}) < 0.0);
  CHECK(end_depth({0.0, 0.05}) < 0.0);
}

TEST_CASE("what cannot be milled is refused, with where and why") {
  const auto refusal = [](const CurveSlot& slot) {
    return message_of([&] { curve_slot(slot).check("slot 's'", pin); });
  };
  CHECK(refusal(along(wave())) == "no error");
  const Curve tight =
      curve_of([](double u) { return Vec2(u, 0.02 * std::sin(80.0 * u)); }, 0.0, 0.2);
  CHECK(contains(refusal(along(tight)), "slot 's': the left wall would have a cusp"));
  const Curve hairpin = polyline({{0.0, 0.0}, {0.1, 0.0}, {0.1, 0.012}, {0.0, 0.012}});
  CHECK(contains(refusal(along(hairpin)), "slot 's': "));
  const Curve crossing = polyline({{0.0, 0.0}, {0.1, 0.0}, {0.1, 0.1}, {0.05, 0.1}, {0.05, -0.1}});
  CHECK(contains(refusal(along(crossing)), "walls meet"));
  CHECK(contains(refusal(along(polyline({{0.0, 0.0}, {0.1, 0.0}, {0.102, 0.03}, {0.104, 0.0}}))),
                 "slot 's': "));
  CurveSlot wide = along(line_segment({0.0, 0.0}, {0.1, 0.0}));
  wide.half_width = 6e-3;
  CHECK(contains(refusal(wide), "smaller than the pin diameter"));
  wide.half_width = -1.0;
  CHECK(contains(refusal(wide), "half_width = -1 m must be finite and greater than 0 m"));
  CHECK(contains(refusal(along(straight_line({0.0, 0.0}, {1.0, 0.0}))), "finite length"));
}

TEST_CASE("ends and edges that a slot does not have are refused, not ignored") {
  const auto refusal = [](const CurveSlot& slot) {
    return message_of([&] { curve_slot(slot).check("slot 's'", pin); });
  };
  CurveSlot slot = along(s_bend());
  slot.edge_radius = 2e-3;
  CHECK(contains(refusal(slot), "slot 's': edge_radius = 0.002 m is of the edges at open ends"));
  slot.start = SlotEnd::flat;
  CHECK(contains(refusal(slot), "neither start nor end is SlotEnd::open; accepted is 0"));
  slot.end = SlotEnd::open;
  CHECK(refusal(slot) == "no error");
  CurveSlot ring = along(circle({0.01, 0.02}, 0.05));
  CHECK(refusal(ring) == "no error");
  ring.end = SlotEnd::open;
  CHECK(contains(refusal(ring), "slot 's': the centreline is closed and has no ends"));
}

TEST_CASE("walls that would have a cusp are refused however short it is, nearly one is not") {
  // Radii of curvature: 10 mm at the vertex of a parabola, 10 nm of a nearly pointed cycloid; none
  // where a sample of the curve falls by chance.
  const Curve parabola = curve_of([](double u) { return Vec2(u, u * u / 0.02); }, -0.1, 0.0831);
  const Curve pointed = curve_of(
      [](double u) { return Vec2(0.01 * (u - 0.999 * std::sin(u)), -0.01 * 0.999 * std::cos(u)); },
      -3.1, 2.7);
  const auto refusal = [](const Curve& curve, double half_width) {
    return message_of(
        [&] { curve_slot({.centreline = curve, .half_width = half_width}).check_shape("slot"); });
  };
  CHECK(refusal(parabola, 9.99999e-3) == "no error");
  CHECK(refusal(parabola, 10.00001e-3).find("slot: the left wall would have a cusp: ") == 0);
  CHECK(refusal(pointed, 9e-9) == "no error");
  CHECK(refusal(pointed, 1e-6).find("its radius is 1.001e-08 m") != std::string::npos);
}

TEST_CASE("round and flat ends that meet other walls are refused") {
  const auto refusal = [](double angle, SlotEnd end) {
    return message_of([&] {
      curve_slot({.centreline = circular_arc({{0.0, 0.0}, 0.05, 0.0, angle}),
                  .half_width = 5e-3,
                  .start = end,
                  .end = end})
          .check_shape("slot");
    });
  };
  // 2 asin(1/10) are left where the round ends touch.
  const double touch = 2.0 * pi - 2.0 * std::asin(0.1);
  CHECK(refusal(touch - 0.001, SlotEnd::round) == "no error");
  CHECK(refusal(touch + 0.01, SlotEnd::round).find("slot: walls meet: the start of the slot") == 0);
  CHECK(refusal(touch + 0.01, SlotEnd::flat).find("slot: walls meet: the start of the slot") == 0);
}
