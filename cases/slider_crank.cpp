// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// An ideal slider-crank driven at constant speed: something to try the analyses on.
#include <cmath>

#include <yoke/cases/jobs/model_job.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

Model model_of(const Parameters& p) {
  const double r = p.number("crank"), l = p.number("rod"), omega = p.number("speed") * pi / 30.0;
  if (!(l > r))
    throw ModelError(fmt::format(
        "slider_crank: rod = {:g} mm must be longer than the crank, {:g} mm", 1e3 * l, 1e3 * r));
  Model m;
  const double rate = -omega * r / l;
  const BodyId crank = m.add({.name = "crank",
                              .mass = 0.30,
                              .inertia = 1e-5,
                              .pose = {{0.5 * r, 0.0}, 0.0},
                              .twist = {{0.0, 0.5 * r * omega}, omega}});
  const BodyId rod = m.add({.name = "rod",
                            .mass = 0.21,
                            .inertia = 2.5e-5,
                            .pose = {{r + 0.5 * l, 0.0}, 0.0},
                            .twist = {{0.0, r * omega + 0.5 * l * rate}, rate}});
  const BodyId slider =
      m.add({.name = "slider", .mass = 0.14, .inertia = 1e-4, .pose = {{r + l, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "crank pin", .a = crank, .b = rod, .at = {r, 0.0}});
  m.add(Revolute{.name = "slider pin", .a = rod, .b = slider, .at = {r + l, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(0.0, omega)});
  return m;
}

}  // namespace

Case slider_crank_case() {
  return {.name = "slider_crank",
          .description = "an ideal slider-crank, driven at constant speed",
          .parameters = {{.name = "crank",
                          .quantity = Quantity::length,
                          .default_text = "50mm",
                          .low = 1e-3,
                          .high = 1.0,
                          .description = "length of the crank"},
                         {.name = "rod",
                          .quantity = Quantity::length,
                          .default_text = "120mm",
                          .low = 1e-3,
                          .high = 10.0,
                          .description = "length of the connecting rod, longer than the crank"},
                         {.name = "speed",
                          .quantity = Quantity::number,
                          .default_text = "5000",
                          .low = 1e-3,
                          .high = 1e5,
                          .description = "of the crank, in revolutions per minute"}},
          .laws = {},
          .default_output = "results/slider_crank",
          .model = [](const Parameters& p, std::string_view) { return model_of(p); },
          .run =
              [](const RunRequest& r) {
                return run_model(model_of(r.parameters), 120.0 / r.parameters.number("speed"), r);
              }};
}

}  // namespace yoke::cases
