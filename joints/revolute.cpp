// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/revolute.hpp>

#include <cmath>
#include <utility>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/friction/joint_friction.hpp>
#include <yoke/joints/rows/checks.hpp>
#include <yoke/joints/rows/point_pair.hpp>

namespace yoke {
namespace {

class RevoluteConstraint final : public Constraint, public CurvaturePattern {
 public:
  RevoluteConstraint(const Revolute& r, const Vec2& s_a, const Vec2& s_b)
      : Constraint(r.name, {r.a, r.b}, {{"x", Measure::length}, {"y", Measure::length}},
                   PointPair::pattern(s_a, s_b)),
        a_(r.a),
        b_(r.b),
        s_a_(s_a),
        s_b_(s_b) {}

  void evaluate(const Motion& motion, const ConstraintRequest& out) const override {
    const PointPair pair(motion[a_], s_a_, motion[b_], s_b_);
    if (out.phi != nullptr) pair.write_phi(out.phi);
    if (out.G != nullptr) pair.write_G(out.G);
    if (out.phi_t != nullptr) out.phi_t[0] = out.phi_t[1] = 0.0;
    if (out.gamma != nullptr) pair.write_gamma(out.gamma);
    if (out.H != nullptr) pair.write_H(out.H);
    if (out.K != nullptr) pair.write_K(out.lambda, out.K);
  }

  bool is_curved(int j, int l) const override { return PointPair::is_curved(j, l); }
  Vec2 reaction_point(const Motion& motion) const override { return motion[b_].point(s_b_); }
  void draw(Drawing& drawing) const override { drawing.pin(a_, s_a_, b_, s_b_); }

 private:
  BodyId a_, b_;
  Vec2 s_a_, s_b_;  // [m] the pin in body axes
};

class PinSurface final : public JointSurface {
 public:
  explicit PinSurface(double radius) : radius_(radius) {}

  void calc_slip(const Motion&, double* row, double*) const override {
    row[2] = -radius_, row[5] = radius_;
  }
  double calc_load(const double* lambda, double* slope) const override {
    const double load = std::hypot(lambda[0], lambda[1]);
    for (int i = 0; slope != nullptr && i < 2; ++i) slope[i] = load > 0.0 ? lambda[i] / load : 0.0;
    return load;
  }

 private:
  double radius_;  // [m]
};

}  // namespace

std::unique_ptr<Constraint> Revolute::build(const Model& model) const {
  const std::string owner = element_name("revolute", name);
  require_different_bodies(owner, model, {{"a", a}, {"b", b}});
  require_finite_vector(owner, "at", at);
  return std::make_unique<RevoluteConstraint>(*this, model.to_local(a, at), model.to_local(b, at));
}

Elements Revolute::elements(const Model& model) const {
  Elements made;
  std::unique_ptr<Constraint> ideal = build(model);  // its checks hold for both
  require_ideal_for_friction(element_name("revolute", name), friction.has_value(),
                             clearance.has_value());
  if (clearance) return clearance->elements(model, {.name = name, .a = a, .b = b, .at = at});
  if (friction) {
    require_positive("friction of '" + name + "'", "radius", friction->radius, "m");
    made.forces.push_back(
        joint_friction(*ideal, {friction->law, friction->preload, friction->reference_force},
                       std::make_unique<PinSurface>(friction->radius)));
  }
  made.constraints.push_back(std::move(ideal));
  return made;
}

}  // namespace yoke
