// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in docs/friction.md.
#pragma once

#include <cmath>
#include <string>

// clang-format off
#include <yoke/yoke.hpp>
// clang-format on

namespace yoke::friction_example {

using namespace yoke::literals;

// A wheel that is let go spinning on a floor.
Model spinning_wheel(const ContactLaw& law) {
  Model m;
  const Vec2 centre{0.0, 50.0_mm};
  const BodyId wheel = m.add(Body{.name = "wheel",
                                  .mass = 1.0_kg,
                                  .inertia = 1250.0_kg_mm2,
                                  .pose = {centre, 0.0},
                                  .twist = {{0.0, 0.0}, -20.0}});
  m.add(Gravity{});
  m.add(DiscOnCurve{.name = "floor",
                    .disc = {wheel, centre, 50.0_mm},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = law});
  return m;
}

ContactLaw rubber() {
  return {PowerLaw{1e7, 1.5}, HuntCrossley{0.3}, BrownMcPhee{.mu = 0.5, .mu_static = 0.6}};
}

// A flywheel that runs out in its bearing.
Model flywheel(const FrictionLaw& law) {
  Model m;
  const BodyId wheel = m.add(Body{.name = "wheel",
                                  .mass = 3.0_kg,
                                  .inertia = 20000.0_kg_mm2,
                                  .pose = {{0.0, 0.0}, 0.0},
                                  .twist = {{0.0, 0.0}, 4.0}});
  m.add(Gravity{});
  m.add(Revolute{.name = "bearing",
                 .a = ground,
                 .b = wheel,
                 .friction = PinFriction{.law = law, .radius = 10.0_mm}});
  return m;
}

/// mu N (2/pi) atan(v/v_t)
struct Arctangent {
  double mu = 0.0;          // [1] >= 0
  double threshold = 1e-3;  // [m/s] > 0

  FrictionOutput operator()(const FrictionInput& in) const {
    const double x = in.sliding / threshold, part = 2.0 / pi * std::atan(x);
    return {.force = mu * in.normal_force * part,
            .dforce_dnormal = mu * part,
            .dforce_dsliding = mu * in.normal_force * 2.0 / pi / (threshold * (1.0 + x * x)),
            .dissipated_power = mu * in.normal_force * part * in.sliding};
  }
  void check() const {
    require_not_negative("friction 'arctangent'", "mu", mu, "");
    require_positive("friction 'arctangent'", "threshold", threshold, "m/s");
  }
  std::string name() const { return "arctangent"; }
};

}  // namespace yoke::friction_example
