// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/weld.hpp>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/rows/checks.hpp>
#include <yoke/joints/rows/point_pair.hpp>

namespace yoke {
namespace {

std::vector<bool> weld_pattern(const Vec2& s_a, const Vec2& s_b) {
  std::vector<bool> pattern = PointPair::pattern(s_a, s_b);
  pattern.insert(pattern.end(), {false, false, true, false, false, true});
  return pattern;
}

class WeldConstraint final : public Constraint, public CurvaturePattern {
 public:
  WeldConstraint(const Weld& w, const Vec2& s_a, const Vec2& s_b, double difference)
      : Constraint(w.name, {w.a, w.b},
                   {{"x", Measure::length}, {"y", Measure::length}, {"rotation", Measure::angle}},
                   weld_pattern(s_a, s_b)),
        a_(w.a),
        b_(w.b),
        s_a_(s_a),
        s_b_(s_b),
        difference_(difference) {}

  void evaluate(const Motion& motion, const ConstraintRequest& out) const override {
    const BodyMotion& a = motion[a_];
    const BodyMotion& b = motion[b_];
    const PointPair pair(a, s_a_, b, s_b_);
    if (out.phi != nullptr) {
      pair.write_phi(out.phi);
      out.phi[2] = b.angle - a.angle - difference_;
    }
    if (out.G != nullptr) {
      pair.write_G(out.G);
      out.G[14] = -1.0, out.G[17] = 1.0;
    }
    if (out.phi_t != nullptr) out.phi_t[0] = out.phi_t[1] = out.phi_t[2] = 0.0;
    if (out.gamma != nullptr) {
      pair.write_gamma(out.gamma);
      out.gamma[2] = 0.0;
    }
    if (out.H != nullptr) {
      pair.write_H(out.H);
      out.H[14] = out.H[17] = 0.0;
    }
    if (out.K != nullptr) pair.write_K(out.lambda, out.K);
  }

  bool is_curved(int j, int l) const override { return PointPair::is_curved(j, l); }
  Vec2 reaction_point(const Motion& motion) const override { return motion[b_].point(s_b_); }
  void draw(Drawing& drawing) const override { drawing.weld(a_, s_a_, b_, s_b_); }

 private:
  BodyId a_, b_;
  Vec2 s_a_, s_b_;     // [m] the point in body axes
  double difference_;  // [rad] theta_b - theta_a in the start pose
};

}  // namespace

std::unique_ptr<Constraint> Weld::build(const Model& model) const {
  const std::string owner = element_name("weld", name);
  require_different_bodies(owner, model, {{"a", a}, {"b", b}});
  const Pose pose_a = model.body(a).pose, pose_b = model.body(b).pose;
  const Vec2 point = at.value_or(b == ground ? pose_a.position : pose_b.position);
  require_finite_vector(owner, "at", point);
  return std::make_unique<WeldConstraint>(*this, model.to_local(a, point), model.to_local(b, point),
                                          pose_b.angle - pose_a.angle);
}

}  // namespace yoke
