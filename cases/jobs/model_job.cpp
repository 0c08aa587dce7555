// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <fmt/ranges.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include <yoke/cases/jobs/model_job.hpp>
#include <yoke/cases/jobs/progress.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

void print_verification(const std::string& law, const Verification& v) {
  fmt::print("\n{}: digits that agree with {} at a tolerance of {:g}\n", law, v.formulation,
             v.relative_tolerance);
  if (!v.summary.ok()) fmt::print("  it did not complete: {}\n", v.summary.reason);
  constexpr double as_good_as_equal = 12.0;
  long equal = 0;
  for (const Agreement& a : v.quantities) {
    if (a.digits > as_good_as_equal)
      ++equal;
    else
      fmt::print("  {:<32} {:>5.1f}   largest difference {:.1e} of {:.3g}\n", a.column, a.digits,
                 a.difference, a.peak);
  }
  fmt::print("  {:<32} {:>5.0f} or more\n", fmt::format("{} others", equal), as_good_as_equal);
  if (v.same_events)
    fmt::print("  {:<32} all {}, their times within {:.1e} s\n", "events", v.events,
               v.event_time_difference);
  else
    fmt::print("  {:<32} differ: {} and {}\n", "events", v.events, v.other_events);
}

namespace {

void write_verification(const RunRequest& request, const Verification& v) {
  std::ifstream file(request.output / "summary.json");
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(file);
  json["verification"] = nlohmann::ordered_json::parse(to_json(v));
  write_text(request.output / "summary.json", json.dump(2));
  print_verification(request.output.filename().string(), v);
}

}  // namespace

RunStatus run_model(const Model& model, double until, const RunRequest& request) {
  make_output_folder(request.output);
  ProgressLine progress({request.output.filename().string()});
  SimulationOptions options = simulation_options(request, until, request.samples, request.output);
  if (options.formulation.empty()) options.formulation = "automatic";
  options.observer = progress.observer(0);
  const Result run = simulate(model, options);
  run.write(request.output);
  if (request.verify && run.summary.ok()) write_verification(request, verify(model, options, run));
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
