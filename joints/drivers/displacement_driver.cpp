// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/drivers/displacement_driver.hpp>

#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/drivers/set_motion.hpp>
#include <yoke/joints/rows/checks.hpp>
#include <yoke/joints/rows/projection.hpp>

namespace yoke {
namespace {

struct Geometry {
  Vec2 u_l;       // unit direction in axes of relative_to
  Vec2 s;         // [m] the point in axes of the body
  double offset;  // [m] coordinate of `from` along u, from the centre of relative_to
  double start;   // [m] of the point from `from`, in the start pose
};

class DisplacementConstraint final : public Constraint {
 public:
  DisplacementConstraint(const DisplacementDriver& d, const Geometry& g)
      : Constraint(d.name, {d.relative_to, d.body}, {{"displacement", Measure::length}},
                   Projection::pattern(d.relative_to, g.u_l, g.s, 0, 3)),
        line_(d.relative_to),
        body_(d.body),
        g_(g),
        f_(d.displacement),
        set_(d.speed, Measure::length, f_ ? 0.0 : g.start) {}

  void evaluate(const Motion& motion, const ConstraintRequest& out) const override {
    const Projection along(motion[line_], g_.u_l, motion[body_], g_.s);
    if (out.phi != nullptr || out.phi_t != nullptr || out.gamma != nullptr) {
      const TimeValue f = set_.with(f_, motion.t, out.parameters);
      if (out.phi != nullptr) out.phi[0] = along.coordinate() - g_.offset - f.value;
      if (out.phi_t != nullptr) out.phi_t[0] = -f.rate;
      if (out.gamma != nullptr) out.gamma[0] = along.gamma() + f.acceleration;
    }
    if (out.G != nullptr) along.write_G(out.G, 0, 3);
    if (out.H != nullptr) along.write_H(out.H, 0, 3);
    if (out.K != nullptr) along.write_K(out.lambda[0], out.K, 0, 3);
  }

  Vec2 reaction_point(const Motion& motion) const override { return motion[body_].point(g_.s); }
  bool rheonomic() const override { return true; }
  std::vector<Parameter> parameters() const override { return set_.parameters(); }
  void update_parameters(double t, double* own) const override { set_.update(t, own); }
  void draw(Drawing& drawing) const override {
    drawing.arrow(body_, g_.s, line_, g_.u_l, ShapeRole::driver);
  }

 private:
  BodyId line_, body_;
  Geometry g_;
  TimeFunction f_;
  SetMotion set_;
};

}  // namespace

std::unique_ptr<Constraint> DisplacementDriver::build(const Model& model) const {
  const std::string owner = element_name("displacement driver", name);
  require_different_bodies(owner, model, {{"body", body}, {"relative_to", relative_to}});
  const Vec2 origin = from.value_or(at);
  require_finite_vector(owner, "at", at);
  require_finite_vector(owner, "from", origin);
  const Vec2 u = unit_direction(owner, "along", along);
  if (displacement || !speed) require_time_function(owner, "displacement", displacement);
  if (speed) require_finite(owner, "speed", *speed);
  return std::make_unique<DisplacementConstraint>(
      *this, Geometry{.u_l = model.direction_to_local(relative_to, u),
                      .s = model.to_local(body, at),
                      .offset = u.dot(origin - model.body(relative_to).pose.position),
                      .start = u.dot(at - origin)});
}

}  // namespace yoke
