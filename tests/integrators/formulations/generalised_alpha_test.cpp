// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The method itself: its order in positions, velocities and its own multipliers, whatever the
// steps.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <yoke/integrators/formulations/generalised_alpha.hpp>
#include <yoke/integrators/run/start/error_weights.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/relaxing_spring.hpp>
#include <yoke/tests/integrators/wall.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// A rod on a pivot that swings onto a stop and off again, before 0.7 s.
Model pendulum_at_stop() {
  Model m;
  const BodyId rod =
      m.add(Body{.name = "rod", .mass = 1.0, .inertia = 1.0 / 12.0, .pose = {{0.5, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = rod});
  m.add(Gravity{.name = "gravity", .acceleration = {0.0, -9.81}});
  m.add(Wall{.name = "stop",
             .body = rod,
             .law = {PowerLaw{4e3, 1.0}},
             .height = -0.7,
             .point = {0.5, 0.0}});
  return m;
}

/// What simulate() does around a formulation, with steps of our own and a view of its multipliers.
struct Bench {
  const Model& model;
  Dynamics dynamics{model};
  State state = model.start_state();
  GeneralisedAlpha method;
  int events = 0;
  double worst_lambda = 0.0;  // largest distance of the own multipliers to those of the state

  Bench(const Model& m, double until, const AlphaOptions& options, double rho = 0.8)
      : model(m), method(dynamics, tolerances(until, rho), options) {
    method.start(state);
  }
  Tolerances tolerances(double until, double rho) {
    REQUIRE(dynamics.assemble(state).ok);
    const SimulationOptions options{
        .until = until, .relative_tolerance = 1e-12, .spectral_radius = rho};
    dynamics.system().set_scales(choose_scales(dynamics.system(), state, options));
    return choose_tolerances(dynamics.system(), options);
  }
  void run(double until) {
    while (method.time() < until) {
      const Step step = method.step(until);
      REQUIRE(step != Step::failed);
      State now = state;
      method.interpolate(method.time(), now);
      if (step == Step::event) handle(now);
      if (step == Step::advanced) compare(now);
    }
    method.interpolate(until, state);
    dynamics.system().bind(state);
  }
  void compare(State& now) {
    REQUIRE(dynamics.calc_accelerations(now));
    for (Eigen::Index i = 0; i < now.lambda.size(); ++i)
      worst_lambda =
          std::max(worst_lambda,
                   std::abs(method.own_multipliers()[static_cast<std::size_t>(i)] - now.lambda[i]));
    dynamics.system().bind(state);
  }
  void handle(const State& now) {
    ++events;
    state = now;
    REQUIRE(dynamics.project(state));
    for (const int fired : method.fired()) {
      const ForceSlot& slot = dynamics.system().forces().back();  // the wall
      std::vector<double> a(static_cast<std::size_t>(slot.columns), 0.0);
      for (int j = 0; j < slot.columns; ++j)
        if (const int dof = dynamics.system().dof()[static_cast<std::size_t>(slot.dofs + j)];
            dof >= 0)
          a[static_cast<std::size_t>(j)] = state.a[dof];
      EventContext context{.input = dynamics.system().force_input(slot),
                           .contact = state.contacts.data() + slot.contacts,
                           .effective_mass = [](const double*) { return 1.0; },
                           .acceleration = a.data(),
                           .dissipate = [](double) {},
                           .record = [](const EventRecord&) {},
                           .fail = [](const std::string& why) { FAIL(why); }};
      slot.element->handle_event(fired - slot.events, context);
    }
    method.start(state);
  }
};

struct Errors {
  double q, v, lambda;
};

Errors errors(const Model& model, double until, const AlphaOptions& options, double rho,
              const State& exact, int events = 0) {
  Bench bench(model, until, options, rho);
  bench.run(until);
  CHECK(bench.events == events);
  double lambda = 0.0;
  for (Eigen::Index i = 0; i < exact.lambda.size(); ++i)
    lambda = std::max(lambda, std::abs(bench.method.own_multipliers()[static_cast<std::size_t>(i)] -
                                       exact.lambda[i]));
  return {(bench.state.q - exact.q).cwiseAbs().maxCoeff(),
          (bench.state.v - exact.v).cwiseAbs().maxCoeff(), lambda};
}

/// Orders of convergence between steps and a sixteenth of them, in the largest errors at some
/// times: at one time alone an error may happen to be small.
Errors orders(const Model& model, const std::vector<double>& times, double h,
              const std::vector<double>& pattern, double rho, int events = 0) {
  Errors coarse{}, fine{};
  for (const double until : times) {
    const State exact =
        simulate(model, {.until = until, .relative_tolerance = 1e-13, .samples = 0}).final;
    const auto add = [&](double factor, Errors& largest) {
      AlphaOptions options;
      for (const double p : pattern) options.steps.push_back(p * h * factor);
      const Errors e = errors(model, until, options, rho, exact, events);
      largest = {std::max(largest.q, e.q), std::max(largest.v, e.v),
                 std::max(largest.lambda, e.lambda)};
    };
    add(1.0, coarse);
    add(1.0 / 16.0, fine);
  }
  const auto order = [](double a, double b) { return 0.25 * std::log2(a / b); };
  return {order(coarse.q, fine.q), order(coarse.v, fine.v), order(coarse.lambda, fine.lambda)};
}

void check_order_two(const Errors& order, double margin) {
  INFO("q ", order.q, " v ", order.v, " lambda ", order.lambda);
  for (const double o : {order.q, order.v, order.lambda}) CHECK(std::abs(o - 2.0) < margin);
}

}  // namespace

TEST_CASE("generalised-alpha is of order 2 in q, v and lambda with steps of one size and of many") {
  const Model model = double_pendulum();
  for (const double rho : {0.0, 0.5, 0.8, 0.95}) {
    for (const std::vector<double>& pattern :
         {std::vector{1.0}, std::vector{0.5, 1.5}, std::vector{1.0, 2.0, 0.3, 0.7}}) {
      INFO(rho, " ", pattern.size());
      check_order_two(orders(model, {1.0}, 1.0 / 256.0, pattern, rho), 0.15);
    }
  }
}

TEST_CASE("generalised-alpha is of order 2 in q, v and lambda across contact events") {
  // Where in a step the events fall makes the constants of q and lambda vary.
  for (const std::vector<double>& pattern : {std::vector{1.0}, std::vector{0.5, 1.5}}) {
    check_order_two(orders(pendulum_at_stop(), {0.4, 0.5, 0.6, 0.7}, 1.0 / 512.0, pattern, 0.8, 2),
                    0.1);
  }
}

TEST_CASE("a start without a and v of its own, or steps that do not rescale them, lose an order") {
  // The own multipliers against those of the state they belong to, at worst over ten steps.
  Model model;
  const double angle = 0.3, omega = 4.0;
  const BodyId rod = model.add(Body{.name = "rod",
                                    .mass = 1.0,
                                    .inertia = 1.0 / 12.0,
                                    .pose = {rotate(angle, {0.5, 0.0}), angle},
                                    .twist = {omega * perp(rotate(angle, {0.5, 0.0})), omega}});
  model.add(Revolute{.name = "pivot", .a = ground, .b = rod});
  model.add(Gravity{.name = "gravity", .acceleration = {0.0, -9.81}});
  const auto worst = [&](double h, const std::vector<double>& pattern, bool plain) {
    AlphaOptions options{.plain = plain};
    for (const double p : pattern) options.steps.push_back(p * h);
    Bench bench(model, 1.0, options);
    bench.run(10.0 * h);
    return bench.worst_lambda;
  };
  for (const std::vector<double>& pattern : {std::vector{1.0}, std::vector{0.5, 1.5}}) {
    const double h = 1e-3;
    const double plain = std::log2(worst(h, pattern, true) / worst(0.25 * h, pattern, true)) / 2.0;
    const double ours = std::log2(worst(h, pattern, false) / worst(0.25 * h, pattern, false)) / 2.0;
    INFO(plain, " ", ours);
    CHECK(plain < 1.3);
    CHECK(ours > 1.8);
    CHECK(worst(h, pattern, false) < 0.1 * worst(h, pattern, true));
  }
}

TEST_CASE(
    "the error of generalised-alpha is proportional to the tolerance, also through contacts") {
  const double exact = -2.3851873498861929707;  // angle of the second rod after 1 s
  const State after =
      simulate(pendulum_at_stop(), {.until = 0.7, .relative_tolerance = 1e-13, .samples = 0}).final;
  for (const double rtol : {1e-4, 1e-5, 1e-6, 1e-7}) {
    INFO(rtol);
    SimulationOptions options{
        .until = 1.0, .relative_tolerance = rtol, .formulation = "generalised-alpha", .samples = 2};
    const double angle = simulate(double_pendulum(), options).final.q[5];
    CHECK(std::abs(angle - exact) < 4.0 * rtol);
    CHECK(std::abs(angle - exact) > 1.0 * rtol);
    options.until = 0.7;
    const Result run = simulate(pendulum_at_stop(), options);
    REQUIRE(run.events.size() == 2);
    CHECK((run.final.q - after.q).cwiseAbs().maxCoeff() < 4.0 * rtol);
    CHECK((run.final.v - after.v).cwiseAbs().maxCoeff() < 40.0 * rtol);
    CHECK((run.final.lambda - after.lambda).cwiseAbs().maxCoeff() < 400.0 * rtol);
  }
}

TEST_CASE("an oscillation too fast for the steps dies out by the spectral radius in each") {
  // At h w = 1e4 both roots are -rho: x_n ~ (c + d n) rho^n.
  const double w = 1e6, h = 1e-2;
  for (const double rho : {0.0, 0.3, 0.6, 0.9}) {
    Model m;
    const BodyId ball =
        m.add(Body{.name = "ball", .mass = 1.0, .inertia = 1.0, .pose = {{1e-3, 0.0}, 0.0}});
    m.add(applied_force("spring", ball, {0.0, 0.0},
                        [w](auto, const auto& b) { return vec(-w * w * b.x, 0.0 * b.y); }));
    Bench bench(m, 1.0, {.steps = {h}}, rho);
    const auto amplitude = [&](int steps) {
      bench.run(h * steps);
      return std::abs(bench.state.q[0]);
    };
    const double early = amplitude(10), late = amplitude(20);
    INFO(rho, " ", early, " ", late);
    if (rho == 0.0) {
      CHECK(late < 1e-9 * 1e-3);
    } else {
      CHECK(std::pow(late / early, 0.1) == doctest::Approx(rho).epsilon(0.12));
    }
  }
}

TEST_CASE("generalised-alpha stays on the constraints to rounding for a hundred thousand steps") {
  const Model model = double_pendulum();
  Bench bench(model, 100.0, {.steps = {1e-3, 1.5e-3}});
  bench.run(100.0);
  CHECK(bench.dynamics.position_violation(bench.state).largest() < 1e-14);
  CHECK(bench.dynamics.velocity_violation(bench.state).largest() < 1e-13);
}

TEST_CASE("element states and energies converge with the motion") {
  Model model = double_pendulum();
  model.add(RelaxingSpring{.name = "maxwell", .body = model.find_body("b")});
  const State exact =
      simulate(model, {.until = 1.0, .relative_tolerance = 1e-13, .samples = 0}).final;
  const auto error = [&](double h) {
    Bench bench(model, 1.0, {.steps = {h, 0.6 * h}});
    bench.run(1.0);
    return std::pair{std::abs(bench.state.z[0] - exact.z[0]),
                     std::abs(bench.state.energy[0] - exact.energy[0])};
  };
  const auto [z, energy] = error(1.0 / 512.0);
  const auto [z_fine, energy_fine] = error(1.0 / 2048.0);
  CHECK(0.5 * std::log2(z / z_fine) == doctest::Approx(2.0).epsilon(0.1));
  CHECK(0.5 * std::log2(energy / energy_fine) > 1.85);
}

TEST_CASE("a spectral radius out of its range is refused") {
  for (const double rho : {-0.1, 1.0, std::nan("")})
    CHECK_THROWS_AS(
        simulate(double_pendulum(),
                 {.until = 1.0, .formulation = "generalised-alpha", .spectral_radius = rho}),
        ModelError);
}

TEST_CASE("generalised-alpha: impacts and ledgers are as good as the tolerance, in proportion") {
  for (const double rtol : {1e-5, 1e-7}) {
    INFO(rtol);
    const Result yoke = simulate(scotch_yoke(), {.until = yoke_period,
                                                 .relative_tolerance = rtol,
                                                 .formulation = "generalised-alpha",
                                                 .samples = 101});
    REQUIRE(yoke.summary.ok());
    CHECK(yoke.summary.events > 20);
    CHECK(yoke.summary.energy_balance < 30.0 * rtol * yoke.summary.energy_exchanged);
    const Result stop =
        simulate(pendulum_at_stop(),
                 {.until = 0.7, .relative_tolerance = rtol, .formulation = "generalised-alpha"});
    REQUIRE(stop.events.size() == 2);
    CHECK(std::abs(stop.events[1].speed / stop.events[0].speed + 1.0) < 10.0 * rtol);
  }
}

TEST_CASE("a tolerance beyond rounding costs generalised-alpha no more steps and no failure") {
  const auto run = [](double rtol) {
    return simulate(double_pendulum({1000.0, -1000.0}, 100), {.until = 0.1,
                                                              .relative_tolerance = rtol,
                                                              .formulation = "generalised-alpha",
                                                              .samples = 2});
  };
  const Result tight = run(1e-11), tightest = run(1e-13);
  REQUIRE(tight.summary.ok());
  REQUIRE(tightest.summary.ok());
  CHECK(tightest.summary.steps < 1.2 * static_cast<double>(tight.summary.steps));
}
