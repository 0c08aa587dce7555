// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/fmu/fmu_instance.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

constexpr double durations_without_stop = 1000.0;
constexpr double rounding_of_time = 1e-9;  // of a step: sums of steps are not exact

bool is_parameter(FmuRole role) { return role == FmuRole::tunable || role == FmuRole::input; }

}  // namespace

FmuInstance::FmuInstance(FmuDescription description)
    : description_(std::move(description)), variables_(fmu_variables(description_)) {
  reset();
}

void FmuInstance::reset() {
  values_.clear();
  for (const FmuVariable& v : variables_) values_.push_back(v.start);
  run_.reset();
  stepped_ = ended_early_ = false;
}

void FmuInstance::set_up(double start, std::optional<double> stop,
                         std::optional<double> tolerance) {
  start_ = start;
  stop_ = stop;
  tolerance_ = tolerance;
  run_.reset();
}

const FmuVariable& FmuInstance::variable(unsigned reference) const {
  if (reference < variables_.size()) return variables_[reference];
  throw ModelError(fmt::format("value reference = {} must be less than {}, the number of variables",
                               reference, variables_.size()));
}

Simulation& FmuInstance::run() {
  if (run_) return *run_;
  Parameters parameters = fmu_parameters(description_);
  for (std::size_t i = 0; i < variables_.size(); ++i)
    if (variables_[i].role == FmuRole::fixed && values_[i] != variables_[i].start)
      parameters.set(variables_[i].case_parameter, exactly(values_[i]) + variables_[i].unit);
  model_ = std::make_unique<Model>(fmu_model(description_, parameters));
  State state = model_->start_state();
  state.t = start_;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    if (!is_parameter(variables_[i].role)) continue;
    if (variables_[i].name != model_->parameters().at(variables_[i].index).name())
      throw ModelError("with these parameters of the case the model has other variables");
    // What nobody has set is what the case says with the parameters it has now.
    if (values_[i] != variables_[i].start) state.parameters[variables_[i].index] = values_[i];
  }
  model_->check_parameters(state.parameters);
  const double duration = fmu_duration(description_, parameters);
  run_.emplace(
      *model_, state,
      SimulationOptions{.until = stop_.value_or(start_ + durations_without_stop * duration),
                        .relative_tolerance = tolerance_.value_or(description_.relative_tolerance),
                        .samples = 0});
  for (const FmuVariable& v : variables_)
    if (v.role == FmuRole::output && run_->find_output(v.name) != v.index)
      throw ModelError("with these parameters of the case the model has other variables");
  return *run_;
}

double FmuInstance::get(unsigned reference) {
  const FmuVariable& v = variable(reference);
  if (v.role == FmuRole::output) return run().output(v.index);
  // The speed of a driver may have changed by its acceleration.
  return is_parameter(v.role) && run_ ? run_->get(v.name) : values_[reference];
}

void FmuInstance::set(unsigned reference, double value) {
  const FmuVariable& v = variable(reference);
  if (v.role == FmuRole::output)
    throw ModelError(fmt::format("'{}' is an output and cannot be set", v.name));
  require_range(v.name, "value", value, v.low, v.high, v.unit);
  if (v.role == FmuRole::fixed) {
    if (stepped_) throw ModelError(fmt::format("'{}' is fixed once the run has begun", v.name));
    run_.reset();
  } else if (stepped_) {
    run().set(v.name, value);
  } else {
    run_.reset();  // the start is assembled with it
  }
  values_[reference] = value;
}

double FmuInstance::time() { return run().time(); }

bool FmuInstance::do_step(double t, double step) {
  Simulation& simulation = run();
  const double slack = rounding_of_time * step;
  if (!(step >= 0.0) || !std::isfinite(step))
    throw ModelError(fmt::format("communication step size = {:g} s must not be negative", step));
  if (std::abs(t - simulation.time()) > slack)
    throw ModelError(fmt::format("communication point = {:.17g} s: the FMU is at {:.17g} s", t,
                                 simulation.time()));
  double end = t + step;
  if (std::abs(end - simulation.end_time()) <= slack) end = simulation.end_time();
  stepped_ = true;
  if (simulation.advance_to(std::max(end, simulation.time()))) return true;
  ended_early_ = true;
  if (simulation.summary().stop == Stop::by_event) return false;
  throw ModelError(simulation.summary().reason);
}

FmuInstance::Kept FmuInstance::keep() { return {.values = values_, .snapshot = run().snapshot()}; }

void FmuInstance::restore(const Kept& kept) {
  if (kept.values.size() != values_.size())
    throw ModelError("this state is of another FMU: it has other variables");
  bool same_model = true;
  for (std::size_t i = 0; i < values_.size(); ++i)
    same_model =
        same_model && (variables_[i].role != FmuRole::fixed || values_[i] == kept.values[i]);
  if (!same_model) run_.reset();
  values_ = kept.values;
  run().restore(kept.snapshot);
  stepped_ = kept.snapshot.state.t > start_;
  ended_early_ = false;
}

std::vector<std::uint8_t> FmuInstance::to_bytes(const Kept& kept) {
  return nlohmann::json::to_cbor(
      {{"values", kept.values},
       {"snapshot", nlohmann::json::binary(yoke::to_bytes(kept.snapshot))}});
}

FmuInstance::Kept FmuInstance::from_bytes(std::span<const std::uint8_t> bytes) {
  try {
    const auto json = nlohmann::json::from_cbor(bytes.begin(), bytes.end());
    return {.values = json.at("values").get<std::vector<double>>(),
            .snapshot = snapshot_from_bytes(json.at("snapshot").get_binary())};
  } catch (const nlohmann::json::exception& error) {
    throw ModelError(fmt::format("these bytes are not a state of an FMU: {}", error.what()));
  }
}

/// Central differences in a copy of the run: exact for what depends on a load or a speed as on its
/// square at most, so the change need not be small there.
std::vector<double> FmuInstance::derivative(std::span<const unsigned> unknowns,
                                            std::span<const unsigned> knowns,
                                            std::span<const double> seed) {
  std::vector<double> sum(unknowns.size(), 0.0);
  for (const unsigned u : unknowns)
    if (variable(u).role != FmuRole::output)
      throw ModelError(fmt::format("directional derivative: '{}' is no output", variable(u).name));
  for (std::size_t k = 0; k < knowns.size(); ++k) {
    const FmuVariable& known = variable(knowns[k]);
    if (!is_parameter(known.role))
      throw ModelError(fmt::format("directional derivative: '{}' is no input", known.name));
    const double value = run().get(known.name);
    const double size = known.role == FmuRole::input ? 1e-2 * std::max(1.0, std::abs(value))
                                                     : 6e-6 * std::max(1e-6, std::abs(value));
    std::vector<double> at[2];
    for (int side = 0; side < 2; ++side) {
      Simulation there = run().fork();
      there.set(known.name, value + (side == 0 ? size : -size));
      for (const unsigned u : unknowns) at[side].push_back(there.output(variable(u).index));
    }
    for (std::size_t u = 0; u < unknowns.size(); ++u)
      sum[u] += seed[k] * (at[0][u] - at[1][u]) / (2.0 * size);
  }
  return sum;
}

}  // namespace yoke::cases
