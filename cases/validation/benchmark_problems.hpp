// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The benchmarks: a mechanism, what is known of its motion, and the error that is promised.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/cases/validation/andrews_reference.hpp>
#include <yoke/cases/validation/benchmark_reference.hpp>
#include <yoke/core/model.hpp>

namespace yoke::cases {

/// What the two best formulations must reach; NaN: no promise.
struct BenchmarkBars {
  double position = BenchmarkErrors::none;
  double velocity = BenchmarkErrors::none;
  double acceleration = BenchmarkErrors::none;
  double reaction = BenchmarkErrors::none;
  double energy = BenchmarkErrors::none;  // of the ledger, over the energy exchanged
  double period = BenchmarkErrors::none;
};

/// Largest differences, relative to each number itself.
BenchmarkErrors andrews_difference(const AndrewsState& state, const AndrewsState& expected);

struct Benchmark {
  std::string name;  // "double_pendulum"
  std::string title;
  std::string description;  // the problem, and where its reference is from
  std::function<Model()> model;
  double until = 0.0;  // [s]
  int samples = 101;
  BenchmarkBars bars;
  std::function<BenchmarkErrors(const Result&)> errors;
  /// Relative error of the period, if that is what is asked.
  std::function<double(const Result&)> period_error{};
  /// Error of positions against a better reference than that of the literature, for order and
  /// diagrams.
  std::function<double(const Result&)> finer_error{};
  /// Tolerances tried, from loose to tight. Empty: the usual ones of the formulation.
  std::function<std::vector<double>(std::string_view formulation)> tolerances{};
  double budget = 20.0;  // [s] of processor time for one run
  bool work_precision = false;
};

/// All, in the order of the document.
std::vector<Benchmark> benchmarks();

/// Throws ModelError that lists them.
const Benchmark& find_benchmark(const std::vector<Benchmark>& all, std::string_view name);

/// One run.
struct BenchmarkRun {
  std::string formulation;
  double tolerance = 0.0;
  BenchmarkErrors errors{};
  double finer_error =
      BenchmarkErrors::none;  // of positions; that of `errors` if there is no other
  double period_error = BenchmarkErrors::none;
  double energy = 0.0;          // largest error of the ledger over the energy exchanged
  double position_drift = 0.0;  // largest before projection [m, rad]
  double velocity_drift = 0.0;  // [m/s, rad/s]
  long steps = 0;
  /// How often the forces of the mechanism were evaluated to make the steps: by residuals and
  /// accelerations of any method alike, counted by an element in the model. Jacobians and
  /// projections are not among them.
  long evaluations = 0;
  long jacobians = 0;
  double time = 0.0;      // [s] of the processor, by this thread
  double reached = 0.0;   // [s]
  std::string trouble{};  // why it did not get to the end, "" if it did

  /// All that `bars` promises.
  bool meets(const BenchmarkBars& bars) const;
};

/// Tolerances a formulation is usually tried with, by its method, from loose to tight.
std::vector<double> usual_tolerances(std::string_view formulation);

std::vector<double> tolerances_of(const Benchmark& benchmark, std::string_view formulation);

BenchmarkRun run_benchmark(const Benchmark& benchmark, const std::string& formulation,
                           double tolerance);

}  // namespace yoke::cases
