// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/forces/gravity.hpp>

#include <yoke/joints/rows/checks.hpp>

namespace yoke {
namespace {

class GravityForce final : public ForceElement {
 public:
  explicit GravityForce(const Gravity& g)
      : ForceElement(g.name, {}, {.position = false, .velocity = false}), g_(g.acceleration) {}

  std::vector<BodyId> bodies(const Model& model) const override {
    std::vector<BodyId> all;
    for (int i = 1; i <= model.body_count(); ++i) all.push_back(BodyId{i});
    return all;
  }

  void evaluate(const ForceInput& in, const ForceRequest& out) const override {
    const std::span<const Body> bodies = in.motion.inertia;
    if (out.Q != nullptr)
      for (std::size_t i = 1; i < bodies.size(); ++i) {
        out.Q[3 * (i - 1)] = bodies[i].mass * g_.x();
        out.Q[3 * (i - 1) + 1] = bodies[i].mass * g_.y();
      }
    if (out.energy != nullptr)
      for (std::size_t i = 1; i < bodies.size(); ++i)
        out.energy->potential -= bodies[i].mass * g_.dot(in.motion.bodies[i].position());
  }

 private:
  Vec2 g_;
};

}  // namespace

std::unique_ptr<ForceElement> Gravity::build(const Model& /*model*/) const {
  require_finite_vector(element_name("gravity", name), "acceleration", acceleration);
  return std::make_unique<GravityForce>(*this);
}

}  // namespace yoke
