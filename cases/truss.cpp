// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A shallow truss of von Mises: two bars that springs stand for, from supports to a node between
// and above them, which a load presses down until it snaps through. With L the bars' free length,
//   load = 2 k y (L / sqrt(b^2 + y^2) - 1),   largest at b^2 + y^2 = (L b^2)^(2/3)
#include <cmath>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/prismatic.hpp>

namespace yoke::cases {

namespace {

Model model_of(const Parameters& p) {
  const double b = p.number("half_span"), h = p.number("height"), load = p.number("load");
  Model m;
  const BodyId node =
      m.add(Body{.name = "node", .mass = 1.0, .inertia = 0.01 * b * b, .pose = {{0.0, h}, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = node, .along = {0.0, 1.0}});
  for (const bool left : {true, false})
    m.add(TranslationalSpring{.name = left ? "left" : "right",
                              .a = ground,
                              .b = node,
                              .at_a = {left ? -b : b, 0.0},
                              .at_b = {0.0, h},
                              .stiffness = p.number("stiffness"),
                              .damping = p.number("damping")});
  m.add(AppliedForce{.name = "load", .body = node, .at = {0.0, h}, .force = [load](double) {
                       return Vec2(0.0, -load);
                     }});
  return m;
}

}  // namespace

Case truss_case() {
  return {.name = "truss",
          .group = "linkages",
          .description = "a shallow truss of two elastic bars that snaps through",
          .parameters = {{.name = "half_span",
                          .quantity = Quantity::length,
                          .default_text = "1000mm",
                          .low = 1e-3,
                          .high = 100.0,
                          .description = "from a support to the middle"},
                         {.name = "height",
                          .quantity = Quantity::length,
                          .default_text = "200mm",
                          .low = 1e-6,
                          .high = 100.0,
                          .description = "of the node over the supports, without load"},
                         {.name = "stiffness",
                          .quantity = Quantity::number,
                          .default_text = "5000",
                          .low = 1e-6,
                          .high = 1e12,
                          .description = "of a bar, in N/m"},
                         {.name = "damping",
                          .quantity = Quantity::number,
                          .default_text = "10",
                          .low = 0.0,
                          .high = 1e9,
                          .description = "of a bar, in N s/m"},
                         {.name = "load",
                          .quantity = Quantity::number,
                          .default_text = "20",
                          .low = -1e12,
                          .high = 1e12,
                          .description = "downwards, in N"}},
          .default_output = "results/truss",
          .model = [](const Parameters& p, const WallLaws&) { return model_of(p); },
          .duration = [](const Parameters&) { return 5.0; },
          // The place of the node is known to the tolerance times the size of the truss, and so is
          // the work of its load.
          .checks =
              [](const Parameters& p, const Model&, const Result& run) {
                return std::vector{
                    energy_check(run, std::abs(p.number("load")) * run.summary.length_scale)};
              }};
}

}  // namespace yoke::cases
