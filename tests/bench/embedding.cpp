// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What it costs to have a run in one's hands, on the paper's scotch-yoke (Johnson's column of Table
// 11), two revolutions. Both sides are run in turn; the counters are medians of processor time over
// processor time:
//   embedded_step     every step by Simulation::step(), against simulate() (aim: at most 1.02)
//   stops_at_10_kHz   advance_to() every 0.1 ms, against simulate(); no look
//   looks_at_10_kHz   the same with state() and a column read at each stop
//   controlled        a controller that sets a force at 10 kHz, against none (aim: at most 1.5)
//   controlled_to_order_5  the same against a run of order 5 without: with the order that the run
//                     chooses, its steps are longer than 0.1 ms
//   sampled           a controller at 10 kHz that only reads
#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <vector>

#include <yoke/core/control/sampled_controller.hpp>
#include <yoke/integrators/simulation.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/tests/bench/clock.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

const SimulationOptions options{.until = 2.0 * yoke_period, .samples = 0};
const SimulationOptions options_of_order_5{.until = 2.0 * yoke_period, .samples = 0, .order = 5};

/// Time of `run` over that of `reference`, both run in turn.
double ratio(const std::function<void()>& run, const std::function<void()>& reference) {
  constexpr int rounds = 31;
  std::vector<double> ratios;
  for (int i = 0; i < rounds; ++i) {
    const double first = bench::seconds_of(run);
    ratios.push_back(first / bench::seconds_of(reference));
  }
  std::ranges::sort(ratios);
  return ratios[rounds / 2];
}

/// The yoke with a force on the slider: none, or that of a damper from a computer at 10 kHz.
enum class Computer { none, reads, acts };
Model controlled(Computer computer) {
  Model m = scotch_yoke();
  const BodyId slider = m.find_body("slider");
  const Vec2 at = m.body(slider).pose.position;
  m.add(AppliedForce{.name = "brake", .body = slider, .at = at, .value = Vec2(0.0, 0.0)});
  if (computer == Computer::none) return m;
  m.add(SampledController{
      .name = "computer",
      .period = 1e-4,
      .outputs = {"brake.fx"},
      .memory = {{"sum", "m/s"}},
      .update = [slider, acts = computer == Computer::acts](const ControllerSample& s) {
        s.memory(0) += s.motion[slider].vx;
        if (acts) s.output(0) = -0.1 * s.motion[slider].vx;
      }});
  return m;
}

void embedding(benchmark::State& state) {
  const Model plain = scotch_yoke(), idle = controlled(Computer::none);
  const Model brake = controlled(Computer::acts), reader = controlled(Computer::reads);
  const auto whole = [&] { benchmark::DoNotOptimize(simulate(plain, options)); };
  const auto without = [&] { benchmark::DoNotOptimize(simulate(idle, options)); };
  const auto stepped = [&] {
    Simulation run(plain, options);
    while (run.step()) {
    }
    benchmark::DoNotOptimize(run.finish());
  };
  const auto stops = [&](bool looks) {
    Simulation run(plain, options);
    const std::size_t force = run.find_output("pivot.fx_N");
    double sum = 0.0;
    for (long i = 1; !run.ended(); ++i) {
      run.advance_to(std::min(options.until, 1e-4 * static_cast<double>(i)));
      if (looks) sum += run.state().q[3] + run.output(force);
    }
    benchmark::DoNotOptimize(sum);
  };
  for (auto _ : state) {
    state.counters["embedded_step"] = ratio(stepped, whole);
    state.counters["stops_at_10_kHz"] = ratio([&] { stops(false); }, whole);
    state.counters["looks_at_10_kHz"] = ratio([&] { stops(true); }, whole);
    state.counters["controlled"] =
        ratio([&] { benchmark::DoNotOptimize(simulate(brake, options)); }, without);
    // Steps that end 10 000 times a second cannot be as long as those of order 7 are otherwise.
    state.counters["controlled_to_order_5"] =
        ratio([&] { benchmark::DoNotOptimize(simulate(brake, options)); },
              [&] { benchmark::DoNotOptimize(simulate(idle, options_of_order_5)); });
    state.counters["sampled"] =
        ratio([&] { benchmark::DoNotOptimize(simulate(reader, options)); }, without);
  }
  state.counters["steps"] = static_cast<double>(simulate(plain, options).summary.steps);
  state.counters["steps_controlled"] = static_cast<double>(simulate(brake, options).summary.steps);
}
BENCHMARK(embedding)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
