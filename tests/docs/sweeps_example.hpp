// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in docs/sweeps.md.
#pragma once

#include <filesystem>
#include <string>

#include <yoke/yoke.hpp>

namespace sweeps_example {

using namespace yoke;
using namespace yoke::literals;

// A ball dropped on a floor: the largest force of its first impact, and the speed with which it leaves.
Model dropped(double height, double restitution) {
  Model m;
  const Vec2 start{0.0, 20.0_mm + height};
  const BodyId ball =
      m.add({.name = "ball", .mass = 0.1_kg, .inertia = 2e-5_kg_m2, .pose = {start, 0.0}});
  m.add(Gravity{});
  m.add(DiscOnCurve{.name = "floor",
                    .disc = {ball, start, 20.0_mm},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = ContactLaw{PowerLaw{1e9, 1.5}, Flores{.e = restitution}}});
  return m;
}

StudyOutcome drop(const StudyPoint& point) {
  const Model m = dropped(point["height"], point["e"]);
  const Result run = simulate(m, {.until = 0.2_s, .samples = 201, .contact_rows = 20});
  if (!run.summary.ok()) return {.failure = run.summary.reason};
  const Table rows = run.samples.merged(run.contact_samples);
  return {.values = {rows["floor.normal_force_N"].maxCoeff(), -run.events.at(1).speed}};
}

StudyResult drops(const std::filesystem::path& folder) {
  const StudyPoints points =
      grid_points({log_axis("height", 1.0_mm, 100.0_mm, 5, "m"), linear_axis("e", 0.6, 0.9, 4)});
  const std::vector<StudyQuantity> quantities = {{"peak_force", "N"}, {"release_speed", "m/s"}};
  StudyResult study = run_study(points, quantities, drop, {.jobs = 2, .folder = folder});
  study.write_csv(folder / "drops.csv");
  return study;  // study.table()["peak_force_N"], study.rows[3].reason, ...
}

}  // namespace sweeps_example
