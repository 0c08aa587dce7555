// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What handing out points costs, and how sweeps scale.
//
//   tiny_points       100 000 points that do nothing, with a journal, on 1 and 2 threads:
//                     us_per_point   [us] of the clock; aim: less than 100
//   tiny_points_on_ranks   the same under mpirun -n 2, built with MPI; rank 0 prints what counts
//   sweep_scaling     a slider-crank at 400 points on 1 and 2 threads, medians:
//                     efficiency     time of one / (2 time of two); aim: 0.95, on two free processors
//                     to_apart       time of two threads that have half of the points each and nothing in
//                                    common / time of two: what sharing costs, whatever else runs
//                     busy           share of the threads' time within points; aim: 0.95
//   ranks_on_paper    N ranks that share one dispatcher, or dispatchers of 128 ranks each below one above
//                     them, simulated event by event from the cost of a message and of a row: points of 1 s
//                     whose times vary by half; 100 points a rank.
//                     efficiency     of all ranks
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <queue>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/cases/jobs/law_run.hpp>
#include <yoke/cases/sweep/mpi_ranks.hpp>
#include <yoke/integrators/studies/study.hpp>

namespace {

using namespace yoke;
namespace fs = std::filesystem;

double seconds_of(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A folder that goes away.
struct Scratch {
  fs::path path = fs::temp_directory_path() / fmt::format("yoke-bench-{}", getpid());
  ~Scratch() { fs::remove_all(path); }
};

double seconds_of_tiny_points(StudyOptions options) {
  const StudyPoints points = grid_points({linear_axis("x", 0.0, 1.0, 100000)});
  const auto function = [](const StudyPoint& p) {
    const double x = p["x"];
    return StudyOutcome{{x, x * x, 1.0 - x, 0.1 * x}};
  };
  const Scratch scratch;
  options.folder = scratch.path;
  return run_study(points, {{"a"}, {"b"}, {"c"}, {"d"}}, function, options).progress.elapsed;
}

void tiny_points(benchmark::State& state) {
  double total = 0.0;
  for (auto _ : state) total += seconds_of_tiny_points({.jobs = static_cast<int>(state.range(0))});
  state.counters["us_per_point"] = 1e6 * total / 100000.0 / static_cast<double>(state.iterations());
}
BENCHMARK(tiny_points)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->Iterations(3);

void tiny_points_on_ranks(benchmark::State& state) {
  cases::MpiRanks ranks;
  StudyOptions options{.executor = ranks.executor(1)};
  options.leads = ranks.rank() == 0;
  double total = 0.0;
  for (auto _ : state)
    if (ranks.size() > 1) total += seconds_of_tiny_points(options);
  if (ranks.size() == 1) state.SetLabel("start it by mpirun");
  state.counters["us_per_point"] = 1e6 * total / 100000.0;
}
BENCHMARK(tiny_points_on_ranks)->Unit(benchmark::kMillisecond)->Iterations(1);

/// A slider-crank at 400 points, and what is measured of it.
struct CrankSweep {
  const cases::Case& c = cases::find_case("slider_crank");
  StudyPoints points = grid_points(
      {linear_axis("crank", 0.02, 0.06, 20, "m"), linear_axis("speed", 100.0, 200.0, 20)});

  StudyOutcome at(const StudyPoint& p) const {
    const cases::RunRequest request{
        .parameters = cases::Parameters(
            c.parameters, {"crank=" + p.text("crank") + "m", "speed=" + p.text("speed")}),
        .laws = {},
        .output = {},
        .samples = 101};
    const cases::LawRun run = cases::run_law(c, request, "", {});
    return {{static_cast<double>(run.summary.steps)}};
  }
  StudyResult study(int jobs) const {
    const auto function = [this](const StudyPoint& p) { return at(p); };
    return run_study(points, {{"steps"}}, function, {.jobs = jobs});
  }
  /// Two threads that have nothing to do with each other, each with every second point.
  double seconds_apart() const {
    return seconds_of([this] {
      const auto half = [this](std::size_t first) {
        for (std::size_t i = first; i < points.size(); i += 2)
          benchmark::DoNotOptimize(at(StudyPoint(points, i)));
      };
      std::jthread other(half, std::size_t{1});
      half(0);
    });
  }
};

double median(std::vector<double> numbers) {
  std::ranges::sort(numbers);
  return numbers[numbers.size() / 2];
}

void sweep_scaling(benchmark::State& state) {
  const CrankSweep sweep;
  std::vector<double> to_one, to_apart, busy;
  for (auto _ : state) {
    const double one = sweep.study(1).progress.elapsed;
    const StudyResult study = sweep.study(2);
    const double two = study.progress.elapsed;
    double within = 0.0;
    for (const StudyRow& row : study.rows) within += row.seconds;
    to_one.push_back(one / (2.0 * two));
    to_apart.push_back(sweep.seconds_apart() / two);
    busy.push_back(within / (2.0 * two));
  }
  state.counters["efficiency"] = median(to_one);
  state.counters["to_apart"] = median(to_apart);
  state.counters["busy"] = median(busy);
}
BENCHMARK(sweep_scaling)->Unit(benchmark::kMillisecond)->Iterations(9);

/// Ranks that ask one server for points. It serves one message at a time, `message` [s] each and `row` [s] for
/// each point in it; messages wait in the order in which they come.
double shared_seconds(int ranks, int points, double message, double row, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto share = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  using Asking = std::pair<double, int>;  // [s] when, rank
  std::priority_queue<Asking, std::vector<Asking>, std::greater<>> asking;
  for (int r = 0; r < ranks; ++r) asking.emplace(0.0, r);
  double free = 0.0, end = 0.0;  // [s] of the server
  int left = points;
  while (!asking.empty()) {
    const auto [when, rank] = asking.top();
    asking.pop();
    free = std::max(free, when) + message + row;
    end = std::max(end, free);
    if (left-- > 0) asking.emplace(free + 0.5 + share(), rank);  // of 1 s in the mean
  }
  return end;
}

/// Dispatchers of `group` ranks each, that ask the one above for points twenty times in all. That one is busy
/// with their messages and with every row, for it alone writes.
double grouped_seconds(int ranks, int points, int group, double message, double row) {
  const int groups = ranks / group;
  double last = 0.0;
  for (int g = 0; g < groups; ++g)
    last = std::max(
        last, shared_seconds(group, points / groups, message, row, static_cast<std::uint64_t>(g)));
  return std::max(last, 20.0 * groups * message + points * row);
}

void ranks_on_paper(benchmark::State& state) {
  const int ranks = static_cast<int>(state.range(0)), group = static_cast<int>(state.range(1));
  constexpr int points_of_rank = 100;
  constexpr double message = 20e-6, row = 5e-6;  // [s]
  double seconds = 0.0;
  for (auto _ : state)
    seconds = group == 0 ? shared_seconds(ranks, ranks * points_of_rank, message, row, 1)
                         : grouped_seconds(ranks, ranks * points_of_rank, group, message, row);
  state.counters["efficiency"] = points_of_rank / seconds;
}
BENCHMARK(ranks_on_paper)
    ->Args({64, 0})
    ->Args({1024, 0})
    ->Args({10240, 0})
    ->Args({65536, 0})
    ->Args({10240, 128})
    ->Args({65536, 128})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
