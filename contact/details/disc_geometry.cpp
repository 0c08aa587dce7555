// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/details/disc_geometry.hpp>

#include <utility>

#include <yoke/core/drawing/drawing.hpp>

namespace yoke {

DiscGeometry::DiscGeometry(const Model& model, BodyId a, const Vec2& center, double radius,
                           BodyId b, Slot slot, double surface_speed)
    : center_(model, a, center, b, slot.origin(), slot.angle()),
      slot_(std::move(slot)),
      clearance_(slot_.half_width() - radius),
      surface_speed_(surface_speed) {}

std::vector<std::string> DiscGeometry::region_names() const {
  std::vector<std::string> names;
  for (const SlotRegion region : slot_.regions()) names.emplace_back(region_name(region));
  return names;
}

int DiscGeometry::nearest(const Motion& motion) const {
  return slot_.nearest(center_.local(motion));
}

double DiscGeometry::penetration(const Motion& motion, int region) const {
  return slot_.touch(region, center_.local(motion)).distance - clearance_;
}

DiscGeometry::Placed DiscGeometry::calc_touch(const Motion& motion, int region, bool want_hessian,
                                              ContactKinematics& out) const {
  const RelativePoint::Place place = center_.place(motion);
  const Touch touch = slot_.touch(region, center_.local(motion, place));
  const Vec2 n = center_.to_global(motion, touch.normal);
  out.penetration = touch.distance - clearance_;
  out.curvature = touch.wall_curvature;
  out.gradient = RelativePoint::gradient(n, place);
  if (want_hessian) RelativePoint::calc_hessian(touch.bend, n, place, out.hessian);
  return {place, touch, n};
}

void DiscGeometry::calc_kinematics(const Motion& motion, int region, bool want_hessian,
                                   ContactKinematics& out) const {
  calc_touch(motion, region, want_hessian, out);
}

void DiscGeometry::calc_kinematics(const Motion& motion, int region, bool want_hessian,
                                   ContactKinematics& out, CurvatureKinematics& curvature) const {
  const Placed at = calc_touch(motion, region, want_hessian, out);
  const CurvatureField field = slot_.curvature_field(at.touch);
  curvature.gradient = RelativePoint::gradient(field.along * perp(at.normal), at.place);
  if (want_hessian)
    RelativePoint::calc_hessian(field.along, field.tt, field.tn, at.normal, at.place,
                                curvature.hessian);
}

void DiscGeometry::calc_slip(const Motion& motion, int region, bool want_slope,
                             SlipKinematics& out) const {
  constexpr std::size_t columns = RelativePoint::columns, angle_a = 2, angle_b = 5;
  const RelativePoint::Place place = center_.place(motion);
  const Touch touch = slot_.touch(region, center_.local(motion, place));
  const Vec2 n = center_.to_global(motion, touch.normal);
  const RelativePoint::Row tau = RelativePoint::gradient(perp(n), place);
  const double rho = slot_.half_width() - touch.distance;
  out.row = tau;
  out.row[angle_a] += rho;
  out.row[angle_b] -= rho;
  if (!want_slope) return;
  const RelativePoint::Row g = RelativePoint::gradient(n, place);
  for (std::size_t j = 0; j < columns; ++j) {
    const double phi = touch.bend * tau[j] + (j == angle_b ? 1.0 : 0.0);
    for (std::size_t i = 0; i < columns; ++i) out.slope[columns * i + j] = -g[i] * phi;
    if (j != angle_a) out.slope[columns * angle_a + j] -= g[j];
  }
  out.slope[columns * angle_b + angle_b] += g[angle_b];
}

ContactPlace DiscGeometry::calc_place(const Motion& motion, int region) const {
  const RelativePoint::Place place = center_.place(motion);
  const Touch touch = slot_.touch(region, center_.local(motion, place));
  const Vec2 n = center_.to_global(motion, touch.normal);
  const BodyMotion &a = motion[center_.a()], &b = motion[center_.b()];
  const Vec2 to_wall = (slot_.half_width() - touch.distance) * n;  // from the disc's centre
  const Vec2 slip = (a.velocity() + a.omega * perp(place.s + to_wall)) -
                    (b.velocity() + b.omega * perp(place.w + to_wall));
  return {a.position() + place.s + to_wall, perp(n).dot(slip) - surface_speed_,
          touch.wall_curvature};
}

double DiscGeometry::boundary(const Motion& motion, int region) const {
  return slot_.boundary(region, center_.local(motion));
}

int DiscGeometry::successor(const Motion& motion, int region) const {
  return slot_.successor(region, center_.local(motion));
}

void DiscGeometry::draw(Drawing& drawing) const {
  drawing.disc(center_.a(), center_.point(), slot_.half_width() - clearance_);
  for (WallLine& line : slot_.outline()) {
    for (Vec2& p : line.points) p = center_.on_body(p);
    if (line.endless)
      drawing.endless_wall(center_.b(), line.points[0], line.points[1] - line.points[0]);
    else
      drawing.wall(center_.b(), std::move(line.points), line.closed);
  }
}

}  // namespace yoke
