// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/recovery.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/integrators/analyses/details/stored_rows.hpp>
#include <yoke/integrators/run/recorder.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>

namespace yoke {

namespace {

constexpr double allowed_in_rows = 1e-8;  // in length scales or rad

Recovery recover_with(Dynamics& dynamics, const State& given, const State& zero) {
  System& system = dynamics.system();
  State state = given;
  system.bind(state);
  system.set_motion(state.t, state.q.data(), state.v.data());
  std::vector<double> phi(static_cast<std::size_t>(system.rows()));
  system.calc_position_level(phi.data());
  int worst = 0;
  const double norm = system.norm(phi.data(), &worst);
  if (!(norm <= allowed_in_rows))
    throw ModelError(fmt::format(
        "recovery: the state at t = {:.9g} s violates '{}' by {:g} {}: assemble it first", state.t,
        system.equation_name(worst), phi[static_cast<std::size_t>(worst)],
        system.measure(worst) == Measure::length ? "m" : "rad"));
  // The state stays as it is, but for a singular position, where only project() has an answer.
  if (!dynamics.calc_accelerations(state) && !dynamics.project(state))
    throw ModelError(
        fmt::format("recovery: accelerations at t = {:.9g} s are not finite", state.t));
  Result result;
  Recorder recorder(dynamics, result, 1);
  recorder.start(zero);
  system.bind(state);
  recorder.record(state);
  return {std::move(state), std::move(result.samples)};
}

}  // namespace

Recovery recover(const Model& model, const State& state) {
  check_model(model);
  check_state(model, state);
  Dynamics dynamics(model);
  prepare_for_rows(dynamics, state);
  State zero = model.start_state();
  dynamics.project(zero);
  return recover_with(dynamics, state, zero);
}

State stored_state(const Model& model, const Table& samples, double t) {
  return recover(model, samples, t).state;
}

Recovery recover(const Model& model, const Table& samples, double t) {
  check_model(model);
  Dynamics dynamics(model);
  prepare_for_rows(dynamics, model.start_state());
  const StoredRows rows(dynamics, samples);
  State state = model.start_state(), zero = state;
  rows.read(0, zero);
  rows.interpolate(t, state);
  bool stored = false;
  for (std::size_t i = 0; i < rows.count() && !stored; ++i) stored = rows.time(i) == state.t;
  if (!stored && !dynamics.project(state))
    throw ModelError(
        fmt::format("recovery: the state at t = {:.9g} s cannot be projected on the joints", t));
  return recover_with(dynamics, state, zero);
}

}  // namespace yoke
