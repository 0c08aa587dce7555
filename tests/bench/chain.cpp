// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the elements cost beside the linear algebra nobody can avoid: one acceleration evaluation of
// a hanging chain of N links (kinematics, joints, gravity, assembly, refactor, solve) against the
// bare KLU refactor + solve of the very same matrix. Both are timed in turn, block by block, in one
// run; the counter `ratio` is the median of the ratios of neighbouring blocks. Aim: at most 1.5.
#include <yoke/contact/laws/friction/regularised_coulomb.hpp>
#include <yoke/core/equations/dynamics.hpp>
#include <yoke/tests/bench/chain.hpp>

namespace {

using namespace yoke;
using namespace yoke::bench;

template <class F>
double seconds(int repeats, F&& f) {
  const auto begin = Clock::now();
  for (int i = 0; i < repeats; ++i) f();
  return seconds_since(begin) / repeats;
}

void acceleration_of_chain(benchmark::State& bench) {
  const int links = static_cast<int>(bench.range(0));
  const Model model = chain(links);
  Dynamics dynamics(model);
  State state = model.start_state();
  if (!dynamics.assemble(state)) {
    bench.SkipWithError("the chain does not assemble");
    return;
  }
  BareKlu bare(dynamics.matrix());
  const int repeats = std::max(1, 20000 / links);
  double nudge = 1e-9;  // the angles must change, or there is nothing to compute again
  std::vector<double> ratios, ours, theirs;
  for (auto _ : bench) {
    const double a = seconds(repeats, [&] {
      nudge = -nudge;
      for (Eigen::Index i = 2; i < state.q.size(); i += 3) state.q[i] += nudge;
      dynamics.calc_accelerations(
          {.t = state.t, .q = state.q.data(), .v = state.v.data(), .z = state.z.data()},
          {.a = state.a.data(), .lambda = state.lambda.data()});
    });
    const double b = seconds(repeats, [&] { bare.refactor_and_solve(); });
    bench.SetIterationTime(a);
    ours.push_back(a);
    theirs.push_back(b);
    ratios.push_back(a / b);
  }
  bench.counters["ratio"] = median(ratios);
  bench.counters["ns_per_link"] = 1e9 * median(ours) / links;
  bench.counters["klu_ns_per_link"] = 1e9 * median(theirs) / links;
}

// Friction in every joint from its reaction, over the same chain without. Newton's iteration takes a few
// rounds of one factorisation each, by blocks as everything else; `klu_ratio` is what it is where KLU factorises the
// whole matrix each time. What counts besides is that it costs no more per link in a long chain.
void friction_of_chain(benchmark::State& bench) {
  const int links = static_cast<int>(bench.range(0));
  double factorisations = 0.0;
  const auto evaluation = [&](const std::optional<PinFriction>& friction,
                              LinearSolver solver = LinearSolver::automatic) {
    const Model model = chain(links, friction);
    Dynamics dynamics(model, solver);
    State state = model.start_state();
    if (!dynamics.assemble(state)) return 0.0;
    const int repeats = std::max(1, 20000 / links);
    const FactorCounters before = dynamics.counters();
    double nudge = 1e-9;
    const double time = seconds(repeats, [&] {
      nudge = -nudge;
      for (Eigen::Index i = 2; i < state.q.size(); i += 3) state.q[i] += nudge;
      dynamics.calc_accelerations(
          {.t = state.t, .q = state.q.data(), .v = state.v.data(), .z = state.z.data()},
          {.a = state.a.data(), .lambda = state.lambda.data()});
    });
    const FactorCounters after = dynamics.counters();
    factorisations = static_cast<double>(after.refactorisations + after.fresh -
                                         before.refactorisations - before.fresh) /
                     repeats;
    return time;
  };
  const PinFriction friction{.law = RegularisedCoulomb{.mu = 0.2}, .radius = 0.02};
  std::vector<double> ratios, klu_ratios, with;
  for (auto _ : bench) {
    const double plain = evaluation({});
    klu_ratios.push_back(evaluation(friction, LinearSolver::klu) / plain);
    with.push_back(evaluation(friction));
    bench.SetIterationTime(with.back());
    ratios.push_back(with.back() / plain);
  }
  bench.counters["ratio"] = median(ratios);
  bench.counters["klu_ratio"] = median(klu_ratios);
  bench.counters["factorisations"] = factorisations;
  bench.counters["ns_per_link"] = 1e9 * median(with) / links;
}

// Elimination by blocks against KLU on the saddle matrix, whole evaluations in turn.
void compare_solvers(benchmark::State& bench, const Model& model) {
  const int links = static_cast<int>(bench.range(0));
  const int repeats = std::max(1, 20000 / links);
  struct Contestant {
    Contestant(const Model& m, LinearSolver solver) : dynamics(m, solver), state(m.start_state()) {}
    Dynamics dynamics;
    State state;
    std::vector<double> times{};
  };
  const auto contestant = [&](LinearSolver solver) {
    auto made = std::make_unique<Contestant>(model, solver);
    if (!made->dynamics.assemble(made->state)) bench.SkipWithError("the links do not assemble");
    return made;
  };
  const auto klu = contestant(LinearSolver::klu), range_klu = contestant(LinearSolver::range_klu),
             blocks = contestant(LinearSolver::blocks);
  double nudge = 1e-9;
  const auto evaluate = [&](Contestant& c) {
    State& state = c.state;
    c.times.push_back(seconds(repeats, [&] {
      nudge = -nudge;
      for (Eigen::Index i = 2; i < state.q.size(); i += 3) state.q[i] += nudge;
      c.dynamics.calc_accelerations(
          {.t = state.t, .q = state.q.data(), .v = state.v.data(), .z = state.z.data()},
          {.a = state.a.data(), .lambda = state.lambda.data()});
    }));
    return c.times.back();
  };
  std::vector<double> of_blocks, of_range_klu;
  for (auto _ : bench) {
    const double judge = evaluate(*klu);
    of_range_klu.push_back(evaluate(*range_klu) / judge);
    of_blocks.push_back(evaluate(*blocks) / judge);
    bench.SetIterationTime(blocks->times.back());
  }
  bench.counters["ratio_to_klu"] = median(of_blocks);
  bench.counters["range_klu_ratio"] = median(of_range_klu);
  bench.counters["ns_per_link"] = 1e9 * median(blocks->times) / links;
}

void solvers_of_chain(benchmark::State& bench) {
  compare_solvers(bench, chain(static_cast<int>(bench.range(0))));
}

// All links on one hub, where blocks couple every joint with every other.
void solvers_of_star(benchmark::State& bench) {
  const int links = static_cast<int>(bench.range(0));
  Model model;
  const BodyId hub = model.add(Body{.name = "hub", .mass = 5.0, .inertia = 1.0});
  model.add(Revolute{.name = "pivot", .a = ground, .b = hub, .at = {0.1, 0.0}});
  for (int i = 0; i < links; ++i) {
    const double angle = 6.28 * i / links;
    const Vec2 at = rotate(angle, {1.0, 0.0});
    const BodyId link = model.add(Body{.name = "link " + std::to_string(i),
                                       .mass = 1.0,
                                       .inertia = 0.1,
                                       .pose = {1.5 * at, angle}});
    model.add(Revolute{.name = "joint " + std::to_string(i), .a = hub, .b = link, .at = at});
  }
  model.add(Gravity{});
  compare_solvers(bench, model);
  bench.SetLabel("automatic: " + std::string(name_of(Dynamics(model).saddle().in_use())));
}

BENCHMARK(solvers_of_star)
    ->Arg(3)
    ->Arg(5)
    ->Arg(10)
    ->Arg(15)
    ->Arg(20)
    ->Arg(40)
    ->Iterations(7)
    ->UseManualTime();
BENCHMARK(solvers_of_chain)
    ->Arg(3)
    ->Arg(10)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Iterations(15)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(friction_of_chain)
    ->Arg(10)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Iterations(7)
    ->UseManualTime();
BENCHMARK(acceleration_of_chain)
    ->Arg(10)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Iterations(30)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
