// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in docs/numerics.md, block by block; numerics_test.cpp compares and runs it.
#pragma once

#include <fmt/format.h>

#include <string>

#include <yoke/core/control/event_function.hpp>
#include <yoke/core/units.hpp>
#include <yoke/integrators/analyses/verify.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/revolute.hpp>

namespace numerics {

using namespace yoke;
using namespace yoke::literals;

/// A rod of 1 m that falls from the horizontal, and a spring it stretches.
inline Model bench() {
  Model m;
  const BodyId rod =
      m.add(Body{.name = "rod", .mass = 1.0_kg, .inertia = 1.0 / 12.0, .pose = {{0.5, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = rod, .at = {0.0, 0.0}});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = rod,
                            .at_a = {1.0, 0.5},
                            .at_b = {1.0, 0.0},
                            .stiffness = 2.0_N_per_m});
  m.add(Gravity{});
  return m;
}

inline std::string which_and_why(const Model& m) {
  const Result run = simulate(m, {.until = 2.0, .relative_tolerance = 1e-9});
  return fmt::format("{}: {}", run.summary.formulation, run.summary.formulation_reason);
}

inline double digits_of_the_angle(const Model& m) {
  const SimulationOptions options{.until = 2.0, .relative_tolerance = 1e-9};
  const Result run = simulate(m, options);
  const Verification check = verify(m, options, run);  // by another formulation
  for (const Agreement& a : check.quantities)
    if (a.column == "rod.angle_rad") return a.digits;
  return 0.0;
}

inline Result with_events(Model m) {
  const BodyId rod = m.find_body("rod");
  m.add(EventFunction{.name = "upright",
                      .function = [rod](const Motion& at) { return at[rod].angle + 90.0_deg; },
                      .crossing = Crossing::downwards,
                      .set = {{"spring.stiffness", 8.0}}});
  m.add(EventFunction{.name = "turning point",
                      .function = [rod](const Motion& at) { return at[rod].omega; },
                      .crossing = Crossing::upwards,
                      .action =
                          [](const EventAction& a) {
                            if (a.motion.t > 1.0) a.stop();
                          }});
  return simulate(m, {.until = 60.0});
}

inline Result long_run(const Model& m, const std::string& folder) {
  return simulate(m, {.until = 60.0, .checkpoints = {.folder = folder, .every = 1.0}});
}

inline Result after_a_kill(const Model& m, const std::string& folder) { return resume(m, folder); }

}  // namespace numerics
