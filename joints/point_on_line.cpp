// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/point_on_line.hpp>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/rows/checks.hpp>
#include <yoke/joints/rows/projection.hpp>

namespace yoke {
namespace {

class PointOnLineConstraint final : public Constraint {
 public:
  PointOnLineConstraint(const PointOnLine& p, const Vec2& s_a, const Vec2& n_b, double offset)
      : Constraint(p.name, {p.a, p.b}, {{"transverse", Measure::length}},
                   Projection::pattern(p.b, n_b, s_a, 3, 0)),
        a_(p.a),
        b_(p.b),
        s_a_(s_a),
        n_b_(n_b),
        offset_(offset) {}

  void evaluate(const Motion& motion, const ConstraintRequest& out) const override {
    const Projection across(motion[b_], n_b_, motion[a_], s_a_);
    if (out.phi != nullptr) out.phi[0] = across.coordinate() - offset_;
    if (out.G != nullptr) across.write_G(out.G, 3, 0);
    if (out.phi_t != nullptr) out.phi_t[0] = 0.0;
    if (out.gamma != nullptr) out.gamma[0] = across.gamma();
    if (out.H != nullptr) across.write_H(out.H, 3, 0);
    if (out.K != nullptr) across.write_K(out.lambda[0], out.K, 3, 0);
  }

  std::size_t reaction_body() const override { return 0; }  // a, the point
  Vec2 reaction_point(const Motion& motion) const override { return motion[a_].point(s_a_); }
  void draw(Drawing& drawing) const override {
    drawing.line(b_, offset_ * n_b_, -perp(n_b_));
    drawing.point(a_, s_a_);
  }

 private:
  BodyId a_, b_;
  Vec2 s_a_;       // [m] the point in axes of a
  Vec2 n_b_;       // unit normal in axes of b
  double offset_;  // [m] of the line from the centre of b, along n
};

}  // namespace

std::unique_ptr<Constraint> PointOnLine::build(const Model& model) const {
  const std::string owner = element_name("point on line", name);
  require_different_bodies(owner, model, {{"a", a}, {"b", b}});
  require_finite_vector(owner, "at", at);
  require_finite_vector(owner, "through", through);
  const Vec2 n = perp(unit_direction(owner, "along", along));
  return std::make_unique<PointOnLineConstraint>(*this, model.to_local(a, at),
                                                 model.direction_to_local(b, n),
                                                 n.dot(through - model.body(b).pose.position));
}

}  // namespace yoke
