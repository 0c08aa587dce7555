// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Mechanisms of the benchmarks as cases of the program.
#include <string>
#include <utility>

#include <yoke/cases/benchmark_andrews.hpp>
#include <yoke/cases/benchmark_mechanisms.hpp>
#include <yoke/cases/jobs/model_job.hpp>

namespace yoke::cases {

namespace {

/// A mechanism without choices but the length of the run.
Case fixed(std::string name, std::string description, Model (*model)(),
           const std::string& duration) {
  const std::string folder = "results/" + name;
  return {.name = std::move(name),
          .description = std::move(description),
          .parameters = {{.name = "duration",
                          .quantity = Quantity::number,
                          .default_text = duration,
                          .low = 1e-3,
                          .high = 10000.0,
                          .description = "of the run, in seconds"}},
          .laws = {},
          .default_output = folder,
          .model = [model](const Parameters&, std::string_view) { return model(); },
          .run =
              [model](const RunRequest& r) {
                return run_model(model(), r.parameters.number("duration"), r);
              }};
}

}  // namespace

Case point_pendulum_case() {
  return fixed("point_pendulum", "IFToMM benchmark A01: a point mass on a massless rod",
               point_pendulum, "10");
}

Case double_pendulum_case() {
  return fixed("double_pendulum", "two uniform rods in a row, released horizontal", double_pendulum,
               "10");
}

Case andrews_case() {
  return fixed("andrews", "Andrews' squeezing mechanism: seven bodies, three closed loops", andrews,
               "0.03");
}

Case car_axis_case() {
  return fixed("car_axis", "car axis of the test set for IVP solvers: stiff springs, a rod",
               car_axis, "3");
}

}  // namespace yoke::cases
