// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/point_on_curve.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <yoke/core/curves/relative_point.hpp>
#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/rows/checks.hpp>

namespace yoke {
namespace {

class PointOnCurveConstraint final : public Constraint {
 public:
  PointOnCurveConstraint(const PointOnCurve& p, const Model& model)
      : Constraint(p.name, {p.a, p.b}, {{"transverse", Measure::length}}),
        curve_(p.curve),
        point_(model, p.a, p.at, p.b, p.curve.origin(), 0.0) {}

  void evaluate(const Motion& motion, const ConstraintRequest& out) const override {
    const RelativePoint::Place place = point_.place(motion);
    const CurveOffset offset = offset_of(point_.local(motion, place));
    const Vec2 n = point_.to_global(motion, offset.normal);
    if (out.phi != nullptr) out.phi[0] = offset.distance;
    if (out.phi_t != nullptr) out.phi_t[0] = 0.0;
    if (out.G != nullptr) std::ranges::copy(RelativePoint::gradient(n, place), out.G);
    if (out.gamma == nullptr && out.H == nullptr && out.K == nullptr) return;
    RelativePoint::Square hessian;
    RelativePoint::calc_hessian(offset.bend(), n, place, hessian);
    if (out.K != nullptr)
      for (std::size_t i = 0; i < hessian.size(); ++i) out.K[i] = out.lambda[0] * hessian[i];
    if (out.gamma == nullptr && out.H == nullptr) return;
    const BodyMotion &a = motion[point_.a()], &b = motion[point_.b()];
    const RelativePoint::Row v{a.vx, a.vy, a.omega, b.vx, b.vy, b.omega};
    double gamma = 0.0;
    for (std::size_t i = 0; i < RelativePoint::columns; ++i) {
      double row = 0.0;
      for (std::size_t j = 0; j < RelativePoint::columns; ++j)
        row += hessian[RelativePoint::columns * i + j] * v[j];
      if (out.H != nullptr) out.H[i] = row;
      gamma -= v[i] * row;
    }
    if (out.gamma != nullptr) out.gamma[0] = gamma;
  }

  std::size_t reaction_body() const override { return 0; }  // a, the point
  Vec2 reaction_point(const Motion& motion) const override {
    return motion[point_.a()].position() + point_.place(motion).s;
  }
  void draw(Drawing& drawing) const override {
    drawing.point(point_.a(), point_.point());
    if (!std::isfinite(curve_.length())) {
      const CurvePoint at = curve_.at(0.0);
      drawing.line(point_.b(), point_.on_body(at.point - curve_.origin()),
                   point_.on_body(at.point + at.tangent - curve_.origin()) -
                       point_.on_body(at.point - curve_.origin()));
      return;
    }
    std::vector<Vec2> points = curve_.sample(curve_.length() / points_of_drawn_curve);
    for (Vec2& p : points) p = point_.on_body(p - curve_.origin());
    drawing.curve(point_.b(), std::move(points), curve_.closed());
  }

 private:
  CurveOffset offset_of(const Vec2& local) const {
    const std::size_t piece = curve_.pieces() == 1 ? 0 : curve_.nearest_local(local).piece;
    return curve_.piece(piece).offset(local);
  }

  Curve curve_;
  RelativePoint point_;
};

}  // namespace

std::unique_ptr<Constraint> PointOnCurve::build(const Model& model) const {
  const std::string owner = element_name("point on curve", name);
  require_different_bodies(owner, model, {{"a", a}, {"b", b}});
  require_finite_vector(owner, "at", at);
  require_simple(owner, curve);
  for (const CurveCorner& corner : corners_of(curve))
    throw ModelError(fmt::format("{}: the curve has a corner of {:g} rad behind piece {}; round it",
                                 owner, corner.turn, corner.before + 1));
  return std::make_unique<PointOnCurveConstraint>(*this, model);
}

Elements PointOnCurve::elements(const Model& model) const {
  Elements made;
  std::unique_ptr<Constraint> ideal = build(model);  // its checks hold for both
  if (clearance)
    return clearance->elements(model, {.name = name, .a = a, .b = b, .at = at, .curve = &curve});
  made.constraints.push_back(std::move(ideal));
  return made;
}

}  // namespace yoke
