// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A tolerance that is accepted is reached, or as much of it as rounding allows.
#include <doctest/doctest.h>

#include <yoke/yoke.hpp>

using namespace yoke;

namespace {

// Two bodies held in parallel by rods, one pinned to the ground, with a driven angle between them;
// the pin of the second falls on a wall whose force begins like d^0.13: its rate has no bound there.
Model falls_on_a_steep_wall() {
  Model m;
  const BodyId arm = m.add(Body{.name = "arm",
                                .mass = 0.81,
                                .inertia = 7.599999999999999e-05,
                                .pose = {{-0.013000000000000001, -0.027}, 0.0}});
  const BodyId block = m.add(Body{.name = "block",
                                  .mass = 0.87,
                                  .inertia = 0.00011563011993865455,
                                  .pose = {{0.0063, -0.015}, 0.0}});
  m.add(Revolute{.name = "pin", .a = ground, .b = arm, .at = {-0.0081, -0.02}});
  m.add(Distance{.name = "rod 1",
                 .a = arm,
                 .b = block,
                 .at_a = {-0.021, -0.03},
                 .at_b = {0.015, -0.026000000000000002}});
  m.add(Distance{
      .name = "rod 2", .a = arm, .b = block, .at_a = {-0.017, -0.023}, .at_b = {0.013, -0.023}});
  m.add(AngleDriver{.name = "motor",
                    .body = arm,
                    .relative_to = block,
                    .angle = time_function([](auto t) {
                      return 0.0 + 0.0 * t + 0.27 * (1.0 - cos(3.4000000000000004 * t));
                    })});
  m.add(TorsionalSpring{.name = "coil", .a = arm, .b = block, .stiffness = 0.004716368884756705});
  const double radius = 9.758895222643302e-4, half_width = 1.2804223366142202e-3;
  m.add(PinInSlot{
      .name = "slot",
      .pin = {block, {-3.3877378555273365e-05, -0.011724035808660768}, radius},
      .slot = {ground, arc_slot({.center = {-0.004891746623150549, -0.03370359167774897},
                                 .radius = 0.022558035907947194,
                                 .direction = 1.8319160129209342,
                                 .angle = 1.9551256482549055,
                                 .half_width = half_width})},
      .law = SlotLaws(ContactLaw{
          make_elastic("pereira-2015", {.pin = {9830727988.482168, 0.3},
                                        .wall = {9830727988.482168, 0.3},
                                        .pin_radius = radius,
                                        .wall_radius = half_width,
                                        .conformity = Conformity::internal,
                                        .length = 0.0015793681301211819,
                                        .reading = Reading::printed}),
          make_dissipative("exact-restitution", {.restitution = 0.6069854813002755,
                                                 .slowest_approach = 2.4029409580168597e-4,
                                                 .q = 3.733351279127494,
                                                 .epsilon = 0.1})}),
      .reference_force = 6.693738349072916});
  return m;
}

}  // namespace

TEST_CASE("BDF passes an onset whose rate of force has no bound at the tightest tolerance") {
  const Model m = falls_on_a_steep_wall();
  const auto run = [&](double rtol, const char* formulation) {
    return simulate(
        m, {.until = 0.18968690040703123, .relative_tolerance = rtol, .formulation = formulation});
  };
  const Result tight = run(1e-13, "ida-ggl"), other = run(1e-13, "arkode-projection");
  REQUIRE_MESSAGE(tight.summary.ok(), tight.summary.reason);
  REQUIRE(tight.summary.events > 0);
  CHECK(tight.summary.tolerance_kept == 0.0);  // and none of it had to be given up
  CHECK((tight.final.q - other.final.q).cwiseAbs().maxCoeff() < 1e-9);
}
