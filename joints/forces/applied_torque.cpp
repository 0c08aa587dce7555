// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/forces/applied_torque.hpp>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/rows/checks.hpp>

namespace yoke {
namespace {

class AppliedTorqueElement final : public ForceElement {
 public:
  explicit AppliedTorqueElement(const AppliedTorque& t)
      : ForceElement(t.name, {t.body}, {.position = false, .velocity = false}),
        body_(t.body),
        torque_(t.torque),
        value_(t.value) {}

  std::vector<Parameter> parameters() const override {
    if (!value_) return {};
    return {{.name = "torque", .unit = "N m", .value = *value_, .load = true}};
  }

  bool supplies() const override { return true; }

  void evaluate(const ForceInput& in, const ForceRequest& out) const override {
    const double torque =
        (torque_ ? torque_(in.motion.t) : 0.0) + (value_ ? in.parameters[0] : 0.0);
    if (out.Q != nullptr) out.Q[2] = torque;
    if (out.energy != nullptr) out.energy->supplied_power = torque * in.motion[body_].omega;
  }

  void draw(Drawing& drawing) const override { drawing.turn(ground, body_, ShapeRole::load); }

 private:
  BodyId body_;
  std::function<double(double)> torque_;
  std::optional<double> value_;
};

}  // namespace

void require_torque_body(const Model& model, const std::string& name, BodyId body) {
  require_moving_body(element_name("applied torque", name), model, {"body", body});
}

std::unique_ptr<ForceElement> AppliedTorque::build(const Model& model) const {
  const std::string owner = element_name("applied torque", name);
  require_torque_body(model, name, body);
  if (!torque && !value)
    throw ModelError(owner + ": torque is missing; give a function of time or a value");
  if (torque) require_finite(owner, "torque at t = 0", torque(0.0));
  if (value) require_finite(owner, "value", *value);
  return std::make_unique<AppliedTorqueElement>(*this);
}

}  // namespace yoke
