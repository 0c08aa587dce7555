// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <fmt/ranges.h>

#include <yoke/cases/model_job.hpp>
#include <yoke/cases/progress.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke::cases {

RunStatus run_model(const Model& model, double until, const RunRequest& request) {
  make_output_folder(request.output);
  ProgressLine progress({request.output.filename().string()});
  SimulationOptions options{.until = until,
                            .relative_tolerance = request.relative_tolerance,
                            .samples = request.samples,
                            .observer = progress.observer(0)};
  if (!request.formulation.empty()) options.formulation = request.formulation;
  const Result run = simulate(model, options);
  run.write(request.output);
  const Summary& s = run.summary;
  fmt::print("{}: {:g} of {:g} s in {} steps, energy balance {:.2g} J of {:.3g} J exchanged\n",
             s.reason, s.t_end, s.t_asked, s.steps, s.energy_balance, s.energy_exchanged);
  fmt::print("degrees of freedom: {}\n", s.degrees_of_freedom);
  if (!s.redundant_equations.empty())
    fmt::print("redundant, left out: {}\n", fmt::join(s.redundant_equations, ", "));
  if (!s.not_unique_reactions.empty())
    fmt::print("not unique, one possibility of many: {}\n",
               fmt::join(s.not_unique_reactions, ", "));
  for (const SingularPosition& p : s.singular_positions)
    fmt::print("singular position at t = {:.9g} s ('{}'), energy changed by {:.1e} J\n", p.t,
               p.equation, p.energy_after - p.energy_before);
  fmt::print("results in {}\n", request.output.string());
  if (s.stop == Stop::interrupted) return RunStatus::interrupted;
  return s.ok() ? RunStatus::completed : RunStatus::failed;
}

}  // namespace yoke::cases
