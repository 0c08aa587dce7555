// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A marble slides in a curved slot without friction: a pendulum whose string is the lower wall.
#include <cmath>
#include <cstdio>
#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/units.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/forces/gravity.hpp>

using namespace yoke;
using namespace yoke::literals;

int main() {
  const double radius = 300_mm, swing = 20_deg;  // of the marble's centre on the lower wall
  const Vec2 start = rotate(swing, {0.0, -radius});
  Model m;
  const BodyId marble =
      m.add({.name = "marble", .mass = 5_g, .inertia = 0.1_kg_mm2, .pose = {.position = start}});
  m.add(Gravity{});
  m.add(PinInSlot{.name = "slot",
                  .pin = {marble, start, 8_mm},
                  .slot = {ground, arc_slot({.radius = radius - 0.1_mm,
                                             .direction = -90_deg,
                                             .angle = 120_deg,
                                             .half_width = 8.1_mm})},
                  .law = ContactLaw{per_mm(3000, 1.5), HuntCrossley{.alpha = 0.3_s_per_m}}});
  // Period of a pendulum: 2 pi sqrt(L/g) (1 + a^2/16 + 11 a^4/3072 + ...), a the amplitude.
  const double a2 = swing * swing;
  const double period =
      2.0 * pi * std::sqrt(radius / 9.81) * (1.0 + a2 / 16.0 + 11.0 / 3072.0 * a2 * a2);
  const Result run = simulate(m, {.until = period});
  const double missing = (run.final.q.head<2>() - start).norm();
  std::printf("%s after %.4f s: the marble is back within %.1f um\n", run.summary.reason.c_str(),
              run.summary.t_end, 1e6 * missing);
  return run.summary.ok() && missing < 0.1_mm ? 0 : 1;
}
