// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// One instance of an FMU: values of its variables, and the run once it is needed. Until the first step
// fixed parameters may change, which makes the model anew. All members throw ModelError, with
// variable, value and range.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <yoke/cases/fmu/fmu_variables.hpp>
#include <yoke/integrators/simulation.hpp>

namespace yoke::cases {

class FmuInstance {
 public:
  explicit FmuInstance(FmuDescription description);

  /// Before the first value is read. No end: a thousand times the case's duration.
  void set_up(double start, std::optional<double> stop, std::optional<double> tolerance);
  double get(unsigned reference);
  void set(unsigned reference, double value);
  /// From `t` by `step` [s]. False if the run ends before, by an event.
  bool do_step(double t, double step);
  double time();
  bool ended_early() const { return ended_early_; }
  void reset();

  /// What get() and do_step() depend on: the run and the values that were set.
  struct Kept {
    std::vector<double> values;
    Snapshot snapshot;
  };
  Kept keep();
  void restore(const Kept& kept);
  static std::vector<std::uint8_t> to_bytes(const Kept& kept);
  static Kept from_bytes(std::span<const std::uint8_t> bytes);

  /// d unknowns / d knowns times `seed`, at the present instant, the state held: outputs by inputs and
  /// tunable parameters.
  std::vector<double> derivative(std::span<const unsigned> unknowns,
                                 std::span<const unsigned> knowns, std::span<const double> seed);

 private:
  const FmuVariable& variable(unsigned reference) const;
  Simulation& run();

  FmuDescription description_;
  std::vector<FmuVariable> variables_;
  std::vector<double> values_;  // of all but outputs
  double start_ = 0.0;
  std::optional<double> stop_, tolerance_;
  std::unique_ptr<Model> model_;
  std::optional<Simulation> run_;
  bool stepped_ = false, ended_early_ = false;
};

}  // namespace yoke::cases
