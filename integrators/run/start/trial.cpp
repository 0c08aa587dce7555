// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/singular/singular_crossing.hpp>
#include <yoke/integrators/run/start/error_weights.hpp>
#include <yoke/integrators/run/start/trial.hpp>

#include <algorithm>
#include <exception>

namespace yoke {

namespace {

constexpr double enough_steps = 1e6;  // last steps of the run that stopped
constexpr double short_way = 1e-6;    // of the time scale
constexpr int most_trial_steps = 2000;

}  // namespace

bool gets_on(const FormulationEntry& entry, Dynamics& dynamics, const State& there,
             const SimulationOptions& options, double last_step) {
  const double way =
      std::max(enough_steps * last_step, short_way * dynamics.system().scales().time);
  const double enough = std::min(options.until, there.t + way);
  double largest_independence = 0.0;
  try {
    State from = there;
    if (!dynamics.project(from)) return false;
    dynamics.reset();
    const auto trial = guard_singular_positions(
        entry, dynamics, choose_tolerances(dynamics.system(), from, options),
        [](const SingularPosition&) {}, largest_independence);
    trial->start(from);
    for (int i = 0; i < most_trial_steps; ++i) {
      const Step step = trial->step(options.until);
      if (step == Step::failed) return false;
      if (step == Step::event || trial->time() >= enough) return trial->time() > there.t;
    }
  } catch (const std::exception&) {
  }
  return false;
}

}  // namespace yoke
