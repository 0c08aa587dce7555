// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in docs/simulation.md, block by block. simulation_test.cpp compares and runs it.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>
#include <vector>

#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/contact/laws/dissipative/exact_restitution.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/core/control/event_function.hpp>
#include <yoke/core/control/sampled_controller.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/integrators/analyses/mechanics.hpp>
#include <yoke/integrators/analyses/state_space.hpp>
#include <yoke/integrators/simulation.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

namespace simulation_example {

using namespace yoke;
using namespace yoke::literals;

// A pendulum on a carriage that a motor pushes along a rail.
Model crane() {
  Model m;
  const BodyId carriage = m.add({.name = "carriage", .mass = 2.0_kg, .inertia = 0.01_kg_m2});
  const BodyId load = m.add({.name = "load",
                             .mass = 0.5_kg,
                             .inertia = 1.0e-3_kg_m2,
                             .pose = {.position = {0.0, -400.0_mm}}});
  m.add(Gravity{});
  m.add(Prismatic{.name = "rail", .a = ground, .b = carriage, .along = {1.0, 0.0}});
  m.add(Revolute{.name = "hook", .a = carriage, .b = load, .at = {0.0, 0.0}});
  m.add(AppliedForce{.name = "motor", .body = carriage, .value = Vec2(0.0, 0.0)});
  return m;
}

// Pushed for half a second, then left alone: where is the carriage after two seconds?
double push(const Model& model, double force) {
  Simulation run(model, {.until = 2.0, .samples = 0});
  run.set("motor.fx", force);
  run.advance_to(0.5);
  run.set("motor.fx", 0.0);
  run.advance_to(2.0);
  return run.get("carriage.x_m");
}

// The force that brings the carriage to `wanted` [m]: secants of a program of one's own.
double force_for(const Model& model, double wanted) {
  double a = 1.0, b = 2.0, x_a = push(model, a), x_b = push(model, b);
  while (std::abs(x_b - wanted) > 1e-9) {
    const double next = b + (wanted - x_b) * (b - a) / (x_b - x_a);
    a = b, x_a = x_b;
    b = next, x_b = push(model, b);
  }
  return b;
}

// What is best from here on? Each candidate is tried in a copy of the run.
double best_force(Simulation& run, const std::vector<double>& candidates, double horizon) {
  double best = 0.0, least = 1e300;
  for (const double force : candidates) {
    Simulation trial = run.fork();
    trial.set("motor.fx", force);
    trial.advance_to(run.time() + horizon);
    const double swing = std::abs(trial.get("load.angle_rad"));
    if (swing < least) least = swing, best = force;
  }
  return best;
}

// A PID controller at 1 kHz that takes the carriage to x = 0.3 m.
Model controlled_crane() {
  Model m = crane();
  const BodyId carriage = m.find_body("carriage");
  m.add(SampledController{.name = "pid",
                          .period = 1e-3,
                          .outputs = {"motor.fx"},
                          .memory = {{"integral", "m s"}},
                          .update = [carriage](const ControllerSample& s) {
                            const double error = 0.3 - s.motion[carriage].x;
                            s.memory(0) += error * s.period;
                            s.output(0) =
                                60.0 * error + 10.0 * s.memory(0) - 30.0 * s.motion[carriage].vx;
                          }});
  return m;
}

// A hammer strikes the load at 0.1 s, and each time it comes through the middle from the left, until
// it swings up to the height of the hook.
Model struck_crane() {
  Model m = crane();
  const BodyId carriage = m.find_body("carriage"), load = m.find_body("load");
  const auto strike = [load](const EventAction& e) { e.impulse(load, {0.2, 0.0}, 0.0); };
  m.add(EventFunction{.name = "first blow",
                      .function = [](const Motion& at) { return at.t - 0.1; },
                      .action = strike});
  m.add(EventFunction{.name = "hammer",
                      .function = [=](const Motion& at) { return at[load].x - at[carriage].x; },
                      .crossing = Crossing::upwards,
                      .action = strike});
  m.add(EventFunction{.name = "high",
                      .function = [=](const Motion& at) { return at[load].y - at[carriage].y; },
                      .crossing = Crossing::upwards,
                      .stop = true});
  return m;
}

// Two masses with a spring between them, computed in two programs that exchange the spring's force
// every `exchange` seconds. Each repeats its step with the mean of the forces before and after it.
double two_halves(double until, double exchange) {
  const auto half = [](double x, double v) {
    Model m;
    const BodyId mass = m.add({.name = "mass",
                               .mass = 1.0_kg,
                               .inertia = 1.0_kg_m2,
                               .pose = {.position = {x, 0.0}},
                               .twist = {.velocity = {v, 0.0}}});
    m.add(AppliedForce{.name = "spring", .body = mass, .at = {x, 0.0}, .value = Vec2(0.0, 0.0)});
    return m;
  };
  const Model left_model = half(0.0, 0.0), right_model = half(1.0, 0.5);
  const SimulationOptions options{.until = until, .samples = 0};
  Simulation left(left_model, options), right(right_model, options);
  const auto force = [&] { return 20.0 * (right.state().q[0] - left.state().q[0] - 1.0); };
  const auto step_to = [&](double t, double f) {
    left.set("spring.fx", f);
    right.set("spring.fx", -f);
    left.advance_to(t);
    right.advance_to(t);
  };
  left.keep_last();
  right.keep_last();
  const long steps = std::lround(until / exchange);
  for (long i = 1; i <= steps; ++i) {
    const double t = until * static_cast<double>(i) / static_cast<double>(steps);
    const double before = force();
    step_to(t, before);
    const double after = force();
    left.rewind();
    right.rewind();
    step_to(t, 0.5 * (before + after));
  }
  return left.state().q[0];
}

// A crank whose motor is switched to another speed and then braked to rest. Returns how far it has turned.
double switched_crank() {
  Model m;
  const BodyId crank = m.add({.name = "crank", .mass = 1.0_kg, .inertia = 0.02_kg_m2});
  m.add(Revolute{.name = "axle", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(AngleDriver{.name = "motor", .body = crank, .speed = 10.0});
  Simulation run(m, {.until = 3.0, .samples = 0});
  run.advance_to(1.0);
  run.set("motor.speed", 30.0);  // a blow: motor.work_J grows by 8 J
  run.advance_to(2.0);
  run.set("motor.acceleration", -30.0);  // none
  run.advance_to(3.0);
  return run.get("crank.angle_rad");
}

// A ball falls on a floor whose restitution is chosen while it is in the air. Returns the height to which
// it comes back.
double bounce(double restitution) {
  Model m;
  const BodyId ball = m.add(
      {.name = "ball", .mass = 0.1_kg, .inertia = 1.0e-5_kg_m2, .pose = {.position = {0.0, 1.02}}});
  m.add(Gravity{});
  m.add(
      DiscOnCurve{.name = "floor",
                  .disc = {.body = ball, .at = {0.0, 1.02}, .radius = 20.0_mm},
                  .body = ground,
                  .curve = straight_line({-1.0, 0.0}, {1.0, 0.0}),
                  .law = ContactLaw{per_mm(49070.0, 1.1), changeable(ExactRestitution{.e = 0.9})}});
  Simulation run(m, {.until = 2.0, .samples = 0});
  run.advance_to(0.2);
  run.set("floor.restitution", restitution);
  run.advance_to(0.47);  // on its way up
  const double vy = run.get("ball.vy_m_per_s");
  return run.get("ball.y_m") + vy * vy / (2.0 * 9.81) - 0.02;
}

// A mass on a rod that a program of one's own computes by finite differences: u_tt = (E A / m) u_xx, its far
// end fixed. The program sets the rod's force on the mass and reads where the mass is.
double mass_on_rod(double until, int cells) {
  constexpr double length = 1.0, EA = 2000.0, rod_mass = 0.3;  // [m, N, kg]
  Model m;
  const BodyId mass = m.add(
      {.name = "mass", .mass = 1.0_kg, .inertia = 1.0_kg_m2, .twist = {.velocity = {0.1, 0.0}}});
  m.add(AppliedForce{.name = "rod", .body = mass, .at = {0.0, 0.0}, .value = Vec2(0.0, 0.0)});
  Simulation run(m, {.until = until, .samples = 0});

  const double dx = length / cells, dt = 0.5 * dx * std::sqrt(rod_mass / length / EA);
  const double slope = EA / (rod_mass / length * dx * dx);
  std::vector<double> u(static_cast<std::size_t>(cells) + 1), rate(u.size());
  while (!run.ended()) {
    const double h = std::min(dt, until - run.time());
    u[0] = run.state().q[0];
    run.set("rod.fx", EA * (u[1] - u[0]) / dx);
    for (std::size_t i = 1; i + 1 < u.size(); ++i)
      rate[i] += h * slope * (u[i + 1] - 2.0 * u[i] + u[i - 1]);
    for (std::size_t i = 1; i + 1 < u.size(); ++i) u[i] += h * rate[i];
    run.advance_to(std::min(until, run.time() + h));
  }
  return run.state().q[0];
}

// In real time: a step of a millisecond each millisecond. Returns the least time that was left [s].
double real_time(const Model& model, double until) {
  using Clock = std::chrono::steady_clock;
  Simulation run(model, {.until = until, .samples = 0});
  const auto began = Clock::now();
  double least = 1.0;
  while (!run.ended()) {
    run.advance_to(std::min(until, run.time() + 1e-3));
    const auto due = began + std::chrono::duration<double>(run.time());
    const double margin = std::chrono::duration<double>(due - Clock::now()).count();
    least = std::min(least, margin);
    std::this_thread::sleep_until(due);
  }
  std::printf("least margin %.3f ms of 1 ms\n", 1e3 * least);
  return least;
}

// The force on the carriage under which the load does not begin to turn.
double holding_force(const Model& model, const State& state) {
  Mechanics mechanics(model);
  mechanics.at(state);
  Eigen::VectorXd F = Eigen::VectorXd::Zero(mechanics.coordinates()), a(F.size());
  Eigen::VectorXd lambda(mechanics.equations());
  const auto turning = [&](double force) {
    F[0] = force;
    mechanics.accelerations(F, a, lambda);
    return a[5];
  };
  const double at_0 = turning(0.0), at_1 = turning(1.0);  // linear in the force
  return -at_0 / (at_1 - at_0);
}

// From the motor to the carriage's position about the hanging load.
StateSpace plant(const Model& model) {
  return state_space(model, model.start_state(), {"motor.fx"}, {"carriage.x_m"});
}

// The carriage's acceleration for a newton more of the motor [m/s^2], looked at every 10 ms of a run in which
// the motor pushes and the load swings: the least.
double weakest_answer(const Model& model, double until) {
  Simulation run(model, {.until = until, .samples = 0});
  LinearPlant plant(model, {"motor.fx"}, {"carriage.x_m"});
  run.set("motor.fx", 20.0);
  double least = 1e300;
  while (!run.ended()) {
    plant.at(run.state());
    least = std::min(least, (plant.C() * plant.A() * plant.B())(0, 0));
    run.advance_to(std::min(until, run.time() + 0.01));
  }
  return least;
}

}  // namespace simulation_example
