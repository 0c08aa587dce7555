// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The plainest contact, made outside the library: a point of a body above a horizontal wall of the
// ground.
//   d = height - y_p,   y_p = y + sin(angle) s.x + cos(angle) s.y   of the point s of the body
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <yoke/contact/contact_element.hpp>
#include <yoke/core/model.hpp>

namespace yoke::tests {

class WallGeometry final : public ContactGeometry {
 public:
  WallGeometry(BodyId body, const Vec2& s, double height) : body_(body), s_(s), height_(height) {}

  std::vector<std::string> region_names() const override { return {"wall"}; }
  int nearest(const Motion&) const override { return 0; }
  double penetration(const Motion& motion, int) const override {
    return height_ - motion[body_].point(s_).y();
  }
  void calc_kinematics(const Motion& motion, int region, bool want_hessian,
                       ContactKinematics& out) const override {
    const Vec2 arm = motion[body_].to_global(s_);
    out.penetration = penetration(motion, region);
    out.gradient = {0.0, -1.0, -arm.x(), 0.0, 0.0, 0.0};
    if (!want_hessian) return;
    out.hessian = {};
    out.hessian[2 * 6 + 2] = arm.y();
  }
  ContactPlace calc_place(const Motion& motion, int) const override {
    return {{motion[body_].point(s_).x(), height_}, motion[body_].point_velocity(s_).x(), 0.0};
  }

 private:
  BodyId body_;
  Vec2 s_;  // [m] in body axes
  double height_;
};

/// m.add(Wall{.name = "floor", .body = ball, .law = law});
struct Wall {
  std::string name;
  BodyId body;
  ContactLaw law;
  double height = 0.0;   // [m] of the surface
  Vec2 point{0.0, 0.0};  // [m] in body axes
  double reference_force = 100.0;

  std::unique_ptr<ForceElement> build(const Model&) const {
    return std::make_unique<ContactElement>(name, body, ground,
                                            std::make_unique<WallGeometry>(body, point, height),
                                            std::vector<ContactLaw>{law}, reference_force);
  }
};

}  // namespace yoke::tests
