// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the elements cost beside the linear algebra nobody can avoid: one acceleration evaluation of
// a hanging chain of N links (kinematics, joints, gravity, assembly, refactor, solve) against the
// bare KLU refactor + solve of the very same matrix. Both are timed in turn, block by block, in one
// run; the counter `ratio` is the median of the ratios of neighbouring blocks. Aim: at most 1.5.
#include <benchmark/benchmark.h>
#include <suitesparse/klu.h>

#include <yoke/core/dynamics.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/gravity.hpp>
#include <yoke/joints/revolute.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

namespace {

using namespace yoke;
using Clock = std::chrono::steady_clock;

// Links of 1 m and 1 kg, each turned a little against the last, so that no entry is special.
Model chain(int links) {
  Model model;
  Vec2 joint(0.0, 0.0);
  BodyId last = ground;
  for (int i = 0; i < links; ++i) {
    const double angle = -1.1 + 0.7 * std::sin(0.37 * i);
    const Vec2 half = rotate(angle, Vec2(0.5, 0.0));
    const BodyId link = model.add(Body{.name = "link " + std::to_string(i),
                                       .mass = 1.0,
                                       .inertia = 1.0 / 12.0,
                                       .pose = {joint + half, angle},
                                       .twist = {{0.0, 0.0}, 0.1 * std::cos(1.3 * i)}});
    model.add(Revolute{.name = "joint " + std::to_string(i), .a = last, .b = link, .at = joint});
    joint += 2.0 * half;
    last = link;
  }
  model.add(Gravity{});
  return model;
}

// KLU alone, on a copy of the matrix.
class BareKlu {
 public:
  explicit BareKlu(const SparseMatrix& matrix) : matrix_(matrix) {
    klu_defaults(&common_);
    symbolic_ =
        klu_analyze(matrix_.size, matrix_.column_start.data(), matrix_.row.data(), &common_);
    numeric_ = klu_factor(matrix_.column_start.data(), matrix_.row.data(), matrix_.value.data(),
                          symbolic_, &common_);
    b_.assign(static_cast<std::size_t>(matrix_.size), 1.0);
  }
  ~BareKlu() {
    klu_free_numeric(&numeric_, &common_);
    klu_free_symbolic(&symbolic_, &common_);
  }
  BareKlu(const BareKlu&) = delete;
  BareKlu& operator=(const BareKlu&) = delete;
  void refactor_and_solve() {
    klu_refactor(matrix_.column_start.data(), matrix_.row.data(), matrix_.value.data(), symbolic_,
                 numeric_, &common_);
    std::fill(b_.begin(), b_.end(), 1.0);
    klu_solve(symbolic_, numeric_, matrix_.size, 1, b_.data(), &common_);
    benchmark::DoNotOptimize(b_.data());
  }

 private:
  SparseMatrix matrix_;
  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
  std::vector<double> b_;
};

template <class F>
double seconds(int repeats, F&& f) {
  const auto begin = Clock::now();
  for (int i = 0; i < repeats; ++i) f();
  return std::chrono::duration<double>(Clock::now() - begin).count() / repeats;
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
      dynamics.calc_accelerations(state.t, state.q.data(), state.v.data(), state.z.data(),
                                  state.a.data(), state.lambda.data(), nullptr, nullptr);
    });
    const double b = seconds(repeats, [&] { bare.refactor_and_solve(); });
    bench.SetIterationTime(a);
    ours.push_back(a);
    theirs.push_back(b);
    ratios.push_back(a / b);
  }
  const auto median = [](std::vector<double>& x) {
    std::ranges::nth_element(x, x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2));
    return x[x.size() / 2];
  };
  bench.counters["ratio"] = median(ratios);
  bench.counters["ns_per_link"] = 1e9 * median(ours) / links;
  bench.counters["klu_ns_per_link"] = 1e9 * median(theirs) / links;
}

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
