// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <yoke/tests/docs/simulation_example.hpp>
#include <yoke/tests/documentation.hpp>

TEST_CASE("the code in docs/simulation.md is compiled here and does what it says") {
  yoke::tests::check_blocks("docs/simulation.md", "cpp", 12, {"tests/docs/simulation_example.hpp"});

  using namespace yoke;
  namespace example = simulation_example;
  const Model crane = example::crane();
  const double force = example::force_for(crane, 0.25);
  CHECK(example::push(crane, force) == doctest::Approx(0.25).epsilon(1e-8));

  Simulation run(crane, {.until = 2.0, .samples = 0});
  run.set("motor.fx", 4.0);
  run.advance_to(0.3);
  const double best = example::best_force(run, {-4.0, 0.0, 4.0}, 0.2);
  CHECK(run.time() == 0.3);
  const auto swing = [&](double candidate) {
    Simulation trial = run.fork();
    trial.set("motor.fx", candidate);
    trial.advance_to(0.5);
    return std::abs(trial.get("load.angle_rad"));
  };
  for (const double other : {-4.0, 0.0, 4.0}) CHECK(swing(best) <= swing(other));

  const Result controlled = simulate(example::controlled_crane(), {.until = 8.0, .samples = 9});
  REQUIRE(controlled.summary.ok());
  CHECK(controlled["carriage.x_m"].tail(1)[0] == doctest::Approx(0.3).epsilon(0.05));

  const Result struck = simulate(example::struck_crane(), {.until = 60.0});
  CHECK(struck.summary.stop == Stop::by_event);
  REQUIRE(struck.events.size() > 2);
  CHECK(struck.events.back().element == "high");
  CHECK(struck.summary.energy_balance < 1e-4 * struck.summary.energy_exchanged);

  CHECK(example::real_time(crane, 0.05) < 1e-3);
}

TEST_CASE("docs/simulation.md: two halves converge with the square of their exchange step") {
  // The relative motion swings with omega^2 = 2 k / m, the centre moves with 0.25 m/s.
  const double omega = std::sqrt(40.0), until = 1.0;
  const double exact = 0.25 * until - 0.25 * std::sin(omega * until) / omega;
  const double coarse = std::abs(simulation_example::two_halves(until, 0.02) - exact);
  const double fine = std::abs(simulation_example::two_halves(until, 0.01) - exact);
  CHECK(coarse < 1e-3);
  CHECK(std::log2(coarse / fine) == doctest::Approx(2.0).epsilon(0.1));
}

TEST_CASE("docs/simulation.md: matrices of the crane") {
  using namespace yoke;
  const Model crane = simulation_example::crane();
  // Hanging at rest nothing has to be held.
  State state = crane.start_state();
  CHECK(std::abs(simulation_example::holding_force(crane, state)) < 1e-12);
  const StateSpace plant = simulation_example::plant(crane);
  REQUIRE(plant.A.rows() == 4);
  // Pushed slowly the whole mass of 2.5 kg is moved; at once what the hook does not yet pull.
  const double at_once = (plant.C * plant.A * plant.B)(0, 0);
  const double held = 2.5 - 0.5 * 0.5 * 0.4 * 0.4 / (1.0e-3 + 0.5 * 0.4 * 0.4);
  CHECK(at_once == doctest::Approx(1.0 / held).epsilon(1e-8));
  // The farther the load swings, the more of it is pushed along.
  Simulation run(crane, {.until = 0.5, .samples = 0});
  run.set("motor.fx", 20.0);
  double swing = 0.0;
  for (int i = 0; i < 50; ++i) {
    run.advance_to(0.01 * i);
    swing = std::max(swing, std::abs(run.get("load.angle_rad")));
  }
  CHECK(swing > 0.5);
  const double pushed = 2.5 - std::pow(0.5 * 0.4 * std::cos(swing), 2) / (1.0e-3 + 0.5 * 0.4 * 0.4);
  CHECK(simulation_example::weakest_answer(crane, 0.5) ==
        doctest::Approx(1.0 / pushed).epsilon(1e-6));
}

TEST_CASE("docs/simulation.md: motors that are switched, walls that are changed") {
  namespace example = simulation_example;
  CHECK(example::switched_crank() == doctest::Approx(10.0 + 30.0 + 15.0).epsilon(1e-12));
  // The ball falls 1 m, and comes back to e^2 of it.
  CHECK(example::bounce(0.5) == doctest::Approx(0.25).epsilon(1e-3));
  CHECK(example::bounce(0.7) == doctest::Approx(0.49).epsilon(1e-3));
}

namespace {

/// Mode by mode: beta tan(beta) = m / M, omega = beta sqrt(E A / (m L)), in the metric of mass and rod.
double mass_on_rod_exactly(double t) {
  constexpr double m = 0.3, v = 0.1, pi = 3.14159265358979323846;
  double x = 0.0;
  for (int i = 0; i < 400; ++i) {
    double low = i * pi, high = (i + 0.5) * pi;  // the tangent rises from 0 to infinity
    while (high - low > 1e-15 * high) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (middle * std::tan(middle) > m ? high : low) = middle;
    }
    const double beta = 0.5 * (low + high), s = std::sin(beta),
                 omega = beta * std::sqrt(2000.0 / m);
    const double modal = s * s + m * (0.5 - std::sin(2.0 * beta) / (4.0 * beta));
    x += v * s * s / (omega * modal) * std::sin(omega * t);
  }
  return x;
}

}  // namespace

TEST_CASE("docs/simulation.md: a rod of finite differences converges with its cells") {
  const double t = 0.05, exact = mass_on_rod_exactly(t);
  CHECK(exact > 1e-3);
  const double coarse = std::abs(simulation_example::mass_on_rod(t, 50) - exact);
  const double fine = std::abs(simulation_example::mass_on_rod(t, 100) - exact);
  CHECK(coarse < 0.02 * exact);
  CHECK(fine < 0.6 * coarse);
}
