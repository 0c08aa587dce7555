// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Every case's accelerations and multipliers, at the start and under way, by every linear solver.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <yoke/cases/case.hpp>
#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/simulate.hpp>

namespace {

using namespace yoke;

/// Largest difference of a part of two vectors, relative to the largest element.
double difference(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const double size = x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0.0;
  return size > 0.0 ? (x - y).cwiseAbs().maxCoeff() / size : 0.0;
}

void compare(const Model& model, const State& at, int& by_blocks) {
  Dynamics judge(model, LinearSolver::klu);
  State expected = at;
  if (!judge.assemble(expected)) return;
  for (const LinearSolver solver : {LinearSolver::range_klu, LinearSolver::blocks}) {
    INFO(name_of(solver));
    Dynamics dynamics(model, solver);
    dynamics.leave_out(judge.system().left_out_rows());
    State state = expected;
    REQUIRE(dynamics.calc_accelerations(state));
    CHECK(difference(expected.a, state.a) < 1e-12);
    CHECK(difference(expected.lambda, state.lambda) < 1e-12);
    if (dynamics.saddle().in_use() == LinearSolver::blocks) ++by_blocks;
  }
}

}  // namespace

TEST_CASE("all linear solvers give the accelerations and multipliers of every case") {
  int compared = 0, by_blocks = 0;
  for (const cases::Case& c : cases::case_registry()) {
    INFO(c.name);
    const cases::Parameters parameters(c.parameters, {});
    const Model model = cases::make_model(c, parameters);
    compare(model, model.start_state(), by_blocks);
    const Result run = simulate(
        model, {.until = 0.05 * c.duration(parameters), .relative_tolerance = 1e-6, .samples = 0});
    compare(model, run.final, by_blocks);
    ++compared;
  }
  CHECK(compared > 20);
  CHECK(by_blocks > 30);
}
