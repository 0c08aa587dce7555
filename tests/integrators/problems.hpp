// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Problems on which costs are compared: P1 a chain, P4 a disc that bounces. P2 is the case
// n_four_bar, P3 the scotch-yoke of mechanisms.hpp.
#pragma once

#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

namespace yoke::tests {

/// Uniform links of 1 m and 1 kg that hang from one another, horizontal at the start.
inline Model horizontal_chain(int links) {
  Model m;
  BodyId last = ground;
  for (int i = 0; i < links; ++i) {
    const BodyId link = m.add(Body{.name = "link " + std::to_string(i),
                                   .mass = 1.0,
                                   .inertia = 1.0 / 12.0,
                                   .pose = {{i + 0.5, 0.0}, 0.0}});
    m.add(Revolute{.name = "joint " + std::to_string(i), .a = last, .b = link, .at = Vec2(i, 0.0)});
    last = link;
  }
  m.add(Gravity{});
  return m;
}

/// A disc that falls on a floor, F = K d^1.5 (1 + 3/2 alpha d').
struct BouncingDisc {
  double height = 0.25, radius = 0.05;   // [m] of its centre
  double mass = 1.0, gravity = 9.81;     // [kg], [m/s^2]
  double stiffness = 1e9, alpha = 0.05;  // [N/m^1.5], [s/m]
};
inline Model bouncing_disc(const BouncingDisc& d = {}) {
  Model m;
  const Vec2 start(0.0, d.height);
  const BodyId disc = m.add(Body{.name = "disc",
                                 .mass = d.mass,
                                 .inertia = 0.5 * d.mass * d.radius * d.radius,
                                 .pose = {start, 0.0}});
  m.add(Gravity{.acceleration = {0.0, -d.gravity}});
  m.add(DiscOnCurve{.name = "floor",
                    .disc = {disc, start, d.radius},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = {PowerLaw{d.stiffness, 1.5}, HuntCrossley{d.alpha}}});
  return m;
}

}  // namespace yoke::tests
