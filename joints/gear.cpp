// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/gear.hpp>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/rows/checks.hpp>

namespace yoke {
namespace {

double mesh(double ratio, double a, double b, double c) { return (b - c) - ratio * (a - c); }

class GearConstraint final : public Constraint {
 public:
  GearConstraint(const Gear& g, double offset)
      : Constraint(g.name, {g.a, g.b, g.carrier}, {{"mesh", Measure::angle}},
                   {false, false, true, false, false, true, false, false, g.ratio != 1.0}),
        a_(g.a),
        b_(g.b),
        c_(g.carrier),
        ratio_(g.ratio),
        offset_(offset) {}

  void evaluate(const Motion& motion, const ConstraintRequest& out) const override {
    if (out.phi != nullptr)
      out.phi[0] = mesh(ratio_, motion[a_].angle, motion[b_].angle, motion[c_].angle) - offset_;
    if (out.G != nullptr) out.G[2] = -ratio_, out.G[5] = 1.0, out.G[8] = ratio_ - 1.0;
    if (out.phi_t != nullptr) out.phi_t[0] = 0.0;
    if (out.gamma != nullptr) out.gamma[0] = 0.0;
    if (out.H != nullptr) out.H[2] = out.H[5] = out.H[8] = 0.0;
  }

  std::size_t reaction_body() const override { return 1; }  // b
  void draw(Drawing& drawing) const override { drawing.gear(a_, b_, c_, ratio_); }

 private:
  BodyId a_, b_, c_;
  double ratio_;
  double offset_;  // [rad] value of the relation in the start pose
};

}  // namespace

std::unique_ptr<Constraint> Gear::build(const Model& model) const {
  const std::string owner = element_name("gear", name);
  require_different_bodies(owner, model, {{"a", a}, {"b", b}, {"carrier", carrier}});
  require_finite(owner, "ratio", ratio);
  if (ratio == 0.0)
    throw ModelError(
        fmt::format("{}: ratio = {:g} must not be 0; it is -r_a / r_b for external "
                    "gears, +r_a / r_b for internal ones",
                    owner, ratio));
  const auto angle = [&model](BodyId id) { return model.body(id).pose.angle; };
  return std::make_unique<GearConstraint>(*this, mesh(ratio, angle(a), angle(b), angle(carrier)));
}

}  // namespace yoke
