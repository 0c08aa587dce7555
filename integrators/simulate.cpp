// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/simulate.hpp>

#include <utility>

#include <yoke/integrators/run/checkpoint_schedule.hpp>
#include <yoke/integrators/simulation.hpp>

namespace yoke {

Result simulate(const Model& model, const State& start, const SimulationOptions& options) {
  return Simulation(model, start, options).finish();
}

Result simulate(const Model& model, const SimulationOptions& options) {
  return Simulation(model, options).finish();
}

Result resume(const Model& model, const std::filesystem::path& folder,
              std::function<bool(const Progress&)> observer) {
  const std::optional<Checkpoint> c = read_checkpoint(folder);
  if (!c)
    throw ModelError(fmt::format("there is no checkpoint in '{}' to go on from", folder.string()));
  SimulationOptions options = options_of(*c, folder);
  options.observer = std::move(observer);
  options.checkpoints.resume = true;
  return Simulation(model, options).finish();
}

State assembled_state(const Model& model) {
  Dynamics dynamics(model);
  State state = model.start_state();
  if (const Outcome outcome = dynamics.assemble(state); !outcome) throw ModelError(outcome.why);
  return state;
}

}  // namespace yoke
