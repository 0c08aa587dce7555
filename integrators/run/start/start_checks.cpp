// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/start/start_checks.hpp>

#include <fmt/ranges.h>

#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include <yoke/core/equations/linear/linear_solver.hpp>
#include <yoke/integrators/formulations/explicit/explicit_pairs.hpp>
#include <yoke/integrators/run/checkpoint_schedule.hpp>
#include <yoke/integrators/run/fingerprint.hpp>

namespace yoke {

namespace {

// A schedule without a folder, or a folder without a schedule, would be passed over in silence.
void check_checkpoints(const Checkpoints& c) {
  require_not_negative("simulation", "checkpoints.every", c.every, "s");
  if (c.every_events < 0)
    throw ModelError(fmt::format("simulation: checkpoints.every_events = {} must be at least 0",
                                 c.every_events));
  const bool scheduled = c.every > 0.0 || c.every_events > 0;
  if (c.folder.empty() && scheduled)
    throw ModelError(fmt::format(
        "simulation: checkpoints.folder is empty, but one is to be written every {}: "
        "name the folder",
        c.every > 0.0 ? in_unit(c.every, "s") : fmt::format("{} events", c.every_events)));
  if (c.folder.empty() && c.resume)
    throw ModelError("simulation: checkpoints.folder is empty: there is nothing to resume from");
  if (!c.folder.empty() && !scheduled)
    throw ModelError(
        fmt::format("simulation: checkpoints.folder is '{}', but neither checkpoints.every [s] nor "
                    "checkpoints.every_events is greater than 0: none would be written",
                    c.folder.string()));
}

void check_order(int order) {
  if (order == 0) return;
  std::string known = "0 (what costs less)";
  for (const ExplicitPair& pair : explicit_pairs()) {
    if (pair.order == order) return;
    known += fmt::format(", {}", pair.order);
  }
  throw ModelError(fmt::format("simulation: order = {} must be one of {}", order, known));
}

}  // namespace

void check_options(const SimulationOptions& options, double t_start) {
  require_finite("simulation", "until", options.until);
  if (!(options.until > t_start))
    throw ModelError(fmt::format("simulation: until = {:g} s must be later than the start, {:g} s",
                                 options.until, t_start));
  require_range("simulation", "relative_tolerance", options.relative_tolerance, 1e-13, 1e-2);
  require_range("simulation", "spectral_radius", options.spectral_radius, 0.0, 0.999);
  check_order(options.order);
  linear_solver_named(options.linear_solver);
  if (options.samples != 0 && options.samples < 2)
    throw ModelError(
        fmt::format("simulation: samples = {} must be 0 (none) or at least 2", options.samples));
  if (options.contact_rows < 0)
    throw ModelError(fmt::format("simulation: contact_rows = {} must be 0 (none) or greater",
                                 options.contact_rows));
  check_checkpoints(options.checkpoints);
  check_checkpoint_interval(options.checkpoints.every, options.until - t_start);
  const std::tuple<const char*, double, const char*> sizes[] = {
      {"length_scale", options.length_scale, "m"},
      {"time_scale", options.time_scale, "s"},
      {"baumgarte_rate", options.baumgarte_rate, "1/s"}};
  for (const auto& [name, value, unit] : sizes)
    require_not_negative("simulation", name, value, unit);
}

void check_model(const Model& model) {
  if (model.body_count() == 0)
    throw ModelError("the model has no bodies: there is nothing to move");
  for (const auto& force : model.forces()) force->check(model);
}

void check_state(const Model& model, const State& start) {
  const State own = model.start_state();
  const auto check = [](const char* what, auto given, auto expected) {
    if (given != expected)
      throw ModelError(
          fmt::format("the start state is not of this model: it has {} {}, the model {}", given,
                      what, expected));
  };
  check("positions", start.q.size(), own.q.size());
  check("velocities", start.v.size(), own.v.size());
  check("element states", start.z.size(), own.z.size());
  check("accelerations", start.a.size(), own.a.size());
  check("multipliers", start.lambda.size(), own.lambda.size());
  check("energies", start.energy.size(), own.energy.size());
  check("parameters", start.parameters.size(), own.parameters.size());
  check("contacts", start.contacts.size(), own.contacts.size());
  require_finite("start state", "t", start.t);
  for (const Eigen::VectorXd* values : {&start.q, &start.v, &start.z})
    for (const double x : *values)
      require_finite("start state", "a position, velocity or state", x);
  model.check_parameters(start.parameters);
}

void check_checkpoint(const Model& model, const SimulationOptions& options, const Checkpoint& c) {
  if (fingerprint(model) != c.model)
    throw ModelError(
        fmt::format("the checkpoint in '{}' is of another model: bodies, joints, "
                    "forces, parameters or start pose differ",
                    options.checkpoints.folder.string()));
  const auto same = [&](const char* name, auto asked, auto stored) {
    if (asked != stored)
      throw ModelError(fmt::format("the checkpoint in '{}' is of a run with {} = {}, not {}",
                                   options.checkpoints.folder.string(), name, stored, asked));
  };
  same("until", options.until, c.until);
  same("relative_tolerance", options.relative_tolerance, c.relative_tolerance);
  if (options.formulation != "automatic") same("formulation", options.formulation, c.formulation);
  same("order", options.order, c.order);
  same("linear_solver", options.linear_solver, c.linear_solver);
  same("samples", options.samples, c.samples);
  same("contact_rows", options.contact_rows, c.contact_rows);
  same("columns", fmt::format("{}", fmt::join(options.columns, ",")),
       fmt::format("{}", fmt::join(c.chosen_columns, ",")));
  same("checkpoints.every", options.checkpoints.every, c.every);
  same("checkpoints.every_events", options.checkpoints.every_events, c.every_events);
}

namespace {

/// Is Phi_t of a driver the derivative of its Phi at time t? A difference of one size may be too
/// coarse for a fast driver or lost in rounding; a wrong rate fits none. What cannot be evaluated
/// is left to the run, which reports it with its time.
bool rate_fits(System& system, const ConstraintSlot& c, const State& state, double t, double span) {
  const auto rows = static_cast<std::size_t>(c.rows), columns = static_cast<std::size_t>(c.columns);
  std::vector<double> before(rows), after(rows), rate(rows), G(rows * columns), coordinates(rows);
  const auto evaluate = [&](double time, const ConstraintRequest& out) {
    system.set_motion(time, state.q.data(), state.v.data());
    system.evaluate(c, out);
  };
  const auto fits = [&](double h) {
    evaluate(t - h, {.phi = before.data()});
    evaluate(t + h, {.phi = after.data()});
    evaluate(t, {.phi_t = rate.data()});
    for (std::size_t i = 0; i < rows; ++i) {
      const double change = (after[i] - before[i]) / (2.0 * h);
      const double size = std::abs(after[i]) + std::abs(before[i]) + std::abs(t * rate[i]) +
                          2.0 * coordinates[i];  // what Phi is the difference of
      const double bound = 1e-3 * (std::abs(change) + std::abs(rate[i])) + 1e-15 * size / h;
      if (std::abs(change - rate[i]) > bound) return false;
    }
    return true;
  };
  try {
    evaluate(t, {.G = G.data()});
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j)
        if (const int dof = system.dof()[static_cast<std::size_t>(c.dofs) + j]; dof >= 0)
          coordinates[i] += std::abs(G[i * columns + j] * state.q[dof]);
    return fits(1e-6 * span) || fits(1e-8 * span) || fits(1e-10 * span);
  } catch (const std::exception&) {
    return true;
  }
}

}  // namespace

void check_drivers(System& system, const State& state, double until) {
  constexpr int probes = 5;
  const double span = until - state.t;
  for (const ConstraintSlot& c : system.constraints()) {
    if (!c.element->rheonomic()) continue;
    int wrong = 0;
    double t_wrong = 0.0;
    for (int i = 0; i < probes; ++i) {
      const double t = state.t + span * (0.07 + 0.19 * i);
      if (rate_fits(system, c, state, t, span)) continue;
      ++wrong;
      t_wrong = t;
    }
    if (wrong >= 2)  // one probe may have met a corner
      throw ModelError(
          fmt::format("driver '{}': its rate is not the derivative of its value, for "
                      "instance at t = {:g} s",
                      c.element->name(), t_wrong));
  }
}

}  // namespace yoke
