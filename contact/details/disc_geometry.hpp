// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A disc of body a against a profile of body b (contact/geometry/slot.hpp): a pin in a slot, a disc
// on a wall. With D the profile's distance and h its half-width, 0 for a wall,
//   d = D - (h - radius of the disc)
// and its derivatives as in core/curves/relative_point.hpp, there also g and tau. The surfaces slide on
// one another at the point of contact, rho = h - D from the disc's centre along the normal n:
//   v = tau v + rho (omega_a - omega_b) - surface_speed = row v - surface_speed
// n turns by phi dq, phi = bend tau + (0 .. 0, 1) with b and along the wall, so
//   drow/dq = -g^T phi + E,   E[angle_a, j] = -g_j but for j = angle_a,   E[angle_b, angle_b] = g_5
#pragma once

#include <string>
#include <vector>

#include <yoke/contact/geometry/contact_geometry.hpp>
#include <yoke/contact/geometry/slot.hpp>
#include <yoke/core/curves/relative_point.hpp>

namespace yoke {

class DiscGeometry final : public ContactGeometry {
 public:
  /// `center` [m] of the disc, global, in the start pose; `surface_speed` [m/s] of the wall along
  /// itself, counted as seen from the disc with the wall below: > 0 to the right (a belt).
  DiscGeometry(const Model& model, BodyId a, const Vec2& center, double radius, BodyId b, Slot slot,
               double surface_speed = 0.0);

  std::vector<std::string> region_names() const override;
  int nearest(const Motion& motion) const override;
  double penetration(const Motion& motion, int region) const override;
  void calc_kinematics(const Motion& motion, int region, bool want_hessian,
                       ContactKinematics& out) const override;
  void calc_kinematics(const Motion& motion, int region, bool want_hessian, ContactKinematics& out,
                       CurvatureKinematics& curvature) const override;
  bool knows_slip() const override { return true; }
  void calc_slip(const Motion& motion, int region, bool want_slope,
                 SlipKinematics& out) const override;
  double surface_speed() const override { return surface_speed_; }
  ContactPlace calc_place(const Motion& motion, int region) const override;
  double boundary(const Motion& motion, int region) const override;
  int successor(const Motion& motion, int region) const override;
  void draw(Drawing& drawing) const override;

 private:
  struct Placed {
    RelativePoint::Place place;
    Touch touch;
    Vec2 normal;  // global
  };
  Placed calc_touch(const Motion& motion, int region, bool want_hessian,
                    ContactKinematics& out) const;

  RelativePoint center_;
  Slot slot_;
  double clearance_;      // [m] half-width minus radius
  double surface_speed_;  // [m/s]
};

}  // namespace yoke
