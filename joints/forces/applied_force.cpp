// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/forces/applied_force.hpp>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/rows/checks.hpp>

namespace yoke {
namespace {

class AppliedForceElement final : public ForceElement {
 public:
  AppliedForceElement(const AppliedForce& f, const Vec2& s)
      // The moment of a force turns with the body unless it acts at the centre in global axes.
      : ForceElement(f.name, {f.body},
                     {.position = f.frame == Frame::body || !s.isZero(0.0), .velocity = false}),
        body_(f.body),
        s_(s),
        f_(f.force),
        frame_(f.frame),
        value_(f.value) {}

  std::vector<Parameter> parameters() const override {
    if (!value_) return {};
    return {{.name = "fx", .unit = "N", .value = value_->x(), .load = true},
            {.name = "fy", .unit = "N", .value = value_->y(), .load = true}};
  }

  bool supplies() const override { return true; }

  void evaluate(const ForceInput& in, const ForceRequest& out) const override {
    const BodyMotion& body = in.motion[body_];
    const Vec2 d = body.to_global(s_);
    Vec2 f = f_ ? f_(in.motion.t) : Vec2(0.0, 0.0);
    if (value_) f += Vec2(in.parameters[0], in.parameters[1]);
    const Vec2 F = frame_ == Frame::global ? f : body.to_global(f);
    if (out.Q != nullptr) out.Q[0] = F.x(), out.Q[1] = F.y(), out.Q[2] = cross(d, F);
    if (out.dQ_dq != nullptr) {
      if (frame_ == Frame::global)
        out.dQ_dq[8] = -d.dot(F);
      else
        out.dQ_dq[2] = -F.y(), out.dQ_dq[5] = F.x();
    }
    if (out.energy != nullptr) out.energy->supplied_power = F.dot(body.point_velocity(s_));
  }

  void draw(Drawing& drawing) const override {
    drawing.arrow(body_, s_, body_, Vec2(0.0, 0.0), ShapeRole::load);
  }

 private:
  BodyId body_;
  Vec2 s_;  // [m] the point in body axes
  std::function<Vec2(double)> f_;
  Frame frame_;
  std::optional<Vec2> value_;
};

}  // namespace

Vec2 load_point(const Model& model, const std::string& name, BodyId body, const Vec2& at) {
  const std::string owner = element_name("applied force", name);
  require_moving_body(owner, model, {"body", body});
  require_finite_vector(owner, "at", at);
  return model.to_local(body, at);
}

std::unique_ptr<ForceElement> AppliedForce::build(const Model& model) const {
  const std::string owner = element_name("applied force", name);
  const Vec2 s = load_point(model, name, body, at);
  if (!force && !value)
    throw ModelError(owner + ": force is missing; give a function of time or a value");
  if (force) require_finite_vector(owner, "force at t = 0", force(0.0));
  if (value) require_finite_vector(owner, "value", *value);
  return std::make_unique<AppliedForceElement>(*this, s);
}

}  // namespace yoke
