// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/linearised/carried_run.hpp>

#include <yoke/core/error.hpp>
#include <yoke/integrators/analyses/details/linearisation.hpp>
#include <yoke/integrators/engine/run.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>

namespace yoke {

Result run_with(CarriedVariation& variation, const Model& model, const State& start,
                const SimulationOptions& options) {
  if (!options.checkpoints.folder.empty())
    throw ModelError("variation: a run with variations writes no checkpoints");
  check_model(model);
  check_state(model, start);
  check_linearisable(model);
  Run run(model, start, options);
  run.watch(variation);
  run.begin();
  return run.finish_run();
}

}  // namespace yoke
