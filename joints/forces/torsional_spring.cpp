// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/forces/torsional_spring.hpp>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/rows/checks.hpp>

namespace yoke {
namespace {

class TorsionForce final : public ForceElement {
 public:
  TorsionForce(const TorsionalSpring& s, double free_angle)
      : ForceElement(s.name, {s.a, s.b}),
        a_(s.a),
        b_(s.b),
        k_(s.stiffness),
        c_(s.damping),
        free_angle_(free_angle) {}

  std::vector<Parameter> parameters() const override {
    return {{"stiffness", "N m/rad", k_, 0.0},
            {"damping", "N m s/rad", c_, 0.0},
            {"free_angle", "rad", free_angle_}};
  }
  bool dissipates() const override { return true; }

  void evaluate(const ForceInput& in, const ForceRequest& out) const override {
    const double k = in.parameters[0], c = in.parameters[1];
    const double twist = in.motion[b_].angle - in.motion[a_].angle - in.parameters[2];
    const double rate = in.motion[b_].omega - in.motion[a_].omega;
    if (out.Q != nullptr) {
      out.Q[2] = k * twist + c * rate;
      out.Q[5] = -out.Q[2];
    }
    if (out.dQ_dq != nullptr) write_slope(k, out.dQ_dq);
    if (out.dQ_dv != nullptr) write_slope(c, out.dQ_dv);
    if (out.energy != nullptr) {
      out.energy->potential = 0.5 * k * twist * twist;
      out.energy->dissipated_power = c * rate * rate;
    }
  }

  void draw(Drawing& drawing) const override { drawing.turn(a_, b_, ShapeRole::spring); }

 private:
  static void write_slope(double slope, double* block) {
    block[2 * 6 + 2] = block[5 * 6 + 5] = -slope;
    block[2 * 6 + 5] = block[5 * 6 + 2] = slope;
  }

  BodyId a_, b_;
  double k_, c_, free_angle_;
};

}  // namespace

std::unique_ptr<ForceElement> TorsionalSpring::build(const Model& model) const {
  const std::string owner = element_name("torsional spring", name);
  require_different_bodies(owner, model, {{"a", a}, {"b", b}});
  require_not_negative(owner, "stiffness", stiffness, "N m/rad");
  require_not_negative(owner, "damping", damping, "N m s/rad");
  const double start = model.body(b).pose.angle - model.body(a).pose.angle;
  require_finite(owner, "free_angle", free_angle.value_or(start));
  return std::make_unique<TorsionForce>(*this, free_angle.value_or(start));
}

}  // namespace yoke
