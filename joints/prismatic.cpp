// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/prismatic.hpp>

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/friction/joint_friction.hpp>
#include <yoke/joints/rows/checks.hpp>
#include <yoke/joints/rows/projection.hpp>

namespace yoke {
namespace {

struct Geometry {
  Vec2 n_a;           // unit normal in axes of a
  Vec2 s_b;           // [m] the point in axes of b
  double offset;      // [m] coordinate of the point along n in the start pose
  double difference;  // [rad] theta_b - theta_a in the start pose
};

std::vector<bool> prismatic_pattern(const Prismatic& p, const Geometry& g) {
  std::vector<bool> pattern{false, false, true, false, false, true};
  const std::vector<bool> transverse = Projection::pattern(p.a, g.n_a, g.s_b, 0, 3);
  pattern.insert(pattern.end(), transverse.begin(), transverse.end());
  return pattern;
}

class PrismaticConstraint final : public Constraint {
 public:
  PrismaticConstraint(const Prismatic& p, const Geometry& g)
      : Constraint(p.name, {p.a, p.b},
                   {{"rotation", Measure::angle}, {"transverse", Measure::length}},
                   prismatic_pattern(p, g)),
        a_(p.a),
        b_(p.b),
        g_(g) {}

  void evaluate(const Motion& motion, const ConstraintRequest& out) const override {
    const BodyMotion& a = motion[a_];
    const BodyMotion& b = motion[b_];
    const Projection across(a, g_.n_a, b, g_.s_b);
    if (out.phi != nullptr) {
      out.phi[0] = b.angle - a.angle - g_.difference;
      out.phi[1] = across.coordinate() - g_.offset;
    }
    if (out.G != nullptr) {
      out.G[2] = -1.0, out.G[5] = 1.0;
      across.write_G(out.G + 6, 0, 3);
    }
    if (out.phi_t != nullptr) out.phi_t[0] = out.phi_t[1] = 0.0;
    if (out.gamma != nullptr) {
      out.gamma[0] = 0.0;
      out.gamma[1] = across.gamma();
    }
    if (out.H != nullptr) {
      out.H[2] = out.H[5] = 0.0;
      across.write_H(out.H + 6, 0, 3);
    }
    if (out.K != nullptr) across.write_K(out.lambda[1], out.K, 0, 3);
  }

  Vec2 reaction_point(const Motion& motion) const override { return motion[b_].point(g_.s_b); }
  void draw(Drawing& drawing) const override {
    const Vec2 along = -perp(g_.n_a);
    drawing.line(a_, g_.offset * g_.n_a, along);
    drawing.block(b_, g_.s_b, rotate(-g_.difference, along));
  }

 private:
  BodyId a_, b_;
  Geometry g_;
};

class GuideSurface final : public JointSurface {
 public:
  GuideSurface(const Prismatic& p, const Geometry& g, double length)
      : a_(p.a), b_(p.b), t_a_(-perp(g.n_a)), s_b_(g.s_b), length_(length) {}

  void calc_slip(const Motion& motion, double* row, double* slope) const override {
    const Projection along(motion[a_], t_a_, motion[b_], s_b_);
    along.write_G(row, 0, 3);
    if (slope != nullptr) along.write_K(1.0, slope, 0, 3);
  }
  double calc_load(const double* lambda, double* slope) const override {
    const double arm = 2.0 / length_;
    const double by_force = std::abs(lambda[1]), by_moment = arm * std::abs(lambda[0]);
    const bool tilts = by_moment > by_force;
    if (slope != nullptr) {
      slope[0] = tilts ? std::copysign(arm, lambda[0]) : 0.0;
      slope[1] = tilts || lambda[1] == 0.0 ? 0.0 : std::copysign(1.0, lambda[1]);
    }
    return tilts ? by_moment : by_force;
  }

 private:
  BodyId a_, b_;
  Vec2 t_a_, s_b_;
  double length_;  // [m]
};

Geometry geometry_of(const Prismatic& p, const Model& model) {
  const std::string owner = element_name("prismatic", p.name);
  require_different_bodies(owner, model, {{"a", p.a}, {"b", p.b}});
  const Vec2 n = perp(unit_direction(owner, "along", p.along));
  const Pose pose_a = model.body(p.a).pose, pose_b = model.body(p.b).pose;
  const Vec2 point = p.at.value_or(p.b == ground ? pose_a.position : pose_b.position);
  require_finite_vector(owner, "at", point);
  return {.n_a = model.direction_to_local(p.a, n),
          .s_b = model.to_local(p.b, point),
          .offset = n.dot(point - pose_a.position),
          .difference = pose_b.angle - pose_a.angle};
}

}  // namespace

std::unique_ptr<Constraint> Prismatic::build(const Model& model) const {
  return std::make_unique<PrismaticConstraint>(*this, geometry_of(*this, model));
}

Elements Prismatic::elements(const Model& model) const {
  Elements made;
  std::unique_ptr<Constraint> ideal = build(model);  // its checks hold for both
  require_ideal_for_friction(element_name("prismatic", name), friction.has_value(),
                             clearance.has_value());
  if (clearance)
    return clearance->elements(model, {.name = name,
                                       .a = a,
                                       .b = b,
                                       .at = at.value_or(model.body(b).pose.position),
                                       .along = along.normalized()});
  if (friction) {
    if (!(friction->length > 0.0))
      throw ModelError(fmt::format(
          "friction of '{}': length = {:g} m of the block must be greater than 0, or infinite for one "
          "whose moment presses nothing",
          name, friction->length));
    made.forces.push_back(joint_friction(
        *ideal, {friction->law, friction->preload, friction->reference_force},
        std::make_unique<GuideSurface>(*this, geometry_of(*this, model), friction->length)));
  }
  made.constraints.push_back(std::move(ideal));
  return made;
}

}  // namespace yoke
