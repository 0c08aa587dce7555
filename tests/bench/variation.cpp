// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What variational equations cost beside the run they are carried along, each run in turn with the run
// alone. The counter `ratio` is the median of processor time over processor time, `per_column` that without
// the run over the number of columns, 2 degrees of freedom:
//   variation_of_pendulum/N   a chain of N rods hung at an angle, 1 s: smooth
//   variation_of_impacts      the ball on a vibrating table, ten periods: two events each
//   exponent_of_pendulum/N    the largest exponent alone: one column
#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <vector>

#include <yoke/tests/bench/clock.hpp>
#include <yoke/tests/integrators/studies/oscillators.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

void report(benchmark::State& state, int columns, const std::function<void()>& varied,
            const std::function<void()>& alone) {
  constexpr int rounds = 5;
  std::vector<double> ratios;
  for (auto _ : state) {
    ratios.clear();
    for (int i = 0; i < rounds; ++i) {
      const double first = bench::seconds_of(varied);
      ratios.push_back(first / bench::seconds_of(alone));
    }
  }
  std::ranges::sort(ratios);
  const double ratio = ratios[rounds / 2];
  state.counters["ratio"] = ratio;
  state.counters["per_column"] = (ratio - 1.0) / columns;
}

/// N rods of 1 m and 1 kg, straight, at 1 rad from the vertical.
Model chain(int links) {
  Model m;
  const Vec2 along(std::sin(1.0), -std::cos(1.0));
  BodyId last = ground;
  for (int i = 0; i < links; ++i) {
    const BodyId rod = m.add({.name = fmt::format("rod{}", i),
                              .mass = 1.0,
                              .inertia = 1.0 / 12.0,
                              .pose = {(i + 0.5) * along, 1.0}});
    m.add(Revolute{.name = fmt::format("pin{}", i), .a = last, .b = rod, .at = i * along});
    last = rod;
  }
  m.add(Gravity{});
  return m;
}

void variation_of_pendulum(benchmark::State& state) {
  const auto links = static_cast<int>(state.range(0));
  const Model m = chain(links);
  const SimulationOptions options{.until = 1.0, .relative_tolerance = 1e-10, .samples = 0};
  report(
      state, 2 * links, [&] { flow_derivative(m, m.start_state(), options); },
      [&] { simulate(m, options); });
}
BENCHMARK(variation_of_pendulum)->Arg(1)->Arg(2)->Arg(5)->Arg(10)->Iterations(1);

void variation_of_impacts(benchmark::State& state) {
  const VibratingTable t;
  const Model m = t.model();
  const SimulationOptions options{
      .until = 10.0 * t.period(), .relative_tolerance = 1e-10, .samples = 0};
  report(
      state, 2, [&] { flow_derivative(m, m.start_state(), options); },
      [&] { simulate(m, options); });
}
BENCHMARK(variation_of_impacts)->Iterations(1);

void exponent_of_pendulum(benchmark::State& state) {
  const Model m = chain(static_cast<int>(state.range(0)));
  SimulationOptions options{.until = 1.0, .relative_tolerance = 1e-10, .samples = 0};
  report(
      state, 1, [&] { lyapunov(m, {.until = 1.0, .run = options}); },
      [&] { simulate(m, options); });
}
BENCHMARK(exponent_of_pendulum)->Arg(2)->Arg(10)->Iterations(1);

}  // namespace
