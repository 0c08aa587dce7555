// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Controllers that sample, and blows at events.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include <yoke/core/control/event_function.hpp>
#include <yoke/core/control/sampled_controller.hpp>
#include <yoke/integrators/simulation.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

constexpr double mass = 2.0, period = 0.01;

/// A free mass that a PID controller brings to x = 0.
Model controlled_mass() {
  Model m;
  const BodyId b =
      m.add(Body{.name = "mass", .mass = mass, .inertia = 1.0, .pose = {{1.0, 0.0}, 0.0}});
  m.add(AppliedForce{.name = "push", .body = b, .at = {1.0, 0.0}, .value = Vec2(0.0, 0.0)});
  m.add(SampledController{.name = "pid",
                          .period = period,
                          .outputs = {"push.fx"},
                          .memory = {{"integral", "m s"}},
                          .update = [b](const ControllerSample& s) {
                            s.memory(0) += s.motion[b].x * s.period;
                            s.output(0) =
                                -8.0 * s.motion[b].x - 3.0 * s.motion[b].vx - 0.5 * s.memory(0);
                          }});
  return m;
}

/// Position at sample k, by the recursion of a force that holds.
std::vector<double> exact_positions(int samples) {
  double x = 1.0, v = 0.0, integral = 0.0;
  std::vector<double> all;
  for (int k = 0; k <= samples; ++k) {
    all.push_back(x);
    integral += x * period;
    const double a = (-8.0 * x - 3.0 * v - 0.5 * integral) / mass;
    x += period * v + 0.5 * period * period * a;
    v += period * a;
  }
  return all;
}

}  // namespace

TEST_CASE("a sampled controller is called exactly on time and its output holds") {
  const std::vector<double> exact = exact_positions(100);
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const Result run =
        simulate(controlled_mass(), {.until = 1.0, .formulation = formulation, .samples = 101});
    REQUIRE(run.summary.ok());
    REQUIRE(run.samples.rows() == 101);
    double worst = 0.0;
    for (std::size_t i = 0; i <= 100; ++i)
      worst = std::max(worst, std::abs(run.samples.value(i, 1) - exact[i]));
    const bool one_step = formulation.starts_with("arkode") || formulation == "generalised-alpha";
    CHECK(worst < (one_step ? 1e-14 : 1e-7));
    const Model model = controlled_mass();
    CHECK(run.final.parameters[model.find_parameter("pid.samples")] == 100.0);
    CHECK(run.summary.energy_balance < 1e-6);
  }
}

TEST_CASE("sample times do not drift, begin at the offset, and number themselves") {
  std::vector<double> times;
  std::vector<long> numbers;
  Model m = double_pendulum();
  m.add(SampledController{
      .name = "clock", .period = 0.1, .offset = 0.05, .update = [&](const ControllerSample& s) {
        times.push_back(s.motion.t);
        numbers.push_back(s.number);
      }});
  const Result with = simulate(m, {.until = 2.0});
  REQUIRE(times.size() == 20);
  for (std::size_t k = 0; k < 20; ++k) {
    CHECK(times[k] == 0.05 + static_cast<double>(k) * 0.1);
    CHECK(numbers[k] == static_cast<long>(k));
  }
  // Nothing changes: no restart, and the motion is that without to the tolerance.
  const Result without = simulate(double_pendulum(), {.until = 2.0});
  CHECK((with.final.q - without.final.q).cwiseAbs().maxCoeff() < 1e-6);
  CHECK(with.summary.steps < without.summary.steps + 25);

  // A run that starts later begins with the next sample.
  times.clear();
  State start = m.start_state();
  start.t = 1.0;
  simulate(m, start, {.until = 1.3});
  CHECK(times == std::vector<double>{0.05 + 10 * 0.1, 0.05 + 11 * 0.1, 0.05 + 12 * 0.1});
}

TEST_CASE("a controlled run in pieces, restored, and resumed is the same run") {
  const Model model = controlled_mass();
  const SimulationOptions options{.until = 0.5, .samples = 77};
  const Result whole = simulate(model, options);
  Simulation run(model, options);
  Snapshot middle;
  for (int i = 1; !run.ended(); ++i) {
    run.advance_to(std::min(0.5, run.time() + 0.003 * (1.0 + 0.9 * std::sin(i))));
    if (i == 60) middle = run.snapshot();
  }
  const Result pieces = run.result();
  CHECK(pieces.samples.data() == whole.samples.data());
  CHECK(pieces.final.parameters == whole.final.parameters);
  run.restore(middle);
  const Result again = run.finish();
  const std::size_t taken = model.find_parameter("pid.samples");
  CHECK(again.final.parameters[taken] == whole.final.parameters[taken]);
  CHECK(again.final.q[0] == doctest::Approx(whole.final.q[0]).epsilon(1e-12));

  TemporaryFolder folder;
  SimulationOptions checked = options;
  checked.checkpoints = {.folder = folder.path(), .every = 0.105};
  const Result uninterrupted = simulate(model, checked);
  checked.observer = [](const Progress& p) { return p.t < 0.3; };
  CHECK(simulate(model, checked).summary.stop == Stop::interrupted);
  const Result resumed = resume(model, folder.path());
  CHECK(resumed.final.q == uninterrupted.final.q);
  CHECK(resumed.final.parameters == uninterrupted.final.parameters);
}

TEST_CASE("a controller may change stored energy, counted as its work, and stop the run") {
  Model m;
  const BodyId b = m.add(Body{.name = "b", .mass = 1.0, .inertia = 1.0, .pose = {{1.5, 0.0}, 0.0}});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = b,
                            .at_b = {1.5, 0.0},
                            .stiffness = 40.0,
                            .free_length = 1.0});
  m.add(SampledController{.name = "gait",
                          .period = 0.25,
                          .outputs = {"spring.stiffness"},
                          .update = [](const ControllerSample& s) {
                            s.output(0) = s.number % 2 == 0 ? 40.0 : 90.0;
                            if (s.number == 7) s.stop();
                          }});
  const Result run = simulate(m, {.until = 10.0, .samples = 101});
  CHECK(run.summary.stop == Stop::by_event);
  CHECK(run.summary.t_end == 1.75);
  CHECK(run.summary.energy_balance < 1e-6);
  CHECK(std::abs(run["gait.work_J"].tail(1)[0]) > 0.1);
}

TEST_CASE("controllers that cannot be are refused by name, value and range") {
  Model m = controlled_mass();
  const auto update = [](const ControllerSample&) {};
  CHECK_THROWS_WITH_AS(m.add(SampledController{.name = "c", .period = 0.0, .update = update}),
                       doctest::Contains("controller 'c': period = 0 s must be finite and greater"),
                       ModelError);
  CHECK_THROWS_WITH_AS(m.add(SampledController{.name = "c", .period = 1.0}),
                       "controller 'c': it has no update", ModelError);
  CHECK_THROWS_WITH_AS(m.add(SampledController{
                           .name = "c", .period = 1.0, .outputs = {"pull.fx"}, .update = update}),
                       doctest::Contains("unknown parameter 'pull.fx': the model has 'push.fx'"),
                       ModelError);
  // What it sets is checked when it has been set.
  Model bad = controlled_mass();
  bad.add(TranslationalSpring{
      .name = "spring", .a = ground, .b = BodyId{1}, .at_b = {1.0, 0.0}, .stiffness = 1.0});
  bad.add(SampledController{.name = "c",
                            .period = 0.1,
                            .outputs = {"spring.stiffness"},
                            .update = [](const ControllerSample& s) { s.output(0) = -1.0; }});
  const Result run = simulate(bad, {.until = 1.0});
  CHECK(run.summary.stop == Stop::failed);
  CHECK(run.summary.reason.find("stiffness = -1 N/m") != std::string::npos);
}

TEST_CASE("a blow changes velocities as the joints allow, and its energy is counted") {
  // Two uniform rods of 1 kg and 1 m hanging in a row, and an impulse J across the end of the lower.
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    Model m;
    const BodyId a = m.add(
        Body{.name = "a", .mass = 1.0, .inertia = 1.0 / 12.0, .pose = {{0.0, -0.5}, -0.5 * pi}});
    const BodyId b = m.add(
        Body{.name = "b", .mass = 1.0, .inertia = 1.0 / 12.0, .pose = {{0.0, -1.5}, -0.5 * pi}});
    m.add(Revolute{.name = "pivot", .a = ground, .b = a, .at = {0.0, 0.0}});
    m.add(Revolute{.name = "elbow", .a = a, .b = b, .at = {0.0, -1.0}});
    m.add(Gravity{});
    const double J = 0.3;
    // At the centre of b and about it: together J across its lower end.
    m.add(EventFunction{.name = "blow",
                        .function = [](const Motion& at) { return at.t - 0.2; },
                        .action =
                            [b, J](const EventAction& e) {
                              e.impulse(b, {J, 0.0}, 0.5 * J);
                            }});
    Simulation run(m, {.until = 0.5, .formulation = formulation, .samples = 51});
    run.advance_to(0.2);
    // [4/3 1/2; 1/2 1/3] (omega_a, omega_b) = (J, J); the work is half of J times the end's speed.
    const double det = 4.0 / 9.0 - 0.25;
    CHECK(run.state().v[2] == doctest::Approx((1.0 / 3.0 - 0.5) * J / det).epsilon(1e-10));
    CHECK(run.state().v[5] == doctest::Approx((4.0 / 3.0 - 0.5) * J / det).epsilon(1e-10));
    const Result result = run.finish();
    REQUIRE(result.summary.ok());
    const double energy = 0.5 * J * (1.0 / 3.0 - 0.5 + 4.0 / 3.0 - 0.5) * J / det;
    CHECK(result["blow.work_J"].tail(1)[0] == doctest::Approx(energy).epsilon(1e-8));
    CHECK(result.summary.energy_balance < 1e-5);
    CHECK(result.summary.velocity_violation < 1e-13);
  }
}

TEST_CASE("what a blow takes across zero has happened") {
  Model m;
  const BodyId b = m.add(Body{.name = "b", .mass = 2.0, .inertia = 1.0});
  int fast = 0;
  m.add(EventFunction{.name = "fast",
                      .function = [b](const Motion& at) { return at[b].vx - 1.0; },
                      .crossing = Crossing::upwards,
                      .action = [&](const EventAction&) { ++fast; }});
  m.add(EventFunction{.name = "blow",
                      .function = [](const Motion& at) { return at.t - 0.5; },
                      .action =
                          [b](const EventAction& e) {
                            e.impulse(b, {6.0, 0.0}, 0.0);
                          }});
  const Result run = simulate(m, {.until = 1.0});
  CHECK(fast == 1);
  CHECK(run.final.q[0] == doctest::Approx(1.5).epsilon(1e-12));
  REQUIRE(run.events.size() == 2);
  CHECK(run.events[1].element == "fast");
  CHECK(run.events[1].t == run.events[0].t);

  Model bad;
  bad.add(Body{.name = "b", .mass = 2.0, .inertia = 0.0});
  bad.add(EventFunction{.name = "twist",
                        .function = [](const Motion& at) { return at.t - 0.5; },
                        .action =
                            [b](const EventAction& e) {
                              e.impulse(b, {0.0, 0.0}, 1.0);
                            }});
  bad.add(Prismatic{.name = "guide", .a = ground, .b = b, .along = {1.0, 0.0}});
  const Result failed = simulate(bad, {.until = 1.0});
  CHECK(failed.summary.stop == Stop::failed);
  CHECK(failed.summary.reason.find("impulse on 'b': inertia = 0 kg m^2 must be") !=
        std::string::npos);
}
