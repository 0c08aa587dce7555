// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Interface of the shape of a contact: penetration d, its gradient g = dd/dq and Hessian H = dg/dq
// over q = (x, y, angle) of body a and of body b, for each region of the surface.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <yoke/core/motion.hpp>

namespace yoke {

class Drawing;

/// One region at one state, over q = (x, y, angle) of body a and of body b.
struct ContactKinematics {
  static constexpr std::size_t columns = 6;         // coordinates of both bodies
  double penetration = 0.0;                         // [m] d, > 0 in contact
  double curvature = 0.0;                           // [1/m] of the wall there, > 0 convex
  std::array<double, columns> gradient{};           // g = dd/dq
  std::array<double, columns * columns> hessian{};  // H = dg/dq, row-major
};

/// The curvature of the wall touched, as a function of q. For laws that follow it.
struct CurvatureKinematics {
  std::array<double, ContactKinematics::columns> gradient{};  // [1/m per m, per rad]
  /// row-major
  std::array<double, ContactKinematics::columns * ContactKinematics::columns> hessian{};
};

/// How the surfaces slide on one another, over the same q: a's relative to b's along t = perp(normal),
/// v = row dq/dt - surface_speed.
struct SlipKinematics {
  std::array<double, ContactKinematics::columns> row{};  // [1, m per rad]
  std::array<double, ContactKinematics::columns * ContactKinematics::columns> slope{};  // drow/dq
};

/// Where a region is, or would be, touched.
struct ContactPlace {
  Vec2 point{0.0, 0.0};              // [m] on the wall, global frame
  double tangential_velocity = 0.0;  // [m/s] of a's surface relative to b's, along perp(normal)
  double wall_curvature = 0.0;       // [1/m] > 0 convex wall, < 0 concave
};

/// The shape of a contact as the contact element needs it. Regions are numbered from 0.
class ContactGeometry {
 public:
  virtual ~ContactGeometry() = default;

  /// Names of the regions as written to results; two may have the same.
  virtual std::vector<std::string> region_names() const = 0;
  /// The region nearest to being touched.
  virtual int nearest(const Motion& motion) const = 0;
  /// [m] d by the formula of the region, also beyond its range.
  virtual double penetration(const Motion& motion, int region) const = 0;
  /// Penetration and gradient, and the Hessian if requested.
  virtual void calc_kinematics(const Motion& motion, int region, bool want_hessian,
                               ContactKinematics& out) const = 0;
  /// The same, and how the curvature of the wall changes: not at all, unless the geometry says so.
  virtual void calc_kinematics(const Motion& motion, int region, bool want_hessian,
                               ContactKinematics& out, CurvatureKinematics& curvature) const {
    calc_kinematics(motion, region, want_hessian, out);
    curvature = {};
  }
  /// Whether calc_slip() is there: without it there is no friction.
  virtual bool knows_slip() const { return false; }
  /// `row`, and its derivative if requested.
  virtual void calc_slip(const Motion& /*motion*/, int /*region*/, bool /*want_slope*/,
                         SlipKinematics& out) const {
    out = {};
  }
  /// [m/s] of b's wall along itself, along t: a belt.
  virtual double surface_speed() const { return 0.0; }
  /// Where the region is, or would be, touched.
  virtual ContactPlace calc_place(const Motion& motion, int region) const = 0;
  /// [m] crosses zero upwards where the region ends; about the distance beyond its end.
  virtual double boundary(const Motion& /*motion*/, int /*region*/) const { return -1.0; }
  /// The region that begins there.
  virtual int successor(const Motion& /*motion*/, int region) const { return region; }
  /// What both sides look like (core/drawing/drawing.hpp); by default nothing is drawn.
  virtual void draw(Drawing&) const {}
};

}  // namespace yoke
