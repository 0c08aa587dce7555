// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a mechanism looks like: shapes fixed in its bodies, from the geometry that its elements have
// anyway. An element draws itself with a few calls (Constraint::draw, ForceElement::draw); one that
// does not is not seen, and nothing else is lost. Points are in the axes of the body named [m], those
// of the ground are global.
#pragma once

#include <string>
#include <vector>

#include <yoke/core/types.hpp>

namespace yoke {

class Model;

/// What is drawn of an element, and what the points of the shape mean.
enum class ShapeKind {
  pin,     ///< points[0] of `body` and points[1] of `other` are one point; both turn about it
  weld,    ///< the same, and neither turns against the other
  line,    ///< straight without ends, through points[0] along the unit vector points[1]
  block,   ///< slides along points[1] with its middle at points[0]
  point,   ///< a point that a line or curve guides
  curve,   ///< guides a point
  rod,     ///< from points[0] of `body` to points[1] of `other`
  spring,  ///< the same
  disc,    ///< about points[0]
  wall,    ///< with its material on the right
  turn,    ///< acts on the angle of `other` against `body`; at points[0] of `other`
  arrow,   ///< acts at points[0] of `body`, along points[1] of `other` if that is not zero
  gear,    ///< pitch circle about points[0]
  belt,    ///< around two wheels about points[0] of `body` and points[1] of it
};

/// Tells shapes of one kind apart: a driver and a torsional spring both turn a body.
enum class ShapeRole { joint, spring, driver, load, contact };

/// One shape of an element.
struct Shape {
  ShapeKind kind = ShapeKind::pin;    // what is drawn
  ShapeRole role = ShapeRole::joint;  // of what kind of element
  std::string element{};              // the joint or force it belongs to
  BodyId body{}, other{};             // the second body, where the kind has two
  std::vector<Vec2> points{};         // [m] in axes of the bodies
  double radius = 0.0;                // [m] of discs and gears
  bool closed = false;                // of curves and walls
};

/// One body; see draw().
struct DrawnBody {
  std::string name;  // as in the model
  std::vector<Vec2>
      outline{};          // none: nothing but its centre of mass; one point: a mass at a joint
  bool given = false;     // by Body::outline: a closed polygon, to be drawn as it is
  double gyration = 0.0;  // [m] radius of gyration
};

class Drawing {
 public:
  // For elements. `a`, `b`: bodies; at_a, at_b: points in their axes.
  /// A point of a and one of b that are the same; both turn about it.
  void pin(BodyId a, const Vec2& at_a, BodyId b, const Vec2& at_b);
  /// The same, and neither turns against the other.
  void weld(BodyId a, const Vec2& at_a, BodyId b, const Vec2& at_b);
  /// A straight guide of `a`; `along` need not be a unit vector.
  void line(BodyId a, const Vec2& through, const Vec2& along);
  /// What slides along a straight guide.
  void block(BodyId b, const Vec2& at, const Vec2& along);
  /// A point that a line or curve guides.
  void point(BodyId a, const Vec2& at);
  /// A curve of `b` that guides a point.
  void curve(BodyId b, std::vector<Vec2> points, bool closed);
  /// Between a point of a and one of b.
  void rod(BodyId a, const Vec2& at_a, BodyId b, const Vec2& at_b);
  /// Likewise.
  void spring(BodyId a, const Vec2& at_a, BodyId b, const Vec2& at_b);
  void disc(BodyId body, const Vec2& center, double radius);  ///< [m] A disc of `body`.
  /// A wall of `body`, its material on the right of the points.
  void wall(BodyId body, std::vector<Vec2> points, bool closed);
  /// A wall along a straight line without ends, its material on the right.
  void endless_wall(BodyId body, const Vec2& through, const Vec2& along);
  /// Acts on the angle of b against a: about a pin of both, if they have one.
  void turn(BodyId a, BodyId b, ShapeRole role);
  /// Acts on a point of `body`, along a direction of `frame`; zero: the direction changes.
  void arrow(BodyId body, const Vec2& at, BodyId frame, const Vec2& along, ShapeRole role);
  /// Two wheels whose angles against the carrier have the ratio b : a, -r_a/r_b for gears that touch
  /// from outside, 1 for a belt.
  void gear(BodyId a, BodyId b, BodyId carrier, double ratio);

  const std::vector<DrawnBody>& bodies() const { return bodies_; }  ///< indices as in the model
  /// In the order of the elements.
  const std::vector<Shape>& shapes() const { return shapes_; }

  friend Drawing draw(const Model& model);

 private:
  struct Gears {
    std::string element;
    BodyId a, b, carrier;
    double ratio = 0.0;
  };

  Shape& add(ShapeKind kind, BodyId body, std::vector<Vec2> points);
  void attach(BodyId body, const Vec2& at);
  const Vec2* pin_of(BodyId body, BodyId other) const;
  void place_turns();
  void place_gears();
  void make_outlines(const Model& model);

  std::string element_;                     // that is drawing itself
  std::vector<std::vector<Vec2>> anchors_;  // of each body: what its outline must hold
  std::vector<bool> solid_;                 // of each body: a wall around material is its outline
  std::vector<Gears> gears_;
  std::vector<DrawnBody> bodies_;
  std::vector<Shape> shapes_;
};

/// All elements of the model. A body's outline is the one the user gave, or else the convex hull of
/// what is attached to it: joints, springs, slots. With one point alone it is a rod from there
/// through the centre of mass, as long as a uniform rod of its inertia; or that point, if the centre of
/// mass is there.
Drawing draw(const Model& model);

/// No more than this many points along a curve or wall that is drawn.
inline constexpr int points_of_drawn_curve = 240;

}  // namespace yoke
