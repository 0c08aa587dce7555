// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/request.hpp>

namespace yoke::cases {

SimulationOptions simulation_options(const RunRequest& request, double until, int samples,
                                     const std::filesystem::path& folder) {
  SimulationOptions options;
  options.until = until;
  options.relative_tolerance = request.relative_tolerance;
  options.formulation = request.formulation;
  options.samples = samples;
  options.order = request.order;
  options.linear_solver = request.linear_solver;
  if (request.spectral_radius) options.spectral_radius = *request.spectral_radius;
  if (request.checkpoint_every > 0.0 || request.checkpoint_events > 0)
    options.checkpoints = {.folder = folder / "checkpoint",
                           .every = request.checkpoint_every,
                           .every_events = request.checkpoint_events,
                           .resume = request.resume};
  return options;
}

}  // namespace yoke::cases
