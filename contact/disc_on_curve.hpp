// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A disc, or a point, of one body on a curve of another: floors, stops, belts, cams, discs on discs,
// bearings. The material is on one side of the curve. With D_c the distance of the disc's centre from
// the curve, > 0 on the side of the disc, and r its radius:
//   d = r - D_c              and where a curve with ends or corners has one at T:
//   d = r - |p - T|
// and derivatives as in core/curves/relative_point.hpp. Derivatives, friction and events:
// contact_element.hpp.
#pragma once

#include <limits>
#include <memory>
#include <string>

#include <yoke/contact/laws/law.hpp>
#include <yoke/contact/wall_law.hpp>
#include <yoke/core/curves/curve.hpp>
#include <yoke/core/force.hpp>

namespace yoke {

/// A disc of a body, or a point of it.
struct Disc {
  BodyId body;          // that carries it
  Vec2 at{0.0, 0.0};    // [m] its centre, a global point in the start pose
  double radius = 0.0;  // [m] >= 0; 0 is a point
};

/// A circular hole, or the bore of a bearing.
struct Hole {
  BodyId body;          // that has it
  Vec2 at{0.0, 0.0};    // [m] its centre, a global point in the start pose
  double radius = 0.0;  // [m] greater than the disc's
};

/// On which side of a curve something is, seen along it.
enum class CurveSide { left, right };

/// m.add(DiscOnCurve{.name = "floor", .disc = {ball, centre, 10.0_mm}, .body = ground,
///                   .curve = straight_line({0.0, 0.0}, {1.0, 0.0}), .law = ...});
/// Corners that point away from the disc are edges; into a corner the disc would touch two sides at
/// once: that is two contacts. Throws ModelError for those, for a hollow of a smaller radius than
/// the disc's, and for a disc that starts behind the surface.
struct DiscOnCurve {
  std::string name;
  Disc disc;                         // what touches
  BodyId body;                       // carries the curve
  Curve curve;                       // global, in the start pose; not crossing itself
  CurveSide side = CurveSide::left;  // where the disc is
  WallLaw law;                       // a ContactLaw, or a function of the wall
  /// [m] of the material behind a curve with ends: a disc whose centre is further behind is not in
  /// contact.
  double thickness = std::numeric_limits<double>::infinity();
  /// [m/s] of the wall along itself, > 0 to the right with the wall below: a belt. Only friction, and
  /// the tangential velocity reported, know of it.
  double surface_speed = 0.0;
  double reference_force = 100.0;  // [N] a light load; its penetration sets the error weights

  std::unique_ptr<ForceElement> build(const Model& model) const;
};

/// A pin in a hole, a journal in its bearing: the disc touches the circle from inside.
struct DiscInHole {
  std::string name;
  Disc disc;  // the pin or journal
  Hole hole;  // the hole or bore
  WallLaw law;
  double reference_force = 100.0;  // [N] as above

  std::unique_ptr<ForceElement> build(const Model& model) const;
};

/// Two discs that touch from outside.
struct DiscOnDisc {
  std::string name;
  Disc disc;   // of one body
  Disc other;  // of another: the wall, as the law sees it
  WallLaw law;
  double reference_force = 100.0;  // [N] as above

  std::unique_ptr<ForceElement> build(const Model& model) const;
};

}  // namespace yoke
