// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A coupler on parallel cranks, more of them than it needs: an over-closed mechanism to look at.
#include <yoke/cases/case.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

Model model_of(const Parameters& p) {
  const int cranks = p.whole("cranks");
  const double length = 1.0, radius = 0.3, angle = 1.1, omega = 4.0;
  const Vec2 up = rotate(angle, {radius, 0.0});
  Model m;
  const BodyId coupler = m.add({.name = "coupler",
                                .mass = 2.0,
                                .inertia = 2.0 / 12.0,
                                .pose = {up + Vec2(0.5 * length, 0.0), 0.0},
                                .twist = {omega * perp(up), 0.0}});
  for (int i = 1; i <= cranks; ++i) {
    // The ends first, the others between them.
    const double x = i == 1 ? 0.0 : i == 2 ? length : length * (i - 2) / (cranks - 1);
    const std::string name = "crank " + std::to_string(i);
    const BodyId crank = m.add({.name = name,
                                .mass = 0.5,
                                .inertia = 0.5 * radius * radius / 12.0,
                                .pose = {Vec2(x, 0.0) + 0.5 * up, angle},
                                .twist = {0.5 * omega * perp(up), omega}});
    m.add(Revolute{.name = name + " foot", .a = ground, .b = crank, .at = {x, 0.0}});
    m.add(Revolute{.name = name + " tip", .a = coupler, .b = crank, .at = Vec2(x, 0.0) + up});
  }
  m.add(Gravity{});
  return m;
}

}  // namespace

Case parallelogram_case() {
  return {.name = "parallelogram",
          .description = "a coupler on three parallel cranks or more: over-closed",
          .parameters = {{.name = "cranks",
                          .quantity = Quantity::number,
                          .default_text = "3",
                          .low = 2.0,
                          .high = 50.0,
                          .whole = true,
                          .description = "parallel cranks; two are enough"}},
          .default_output = "results/parallelogram",
          .model = [](const Parameters& p, const WallLaws&) { return model_of(p); },
          .duration = [](const Parameters&) { return 2.0; }};
}

}  // namespace yoke::cases
