// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a large model costs before its first step, per link of a chain: equations, assembly and a formulation, ready
// to step. A chain of 1000 links is set up a hundred times in turn with one of 100 000, so that both are the same
// number of links; the counters `growth` and `memory_growth` are what a link of the long one takes in parts of
// one of the short. Memory is what malloc has handed out and not got back, KLU's and SUNDIALS' included. malloc keeps
// what it has: otherwise the long chain alone would pay for pages that the system clears and takes back each time.
#include <malloc.h>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/run/start/error_weights.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/bench/chain.hpp>

#include <limits>

namespace {

using namespace yoke;
using namespace yoke::bench;

constexpr int few = 1000, many = 100000;

double bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

struct SetUp {
  double seconds = 0.0, bytes = 0.0;
};

SetUp set_up(const Model& model, const FormulationEntry& entry) {
  const double before = bytes_in_use();
  const auto begin = Clock::now();
  State state = model.start_state();
  Dynamics dynamics(model);
  if (!dynamics.assemble(state)) std::abort();
  const SimulationOptions options{.until = 10.0, .relative_tolerance = 1e-6};
  dynamics.system().set_scales(choose_scales(dynamics.system(), state, options));
  dynamics.system().bind(state);
  const auto formulation = entry.make(dynamics, choose_tolerances(dynamics.system(), options));
  formulation->start(state);
  return {seconds_since(begin), bytes_in_use() - before};
}

void set_up_of_chain(benchmark::State& bench, const std::string& name) {
  const FormulationEntry& entry =
      *std::ranges::find(formulation_registry(), name, &FormulationEntry::name);
  const Model short_one = chain(few), long_one = chain(many);
  std::vector<double> growth, of_long;
  double memory_growth = 0.0, bytes = 0.0;
  for (auto _ : bench) {
    SetUp brief;
    for (int i = 0; i < many / few; ++i) {
      const SetUp once = set_up(short_one, entry);
      brief.seconds += once.seconds;
      brief.bytes += once.bytes;
    }
    const SetUp whole = set_up(long_one, entry);
    bench.SetIterationTime(whole.seconds);
    of_long.push_back(whole.seconds);
    growth.push_back(whole.seconds / brief.seconds);
    memory_growth = whole.bytes / brief.bytes;
    bytes = whole.bytes;
  }
  bench.counters["growth"] = median(growth);
  bench.counters["memory_growth"] = memory_growth;
  bench.counters["ns_per_link"] = 1e9 * median(of_long) / many;
  bench.counters["bytes_per_link"] = bytes / many;
}

const bool registered = [] {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  for (const FormulationEntry& entry : formulation_registry())
    benchmark::RegisterBenchmark(
        ("set_up_of_chain/" + std::string(entry.name)).c_str(),
        [name = std::string(entry.name)](benchmark::State& bench) { set_up_of_chain(bench, name); })
        ->Iterations(5)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
