// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a large model costs before its first step, per link of a chain: the model itself; equations, assembly and a
// formulation, ready to step. A chain of 1000 links is made a hundred times in turn with one of 100 000, so that both are
// the same number of links; the counters `growth` and `memory_growth` are what a link of the long one takes in parts of
// one of the short. Memory is what malloc has handed out and not got back, KLU's and SUNDIALS' included. malloc keeps
// what it has: otherwise the long chain alone would pay for pages that the system clears and takes back each time.
//
// The short chain stays in the cache, the long one does not, so even a program that does nothing but write as many bytes
// grows. `machine_growth` says how much: measured in turn with the rest, it allocates as many bytes a link in as many
// pieces, fills them and reads them once, all in order; for the model, whose pieces are small, it looks besides into a
// table of all names as often as a model must, at random places.
#include <malloc.h>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/run/start/error_weights.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/bench/chain.hpp>

#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>

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
  SetUp& operator+=(const SetUp& other) {
    seconds += other.seconds;
    bytes += other.bytes;
    return *this;
  }
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

SetUp building(int links) {
  const double before = bytes_in_use();
  const auto begin = Clock::now();
  const Model model = chain(links);
  const double seconds = seconds_since(begin);
  return {seconds, bytes_in_use() - before};
}

/// What is allocated and filled per link.
struct Touch {
  double bytes = 0.0;
  int pieces = 0;  // of that size together; none: arrays of one number a link
  int looks = 0;   // into a table of `names` for each link
  int names = 0;
};

double touch(int links, const Touch& per_link) {
  constexpr std::uint64_t odd = 0x9E3779B97F4A7C15u;  // its multiples are spread evenly
  const auto count = static_cast<std::size_t>(links);
  const auto numbers = static_cast<std::size_t>(per_link.bytes / 8.0);
  const auto pieces = static_cast<std::size_t>(per_link.pieces);
  const std::size_t words = pieces > 0 ? numbers / pieces : count;
  const std::size_t looks = count * static_cast<std::size_t>(per_link.looks);
  const std::size_t places = std::bit_ceil(2 * count * static_cast<std::size_t>(per_link.names));
  const auto begin = Clock::now();
  std::vector<std::unique_ptr<std::uint64_t[]>> all(pieces > 0 ? pieces * count : numbers);
  std::vector<std::uint64_t> table(places);
  std::uint64_t next = odd, sum = 0;
  std::size_t looked = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].reset(new std::uint64_t[words]);
    std::fill_n(all[i].get(), words, i);
    for (; looked * all.size() < looks * i; ++looked, next += odd)
      sum += ++table[static_cast<std::size_t>(next >> 20) & (places - 1)];
  }
  for (const auto& piece : all) sum = std::accumulate(piece.get(), piece.get() + words, sum);
  benchmark::DoNotOptimize(sum);
  return seconds_since(begin);
}

/// One of many links in turn with as many links in chains of few; `machine` says what the bytes of the latter are.
void compare(benchmark::State& bench, const std::function<SetUp(int)>& run,
             const std::function<Touch(double)>& machine) {
  std::vector<double> growth, machine_growth, of_long;
  SetUp brief, whole;
  for (auto _ : bench) {
    brief = {};
    for (int i = 0; i < many / few; ++i) brief += run(few);
    whole = run(many);
    bench.SetIterationTime(whole.seconds);
    of_long.push_back(whole.seconds);
    growth.push_back(whole.seconds / brief.seconds);
    const Touch per_link = machine(brief.bytes / many);
    double of_few = 0.0;
    for (int i = 0; i < many / few; ++i) of_few += touch(few, per_link);
    machine_growth.push_back(touch(many, per_link) / of_few);
  }
  bench.counters["growth"] = median(growth);
  bench.counters["machine_growth"] = median(machine_growth);
  bench.counters["memory_growth"] = whole.bytes / brief.bytes;
  bench.counters["ns_per_link"] = 1e9 * median(of_long) / many;
  bench.counters["bytes_per_link"] = whole.bytes / many;
}

void set_up_of_chain(benchmark::State& bench, const std::string& name) {
  const FormulationEntry& entry =
      *std::ranges::find(formulation_registry(), name, &FormulationEntry::name);
  const Model short_one = chain(few), long_one = chain(many);
  compare(
      bench, [&](int links) { return set_up(links == few ? short_one : long_one, entry); },
      [](double bytes) { return Touch{.bytes = bytes}; });
}

// A link is a body and a joint, with two names: each is looked for, to see that it is free, and put down. Its pieces are
// the joint, which bodies it has, its equations and its pattern; bodies are in one array.
void building_of_chain(benchmark::State& bench) {
  compare(bench, building,
          [](double bytes) { return Touch{.bytes = bytes, .pieces = 4, .looks = 4, .names = 2}; });
}

const bool registered = [] {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  benchmark::RegisterBenchmark("building_of_chain", building_of_chain)
      ->Iterations(5)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
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
