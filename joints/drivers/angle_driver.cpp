// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/drivers/angle_driver.hpp>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/drivers/set_motion.hpp>
#include <yoke/joints/rows/checks.hpp>

namespace yoke {
namespace {

class AngleConstraint final : public Constraint {
 public:
  /// `start` [rad] angle in the start pose.
  AngleConstraint(const AngleDriver& d, double start)
      : Constraint(d.name, {d.relative_to, d.body}, {{"angle", Measure::angle}},
                   {false, false, true, false, false, true}),
        reference_(d.relative_to),
        body_(d.body),
        f_(d.angle),
        set_(d.speed, Measure::angle, f_ ? 0.0 : start) {}

  void evaluate(const Motion& motion, const ConstraintRequest& out) const override {
    if (out.phi != nullptr || out.phi_t != nullptr || out.gamma != nullptr) {
      const TimeValue f = set_.with(f_, motion.t, out.parameters);
      if (out.phi != nullptr) out.phi[0] = motion[body_].angle - motion[reference_].angle - f.value;
      if (out.phi_t != nullptr) out.phi_t[0] = -f.rate;
      if (out.gamma != nullptr) out.gamma[0] = f.acceleration;
    }
    if (out.G != nullptr) out.G[2] = -1.0, out.G[5] = 1.0;
    if (out.H != nullptr) out.H[2] = out.H[5] = 0.0;
  }

  bool rheonomic() const override { return true; }
  std::vector<Parameter> parameters() const override { return set_.parameters(); }
  void update_parameters(double t, double* own) const override { set_.update(t, own); }
  void draw(Drawing& drawing) const override { drawing.turn(reference_, body_, ShapeRole::driver); }

 private:
  BodyId reference_, body_;
  TimeFunction f_;
  SetMotion set_;
};

}  // namespace

std::unique_ptr<Constraint> AngleDriver::build(const Model& model) const {
  const std::string owner = element_name("angle driver", name);
  require_different_bodies(owner, model, {{"body", body}, {"relative_to", relative_to}});
  if (angle || !speed) require_time_function(owner, "angle", angle);
  if (speed) require_finite(owner, "speed", *speed);
  return std::make_unique<AngleConstraint>(
      *this, model.body(body).pose.angle - model.body(relative_to).pose.angle);
}

}  // namespace yoke
