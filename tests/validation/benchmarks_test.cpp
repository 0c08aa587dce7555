// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Every benchmark of docs/validation/benchmarks.md against what is promised, by two formulations
// that share neither equations nor method.
#include <doctest/doctest.h>

#include <string>

#include <yoke/cases/benchmark_problems.hpp>

namespace {

using namespace yoke::cases;

void check_bars(const std::string& formulation, double tolerance) {
  for (const Benchmark& b : benchmarks()) {
    const BenchmarkRun r = run_benchmark(b, formulation, tolerance);
    INFO(b.name, ": ", r.trouble, " position ", r.errors.position, " velocity ", r.errors.velocity,
         " acceleration ", r.errors.acceleration, " reaction ", r.errors.reaction, " energy ",
         r.energy, " period ", r.period_error);
    CHECK(r.trouble.empty());
    CHECK(r.reached == b.until);
    CHECK(r.meets(b.bars));
  }
}

}  // namespace

TEST_CASE("all benchmarks by Runge-Kutta with projection") {
  check_bars("arkode-projection", 1e-12);
}

TEST_CASE("all benchmarks by BDF on the equations after Baumgarte") {
  check_bars("ida-baumgarte", 1e-13);
}
