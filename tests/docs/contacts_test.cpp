// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <yoke/tests/docs/contacts_example.hpp>
#include <yoke/tests/documentation.hpp>

TEST_CASE("the code in docs/contacts.md is compiled here and does what it says") {
  yoke::tests::check_blocks("docs/contacts.md", "cpp", 7, {"tests/docs/contacts_example.hpp"});

  using namespace yoke;
  using namespace yoke::contacts_example;
  const ContactLaw law{per_mm(49070, 1.10), HuntCrossley{0.3}};
  CHECK(cam_through({{0.03, 0.0}, {0.0, 0.03}, {-0.03, 0.0}, {0.0, -0.035}}).closed());
  CHECK(wave().length() > 0.2);
  const Result latched = simulate(latch(law), {.until = 0.05, .samples = 11});
  CHECK(latched.summary.ok());
  CHECK(!latched.events.empty());

  Model balls;
  const BodyId ball = balls.add({.name = "ball",
                                 .mass = 0.03,
                                 .inertia = 1e-6,
                                 .pose = {{0.0, 10.0_mm}, 0.0},
                                 .twist = {{0.5, 0.0}, 0.0}});
  const BodyId other = balls.add(
      {.name = "other", .mass = 0.03, .inertia = 1e-6, .pose = {{25.0_mm, 10.0_mm}, 0.0}});
  add_contacts(balls, ball, other, law);
  const Result hit = simulate(balls, {.until = 0.1, .relative_tolerance = 1e-9, .samples = 11});
  CHECK(hit.summary.ok());
  CHECK(hit["other.vx_m_per_s"](10) > 0.4);
  CHECK(hit["other.x_m"](10) > 50.0_mm);  // beyond the step

  const SimulationOptions options{.until = 0.3, .relative_tolerance = 1e-8, .samples = 31};
  const Result without = simulate(ideal(), options), with = simulate(real(law), options);
  CHECK(without.summary.ok());
  CHECK(with.summary.ok());
  CHECK((with["slider.x_m"] - without["slider.x_m"]).cwiseAbs().maxCoeff() < 0.3_mm);

  const PinInSlot arc{
      .name = "slot",
      .pin = {ball, {60.0_mm, 0.0}, 7.9_mm},
      .slot = {ground, arc_slot({.radius = 60.0_mm, .angle = 2.0, .half_width = 8.0_mm})},
      .law = by_radius(7.9_mm)};
  CHECK(arc.build(balls)->penetration_scale() > 0.0);
  double scales[2] = {};
  for (const Radii radii : {Radii::local, Radii::mean})
    scales[radii == Radii::mean ? 1 : 0] =
        roller_on_cam(ball, ground, {48.0_mm, 0.0}, radii).build(balls)->penetration_scale();
  CHECK(scales[1] > 0.0);
  CHECK(scales[0] > 0.5 * scales[1]);
  CHECK(scales[0] < 2.0 * scales[1]);
}
