// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Explicit Runge-Kutta pairs, and which of them a run takes.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <yoke/cases/n_four_bar.hpp>
#include <yoke/integrators/formulations/explicit/order_choice.hpp>
#include <yoke/integrators/formulations/explicit/own_step.hpp>
#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/run/start/error_weights.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/integrators/problems.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// y = (cos, -sin, tan t) from t = 0, by equations that are not linear.
bool rates(double t, const double* y, double* y_dot) {
  y_dot[0] = y[1] * (y[0] * y[0] + y[1] * y[1]);
  y_dot[1] = -y[0];
  y_dot[2] = 1.0 + y[2] * std::tan(t);
  return true;
}

double largest(const double* error) {
  return std::max({std::abs(error[0]), std::abs(error[1]), std::abs(error[2])});
}

/// Error of one step from t = 0.1, and what the pair takes it for.
std::pair<double, double> errors(int order, double h) {
  OwnStep step(3, rates);
  step.use(explicit_pair(order));
  const double t = 0.1;
  const double from[] = {std::cos(t), -std::sin(t), std::tan(t)};
  double y[3];
  step.from(t, from);
  REQUIRE(step.to(t + h, y));
  const double error[] = {y[0] - std::cos(t + h), y[1] + std::sin(t + h), y[2] - std::tan(t + h)};
  return {largest(error), step.error(t + h, y, largest)};
}

struct Problem {
  std::string name;
  Model model;
  double end;
};

std::vector<Problem> problems() {
  std::vector<Problem> all;
  all.push_back({"chain", horizontal_chain(10), 1.0});
  all.push_back({"four-bars", cases::n_four_bar({.loops = 1}), 10.0});
  all.push_back({"scotch-yoke", scotch_yoke(), 2.0 * yoke_period});
  all.push_back({"disc", bouncing_disc(), 2.0});
  return all;
}

long evaluations(const Problem& problem, double tolerance, int order) {
  const Result run = simulate(problem.model, {.until = problem.end,
                                              .relative_tolerance = tolerance,
                                              .formulation = "arkode-projection",
                                              .samples = 2,
                                              .order = order});
  INFO(run.summary.reason);
  CHECK(run.summary.ok());
  return run.summary.evaluations;
}

}  // namespace

TEST_CASE("a step of a pair errs by one power more than its order, its judge by one less") {
  for (const ExplicitPair& pair : explicit_pairs()) {
    const double h = pair.order == 5 ? 0.04 : 0.2;
    const auto [error, judged] = errors(pair.order, h);
    const auto [half_error, half_judged] = errors(pair.order, 0.5 * h);
    CAPTURE(pair.order);
    CHECK(std::log2(error / half_error) == doctest::Approx(pair.order + 1).epsilon(0.1));
    CHECK(std::log2(judged / half_judged) == doctest::Approx(pair.order).epsilon(0.1));
    CHECK(error < judged);
  }
  CHECK(explicit_pair(5).first_same_as_last);
  CHECK(explicit_pair(5).evaluations(true) == 7);
  CHECK(explicit_pair(5).evaluations(false) == 6);
  CHECK_FALSE(explicit_pair(7).first_same_as_last);
  CHECK(explicit_pair(7).evaluations(true) == 10);
  CHECK(explicit_pair(7).evaluations(false) == 10);
}

TEST_CASE("the order begins as the tolerance wants it and follows what comparisons say") {
  CHECK(OrderChoice(1e-3, 0).order() == 5);
  OrderChoice choice(1e-6, 0);
  CHECK(choice.order() == 7);
  choice.start(true);
  CHECK(choice.order() == 5);
  choice.compare(2.0, 1.0);  // [1/s] the higher order costs half
  CHECK(choice.order() == 7);
  choice.start(false);  // of its own
  CHECK(choice.order() == 7);
  choice.compare(1.0, 1.2);
  CHECK(choice.order() == 7);  // not sure enough
  choice.compare(1.0, 1.5);
  CHECK(choice.order() == 5);
  int comparisons = 0;
  for (int i = 0; i < 1000; ++i) comparisons += choice.count() ? 1 : 0;
  CHECK(comparisons == 4);  // at 4, 16, 64, 256

  OrderChoice fixed(1e-12, 5);
  CHECK(fixed.order() == 5);
  CHECK_FALSE(fixed.count());
}

TEST_CASE("the order that a run takes costs little more than the better one") {
  for (const Problem& problem : problems())
    for (const double tolerance : {1e-4, 1e-8, 1e-11}) {
      CAPTURE(problem.name);
      CAPTURE(tolerance);
      const long low = evaluations(problem, tolerance, 5),
                 high = evaluations(problem, tolerance, 7);
      const long chosen = evaluations(problem, tolerance, 0);
      CHECK(static_cast<double>(chosen) < 1.15 * static_cast<double>(std::min(low, high)));
      if (tolerance < 1e-10) CHECK(static_cast<double>(chosen) < 0.8 * static_cast<double>(low));
    }
}

TEST_CASE("behind events steps begin with a length that was good before") {
  const Problem problem{"scotch-yoke", scotch_yoke(), 2.0 * yoke_period};
  CHECK(evaluations(problem, 1e-8, 0) < 20000);  // 24000 with ARKODE's own first steps
  CHECK(evaluations(problem, 1e-4, 0) < 6000);   // 8600
}

TEST_CASE("where stability bounds steps, the order chosen is the better one too") {
  Model m;
  const BodyId rotor = m.add(Body{.name = "rotor", .mass = 1.0, .inertia = 1.0});
  m.add(Revolute{.name = "pivot", .a = ground, .b = rotor, .at = {0.0, 0.0}});
  m.add(TorsionalSpring{.name = "brake",
                        .a = ground,
                        .b = rotor,
                        .stiffness = 100.0,
                        .damping = 1000.0,
                        .free_angle = 1.0});
  const Problem problem{"brake", std::move(m), 5.0};
  const long low = evaluations(problem, 1e-6, 5), high = evaluations(problem, 1e-6, 7);
  CHECK(static_cast<double>(evaluations(problem, 1e-6, 0)) <
        1.1 * static_cast<double>(std::min(low, high)));
}

// Steps of order 7 end far from a singular position: the crossing begins with a step that must get
// shorter before it is accurate.
TEST_CASE("singular positions are crossed at every tolerance by steps of order 7") {
  for (const int loops : {1, 10})
    for (int digits = 4; digits <= 9; ++digits) {
      CAPTURE(loops);
      CAPTURE(digits);
      const Result run = simulate(cases::n_four_bar({.loops = loops}),
                                  {.until = 10.0,
                                   .relative_tolerance = std::pow(10.0, -digits),
                                   .formulation = "arkode-projection",
                                   .samples = 2,
                                   .order = 7});
      CHECK(run.summary.ok());
      CHECK(run.summary.singular_positions.size() == 10);
      CHECK(run.summary.evaluations < 15000);
    }
}

// SUNDIALS 6.4 takes the last stage of the pair of order 7 for the first of the next step.
TEST_CASE("order 7 pays without projections too") {
  const auto evaluations = [](int order) {
    return simulate(double_pendulum(), {.until = 1.0,
                                        .relative_tolerance = 1e-10,
                                        .formulation = "arkode-baumgarte",
                                        .samples = 2,
                                        .order = order})
        .summary.evaluations;
  };
  CHECK(10 * evaluations(7) < 7 * evaluations(5));
}

TEST_CASE("an order that there is not is refused") {
  CHECK_THROWS_WITH_AS(simulate(double_pendulum(), {.until = 1.0, .order = 6}),
                       "simulation: order = 6 must be one of 0 (what costs less), 5, 7",
                       ModelError);
}

TEST_CASE("a run of a given order is taken up with it") {
  const TemporaryFolder scratch;
  SimulationOptions options{.until = 2.0,
                            .relative_tolerance = 1e-6,
                            .samples = 21,
                            .order = 7,
                            .checkpoints = {.folder = scratch.path(), .every = 0.5}};
  const Result whole = simulate(double_pendulum(), options);
  long steps = 0;
  options.observer = [&](const Progress& p) { return ++steps, p.t < 1.2; };
  simulate(double_pendulum(), options);
  const Result resumed = resume(double_pendulum(), scratch.path());
  REQUIRE(resumed.samples.rows() == whole.samples.rows());
  CHECK(resumed.samples.value(20, 3) == whole.samples.value(20, 3));
}

TEST_CASE("a glance into a step of either order costs no evaluation and errs little") {
  for (const int order : {5, 7}) {
    CAPTURE(order);
    const Model model = double_pendulum();
    State state = model.start_state();
    Dynamics dynamics(model);
    REQUIRE(dynamics.assemble(state));
    const SimulationOptions options{.until = 10.0, .relative_tolerance = 1e-8, .order = order};
    dynamics.system().set_scales(choose_scales(dynamics.system(), state, options));
    const auto formulation = find_formulation("arkode-projection")
                                 .make(dynamics, choose_tolerances(dynamics.system(), options));
    formulation->start(state);
    State glance = state, exact = state;
    double worst_position = 0.0, worst_velocity = 0.0;
    for (int i = 0; i < 60; ++i) {
      const double begin = formulation->time();
      REQUIRE(formulation->step(10.0) == Step::advanced);
      for (const double part : {0.0, 0.3, 0.5, 0.8, 1.0}) {
        const double t = begin + part * (formulation->time() - begin);
        const long before = dynamics.evaluations();
        formulation->glance(t, glance);
        CHECK(dynamics.evaluations() == before);
        formulation->interpolate(t, exact);
        worst_position = std::max(worst_position, (glance.q - exact.q).cwiseAbs().maxCoeff());
        worst_velocity = std::max(worst_velocity, (glance.v - exact.v).cwiseAbs().maxCoeff());
        if (part == 0.0 || part == 1.0) CHECK(glance.q.isApprox(exact.q, 1e-14));
      }
    }
    CHECK(worst_position < (order == 5 ? 2e-9 : 2e-7));
    CHECK(worst_velocity < (order == 5 ? 1e-6 : 3e-5));
  }
}
