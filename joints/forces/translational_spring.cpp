// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/forces/translational_spring.hpp>

#include <cmath>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/rows/checks.hpp>
#include <yoke/joints/rows/point_span.hpp>

namespace yoke {
namespace {

class SpringForce final : public ForceElement {
 public:
  SpringForce(const TranslationalSpring& s, const Vec2& s_a, const Vec2& s_b, double start_length)
      : ForceElement(s.name, {s.a, s.b}),
        a_(s.a),
        b_(s.b),
        s_a_(s_a),
        s_b_(s_b),
        k_(s.stiffness),
        c_(s.damping),
        free_length_(s.free_length.value_or(start_length)),
        eps_(1e-9 * start_length) {}

  std::vector<Parameter> parameters() const override {
    return {{"stiffness", "N/m", k_, 0.0},
            {"damping", "N s/m", c_, 0.0},
            {"free_length", "m", free_length_, 0.0}};
  }
  bool dissipates() const override { return true; }

  void evaluate(const ForceInput& in, const ForceRequest& out) const override {
    const PointSpan span(in.motion[a_], s_a_, in.motion[b_], s_b_);
    const double k = in.parameters[0], c = in.parameters[1], free_length = in.parameters[2];
    const double l = std::sqrt(span.e().squaredNorm() + eps_ * eps_);
    const Vec2 n = span.e() / l;
    const Vec2 rate = span.rate();
    const double l_rate = n.dot(rate);
    const double F = k * (l - free_length) + c * l_rate;
    double Jn[6];
    span.write_row(n, Jn);
    if (out.Q != nullptr)
      for (int i = 0; i < 6; ++i) out.Q[i] = -F * Jn[i];
    if (out.dQ_dv != nullptr)
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) out.dQ_dv[i * 6 + j] = -c * Jn[i] * Jn[j];
    if (out.dQ_dq != nullptr) {
      double dF[6];
      write_dF_dq(in.motion, span, k, c, l, n, rate, Jn, dF);
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) out.dQ_dq[i * 6 + j] = -Jn[i] * (dF[j] - F / l * Jn[j]);
      span.add_gram(-F / l, out.dQ_dq);
      span.add_turning(-F, n, out.dQ_dq);
    }
    if (out.energy != nullptr) {
      out.energy->potential = 0.5 * k * (l - free_length) * (l - free_length);
      out.energy->dissipated_power = c * l_rate * l_rate;
    }
  }

  void draw(Drawing& drawing) const override { drawing.spring(a_, s_a_, b_, s_b_); }

 private:
  void write_dF_dq(const Motion& motion, const PointSpan& span, double k, double c, double l,
                   const Vec2& n, const Vec2& rate, const double* Jn, double* dF) const {
    double across[6];  // e'^T P J
    span.write_row((rate - n.dot(rate) * n) / l, across);
    for (int j = 0; j < 6; ++j) dF[j] = k * Jn[j] + c * across[j];
    dF[2] += c * motion[a_].omega * n.dot(span.d_a());
    dF[5] -= c * motion[b_].omega * n.dot(span.d_b());
  }

  BodyId a_, b_;
  Vec2 s_a_, s_b_;  // [m] the ends in body axes
  double k_, c_, free_length_;
  double eps_;  // [m]
};

}  // namespace

std::unique_ptr<ForceElement> TranslationalSpring::build(const Model& model) const {
  const std::string owner = element_name("translational spring", name);
  require_different_bodies(owner, model, {{"a", a}, {"b", b}});
  const double start = require_apart(owner, "at_a", at_a, "at_b", at_b);
  require_not_negative(owner, "stiffness", stiffness, "N/m");
  require_not_negative(owner, "damping", damping, "N s/m");
  if (free_length) require_not_negative(owner, "free_length", *free_length, "m");
  return std::make_unique<SpringForce>(*this, model.to_local(a, at_a), model.to_local(b, at_b),
                                       start);
}

}  // namespace yoke
