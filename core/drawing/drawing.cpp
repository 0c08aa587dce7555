// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/drawing/drawing.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <yoke/core/model.hpp>

namespace yoke {

namespace {

/// Convex hull, counter-clockwise (Andrew's monotone chain); one or two points are left as they are.
std::vector<Vec2> hull_of(std::vector<Vec2> points) {
  const auto before = [](const Vec2& p, const Vec2& q) {
    return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
  };
  std::ranges::sort(points, before);
  const double size = points.empty() ? 0.0 : (points.back() - points.front()).norm();
  const auto same = [size](const Vec2& p, const Vec2& q) { return (p - q).norm() <= 1e-9 * size; };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  const auto extend = [&hull](const Vec2& p, std::size_t from) {
    while (hull.size() >= from + 2 &&
           cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const Vec2& p : points) extend(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) extend(*p, lower);
  hull.pop_back();
  return hull;
}

/// [m^2] > 0 if the points go around it counter-clockwise.
double signed_area(const std::vector<Vec2>& points) {
  double twice = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    twice += cross(points[i], points[(i + 1) % points.size()]);
  return 0.5 * twice;
}

/// The other end of a rod that begins at `at`, with its centre of mass at the origin.
Vec2 far_end(const Vec2& at, double gyration) {
  const double near = at.norm(), half = std::sqrt(3.0) * gyration;
  constexpr double longest = 1.5;  // of the near half: more is no rod
  return near > 0.0 && half <= longest * near ? Vec2(-half / near * at) : Vec2(0.0, 0.0);
}

}  // namespace

Shape& Drawing::add(ShapeKind kind, BodyId body, std::vector<Vec2> points) {
  shapes_.push_back({.kind = kind,
                     .element = element_,
                     .body = body,
                     .other = body,
                     .points = std::move(points)});
  return shapes_.back();
}

void Drawing::attach(BodyId body, const Vec2& at) {
  anchors_[static_cast<std::size_t>(body.index)].push_back(at);
}

void Drawing::pin(BodyId a, const Vec2& at_a, BodyId b, const Vec2& at_b) {
  add(ShapeKind::pin, a, {at_a, at_b}).other = b;
  attach(a, at_a);
  attach(b, at_b);
}

void Drawing::weld(BodyId a, const Vec2& at_a, BodyId b, const Vec2& at_b) {
  add(ShapeKind::weld, a, {at_a, at_b}).other = b;
  attach(a, at_a);
  attach(b, at_b);
}

void Drawing::line(BodyId a, const Vec2& through, const Vec2& along) {
  add(ShapeKind::line, a, {through, along.normalized()});
}

void Drawing::block(BodyId b, const Vec2& at, const Vec2& along) {
  add(ShapeKind::block, b, {at, along.normalized()});
  attach(b, at);
}

void Drawing::point(BodyId a, const Vec2& at) {
  add(ShapeKind::point, a, {at});
  attach(a, at);
}

void Drawing::curve(BodyId b, std::vector<Vec2> points, bool closed) {
  for (const Vec2& p : points) attach(b, p);
  add(ShapeKind::curve, b, std::move(points)).closed = closed;
}

void Drawing::rod(BodyId a, const Vec2& at_a, BodyId b, const Vec2& at_b) {
  add(ShapeKind::rod, a, {at_a, at_b}).other = b;
  attach(a, at_a);
  attach(b, at_b);
}

void Drawing::spring(BodyId a, const Vec2& at_a, BodyId b, const Vec2& at_b) {
  Shape& shape = add(ShapeKind::spring, a, {at_a, at_b});
  shape.other = b;
  shape.role = ShapeRole::spring;
  attach(a, at_a);
  attach(b, at_b);
}

void Drawing::disc(BodyId body, const Vec2& center, double radius) {
  Shape& shape = add(ShapeKind::disc, body, {center});
  shape.radius = radius;
  shape.role = ShapeRole::contact;
  attach(body, center);
}

void Drawing::wall(BodyId body, std::vector<Vec2> points, bool closed) {
  // A closed wall around material, as a cam's, is the outline itself.
  if (closed && signed_area(points) < 0.0)
    solid_[static_cast<std::size_t>(body.index)] = true;
  else
    for (const Vec2& p : points) attach(body, p);
  Shape& shape = add(ShapeKind::wall, body, std::move(points));
  shape.closed = closed;
  shape.role = ShapeRole::contact;
}

void Drawing::endless_wall(BodyId body, const Vec2& through, const Vec2& along) {
  add(ShapeKind::line, body, {through, along.normalized()}).role = ShapeRole::contact;
}

void Drawing::turn(BodyId a, BodyId b, ShapeRole role) {
  Shape& shape = add(ShapeKind::turn, b, {});
  shape.other = a;
  shape.role = role;
}

void Drawing::arrow(BodyId body, const Vec2& at, BodyId frame, const Vec2& along, ShapeRole role) {
  Shape& shape = add(ShapeKind::arrow, body, {at, along});
  shape.other = frame;
  shape.role = role;
  attach(body, at);
}

void Drawing::gear(BodyId a, BodyId b, BodyId carrier, double ratio) {
  gears_.push_back({element_, a, b, carrier, ratio});
}

/// Where `body` is pinned to `other`, in axes of `body`; null if it is not.
const Vec2* Drawing::pin_of(BodyId body, BodyId other) const {
  for (const Shape& s : shapes_) {
    if (s.kind != ShapeKind::pin) continue;
    if (s.body == body && s.other == other) return &s.points[0];
    if (s.body == other && s.other == body) return &s.points[1];
  }
  return nullptr;
}

/// The body that is turned is the one that moves, or the second; it becomes the shape's `other`.
void Drawing::place_turns() {
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    if (shapes_[i].kind != ShapeKind::turn) continue;
    BodyId turned = shapes_[i].body, against = shapes_[i].other;
    if (turned == ground) std::swap(turned, against);
    const Vec2* shared = pin_of(turned, against);
    if (shared == nullptr) shared = pin_of(turned, ground);
    const Vec2 at = shared != nullptr ? *shared : Vec2(0.0, 0.0);
    shapes_[i].points = {at};
    shapes_[i].body = against;
    shapes_[i].other = turned;
  }
}

void Drawing::place_gears() {
  for (const Gears& g : gears_) {
    const Vec2 *on_a = pin_of(g.a, g.carrier), *on_b = pin_of(g.b, g.carrier);
    const Vec2 *from = pin_of(g.carrier, g.a), *to = pin_of(g.carrier, g.b);
    if (on_a == nullptr || on_b == nullptr) continue;  // wheels that are held in another way
    element_ = g.element;
    const Vec2 at_a = *on_a, at_b = *on_b, centre_a = *from, centre_b = *to;
    const double distance = (centre_b - centre_a).norm(), size = std::abs(g.ratio);
    const double share = g.ratio < 0.0 ? 1.0 + size : std::abs(1.0 - size);
    constexpr double wheel_of_belt = 0.25;  // of the distance; only the ratio of the radii is known
    const bool belt = !(share > 0.0);
    const double r_b = belt ? wheel_of_belt * distance : distance / share;
    add(ShapeKind::gear, g.a, {at_a}).radius = size * r_b;
    add(ShapeKind::gear, g.b, {at_b}).radius = r_b;
    if (belt) add(ShapeKind::belt, g.carrier, {centre_a, centre_b}).radius = r_b;
  }
}

void Drawing::make_outlines(const Model& model) {
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    const Body& body = model.bodies()[i];
    DrawnBody& drawn = bodies_[i];
    if (body.mass > 0.0) drawn.gyration = std::sqrt(body.inertia / body.mass);
    if (!body.outline.empty()) {
      drawn.given = true;
      for (const Vec2& p : body.outline)
        drawn.outline.push_back(model.to_local(BodyId{static_cast<int>(i)}, p));
      continue;
    }
    drawn.outline = hull_of(anchors_[i]);
    if (drawn.outline.size() != 1) continue;
    // Of a ball on a rod, the rod; what a wall goes around hides it.
    const Vec2 at = drawn.outline[0],
               end = solid_[i] ? Vec2(0.0, 0.0) : far_end(at, drawn.gyration);
    if (end != at) drawn.outline.push_back(end);
  }
}

Drawing draw(const Model& model) {
  Drawing drawing;
  for (const Body& body : model.bodies()) drawing.bodies_.push_back({.name = body.name});
  drawing.anchors_.resize(drawing.bodies_.size());
  drawing.solid_.resize(drawing.bodies_.size());
  for (const auto& constraint : model.constraints()) {
    drawing.element_ = constraint->name();
    constraint->draw(drawing);
  }
  for (const auto& force : model.forces()) {
    drawing.element_ = force->name();
    force->draw(drawing);
  }
  drawing.place_turns();
  drawing.place_gears();
  drawing.make_outlines(model);
  return drawing;
}

}  // namespace yoke
