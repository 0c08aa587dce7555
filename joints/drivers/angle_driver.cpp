// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/drivers/angle_driver.hpp>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/rows/checks.hpp>

namespace yoke {
namespace {

class AngleConstraint final : public Constraint {
 public:
  explicit AngleConstraint(const AngleDriver& d)
      : Constraint(d.name, {d.relative_to, d.body}, {{"angle", Measure::angle}},
                   {false, false, true, false, false, true}),
        reference_(d.relative_to),
        body_(d.body),
        f_(d.angle) {}

  void evaluate(const Motion& motion, const ConstraintRequest& out) const override {
    if (out.phi != nullptr || out.phi_t != nullptr || out.gamma != nullptr) {
      const TimeValue f = f_(motion.t);
      if (out.phi != nullptr) out.phi[0] = motion[body_].angle - motion[reference_].angle - f.value;
      if (out.phi_t != nullptr) out.phi_t[0] = -f.rate;
      if (out.gamma != nullptr) out.gamma[0] = f.acceleration;
    }
    if (out.G != nullptr) out.G[2] = -1.0, out.G[5] = 1.0;
    if (out.H != nullptr) out.H[2] = out.H[5] = 0.0;
  }

  bool rheonomic() const override { return true; }
  void draw(Drawing& drawing) const override { drawing.turn(reference_, body_, ShapeRole::driver); }

 private:
  BodyId reference_, body_;
  TimeFunction f_;
};

}  // namespace

std::unique_ptr<Constraint> AngleDriver::build(const Model& model) const {
  const std::string owner = element_name("angle driver", name);
  require_different_bodies(owner, model, {{"body", body}, {"relative_to", relative_to}});
  require_time_function(owner, "angle", angle);
  return std::make_unique<AngleConstraint>(*this);
}

}  // namespace yoke
