// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/distance.hpp>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/rows/checks.hpp>
#include <yoke/joints/rows/point_span.hpp>

namespace yoke {
namespace {

std::vector<bool> distance_pattern(const Vec2& s_a, const Vec2& s_b) {
  return {true, true, !s_a.isZero(0.0), true, true, !s_b.isZero(0.0)};
}

class DistanceConstraint final : public Constraint {
 public:
  DistanceConstraint(const Distance& d, const Vec2& s_a, const Vec2& s_b, double length)
      : Constraint(d.name, {d.a, d.b}, {{"length", Measure::length}}, distance_pattern(s_a, s_b)),
        a_(d.a),
        b_(d.b),
        s_a_(s_a),
        s_b_(s_b),
        length_(length) {}

  void evaluate(const Motion& motion, const ConstraintRequest& out) const override {
    const BodyMotion& a = motion[a_];
    const BodyMotion& b = motion[b_];
    const PointSpan span(a, s_a_, b, s_b_);
    const Vec2 n = span.e() / length_;
    if (out.phi != nullptr) out.phi[0] = 0.5 * (n.dot(span.e()) - length_);
    if (out.G != nullptr) span.write_row(n, out.G);
    if (out.phi_t != nullptr) out.phi_t[0] = 0.0;
    if (out.gamma != nullptr || out.H != nullptr) {
      const Vec2 rate = span.rate();
      const double wa = a.omega, wb = b.omega;
      const double na = n.dot(span.d_a()), nb = n.dot(span.d_b());
      if (out.gamma != nullptr)
        out.gamma[0] = -(rate.dot(rate) / length_ + wa * wa * na - wb * wb * nb);
      if (out.H != nullptr) {
        span.write_row(rate / length_, out.H);
        out.H[2] += wa * na;
        out.H[5] -= wb * nb;
      }
    }
    if (out.K != nullptr) {
      span.add_gram(out.lambda[0] / length_, out.K);
      span.add_turning(out.lambda[0], n, out.K);
    }
  }

  Vec2 reaction_point(const Motion& motion) const override { return motion[b_].point(s_b_); }
  void draw(Drawing& drawing) const override { drawing.rod(a_, s_a_, b_, s_b_); }

 private:
  BodyId a_, b_;
  Vec2 s_a_, s_b_;  // [m] the ends in body axes
  double length_;   // [m] L
};

}  // namespace

std::unique_ptr<Constraint> Distance::build(const Model& model) const {
  const std::string owner = element_name("distance", name);
  require_different_bodies(owner, model, {{"a", a}, {"b", b}});
  const double start = require_apart(owner, "at_a", at_a, "at_b", at_b);
  if (length) require_positive(owner, "length", *length, "m");
  return std::make_unique<DistanceConstraint>(*this, model.to_local(a, at_a),
                                              model.to_local(b, at_b), length.value_or(start));
}

}  // namespace yoke
