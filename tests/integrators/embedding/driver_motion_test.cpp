// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Motions of drivers that are set during a run.
#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include <yoke/core/control/event_function.hpp>
#include <yoke/core/control/sampled_controller.hpp>
#include <yoke/integrators/analyses/state_space.hpp>
#include <yoke/integrators/simulation.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// Two uniform rods of 1 m and 1 kg in a row, the first turned by a driver at 2 rad/s.
Model driven_rods() {
  Model m = double_pendulum();
  m.add(AngleDriver{.name = "motor", .body = BodyId{1}, .speed = 2.0});
  return m;
}

void check_same(const State& a, const State& b) {
  CHECK(a.t == b.t);
  CHECK(a.q == b.q);
  CHECK(a.v == b.v);
  CHECK(a.a == b.a);
  CHECK(a.lambda == b.lambda);
  CHECK(a.energy == b.energy);
  CHECK(a.parameters == b.parameters);
}

}  // namespace

TEST_CASE("a driver's speed that is set is a blow; the angle goes on from where it is") {
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const Model m = driven_rods();
    Simulation run(m, {.until = 1.0, .formulation = formulation, .samples = 11});
    const Eigen::VectorXd before = run.state().v;
    CHECK(before[2] == doctest::Approx(2.0).epsilon(1e-14));
    run.set("motor.speed", 5.0);
    // Rods in a row: the elbow jumps by 3 m/s across. It takes a quarter of the free rod's mass along, and
    // turns it by -3/4 of that over its half length.
    CHECK(run.state().v[2] == doctest::Approx(5.0).epsilon(1e-14));
    CHECK(run.state().v[4] - before[4] == doctest::Approx(3.0 / 4.0).epsilon(1e-12));
    CHECK(run.state().v[5] - before[5] == doctest::Approx(-4.5).epsilon(1e-12));
    run.advance_to(0.5);
    CHECK(run.get("a.angle_rad") == doctest::Approx(2.5).epsilon(1e-13));
    run.set("motor.acceleration", -4.0);
    CHECK(run.state().v[2] == doctest::Approx(5.0).epsilon(1e-13));
    CHECK(run.state().a[2] == doctest::Approx(-4.0).epsilon(1e-12));
    run.advance_to(1.0);
    CHECK(run.get("a.angle_rad") == doctest::Approx(2.5 + 2.5 - 0.5).epsilon(1e-13));
    CHECK(run.get("motor.speed") == doctest::Approx(3.0).epsilon(1e-13));
    CHECK(run.state().v[2] == doctest::Approx(3.0).epsilon(1e-12));
    CHECK(std::abs(run.get("balance_J")) < 1e-4);
    CHECK(run.result().summary.velocity_violation < 1e-12);
  }
}

TEST_CASE("the work of a blow is the kinetic energy it makes") {
  Model m;
  const BodyId wheel = m.add(Body{.name = "wheel", .mass = 1.0, .inertia = 0.5});
  m.add(Revolute{.name = "axle", .a = ground, .b = wheel});
  m.add(AngleDriver{.name = "motor", .body = wheel, .speed = 2.0});
  Simulation run(m, {.until = 2.0, .samples = 0});
  run.advance_to(1.0);
  run.set("motor.speed", -6.0);
  CHECK(run.get("motor.work_J") == doctest::Approx(0.25 * (36.0 - 4.0)).epsilon(1e-12));
  CHECK(run.get("wheel.angle_rad") == doctest::Approx(2.0).epsilon(1e-14));
  run.advance_to(2.0);
  CHECK(run.get("wheel.angle_rad") == doctest::Approx(-4.0).epsilon(1e-14));
}

TEST_CASE("a displacement that is set adds to a function of time, or begins at the start pose") {
  for (const bool with_function : {true, false}) {
    Model m;
    const BodyId cart =
        m.add(Body{.name = "cart", .mass = 1.0, .inertia = 1.0, .pose = {{0.3, 0.0}, 0.0}});
    m.add(Prismatic{.name = "rail", .a = ground, .b = cart, .along = {1.0, 0.0}});
    DisplacementDriver driver{.name = "drive",
                              .body = cart,
                              .at = {0.3, 0.0},
                              .along = {1.0, 0.0},
                              .from = Vec2(0.1, 0.0),
                              .speed = 0.5};
    if (with_function)
      driver.displacement = time_function([](auto t) { return 0.2 + 0.1 * sin(t); });
    m.add(driver);
    Simulation run(m, {.until = 2.0, .samples = 0});
    run.advance_to(1.0);
    run.set("drive.speed", 0.0);
    run.set("drive.acceleration", 2.0);
    run.advance_to(2.0);
    const double swing = with_function ? 0.1 * std::sin(2.0) : 0.0;
    CHECK(run.get("cart.x_m") == doctest::Approx(0.3 + 0.5 + 1.0 + swing).epsilon(1e-13));
    CHECK(run.get("drive.speed") == doctest::Approx(2.0).epsilon(1e-13));
  }
}

TEST_CASE("controllers and events set motions of drivers") {
  Model m = driven_rods();
  m.add(EventFunction{.name = "faster",
                      .function = [](const Motion& at) { return at.t - 0.25; },
                      .set = {{"motor.speed", 4.0}}});
  m.add(EventFunction{.name = "turn back",
                      .function = [](const Motion& at) { return at[BodyId{1}].angle - 1.0; },
                      .action = [](const EventAction& e) { e.parameter("motor.speed") *= -1.0; }});
  int overtaken = 0;
  m.add(EventFunction{.name = "overtaken",
                      .function = [](const Motion& at) { return at[BodyId{1}].omega - 3.0; },
                      .crossing = Crossing::upwards,
                      .action = [&](const EventAction&) { ++overtaken; }});
  const Result run = simulate(m, {.until = 1.0, .samples = 101});
  REQUIRE(run.summary.ok());
  CHECK(overtaken == 1);  // by the blow, at its instant
  REQUIRE(run.events.size() == 3);
  CHECK(run.events[1].element == "overtaken");
  CHECK(run.events[1].t == run.events[0].t);
  CHECK(run.final.q[2] == doctest::Approx(1.0 - 4.0 * (1.0 - 0.375)).epsilon(1e-9));
  CHECK(run.summary.energy_balance < 1e-5 * run.summary.energy_exchanged);
  CHECK(run["faster.work_J"].cwiseAbs().maxCoeff() == 0.0);  // the motor's

  // A speed in steps: the mean of a ramp.
  Model stepped = driven_rods();
  stepped.add(SampledController{
      .name = "plc",
      .period = 0.01,
      .outputs = {"motor.speed"},
      .update = [](const ControllerSample& s) { s.output(0) = 2.0 + 3.0 * s.motion.t; }});
  const Result steps = simulate(stepped, {.until = 1.0, .samples = 11});
  REQUIRE(steps.summary.ok());
  CHECK(steps.final.q[2] == doctest::Approx(2.0 + 1.5 * 0.99).epsilon(1e-11));
  CHECK(steps.summary.energy_balance < 1e-5 * steps.summary.energy_exchanged);
}

TEST_CASE("snapshots, forks and checkpoints keep motions that were set") {
  const Model m = driven_rods();
  Simulation run(m, {.until = 1.0, .samples = 0});
  run.advance_to(0.2);
  run.set("motor.acceleration", 7.0);
  run.advance_to(0.4);
  const Snapshot here = snapshot_from_bytes(to_bytes(run.snapshot()));
  CHECK(here.state.parameters == run.state().parameters);
  CHECK_THROWS_WITH_AS(snapshot_from_bytes({}), doctest::Contains("not a snapshot"), ModelError);
  Simulation other = run.fork();
  run.restore(here);
  run.advance_to(0.9);
  other.advance_to(0.9);
  check_same(run.state(), other.state());
  other.restore(here);
  other.set("motor.acceleration", 0.0);
  other.advance_to(0.9);
  CHECK(run.get("a.angle_rad") - other.get("a.angle_rad") ==
        doctest::Approx(3.5 * 0.25).epsilon(1e-12));

  const TemporaryFolder scratch;
  Model changing = driven_rods();
  changing.add(EventFunction{.name = "faster",
                             .function = [](const Motion& at) { return at.t - 0.3; },
                             .set = {{"motor.speed", 4.0}}});
  SimulationOptions options{.until = 1.0, .samples = 11};
  options.checkpoints = {.folder = scratch.path() / "run", .every = 0.25};
  const Result whole = simulate(changing, options);
  options.checkpoints.folder = scratch.path() / "broken";
  SimulationOptions broken = options;
  broken.observer = [](const Progress& p) { return p.t < 0.6; };
  simulate(changing, broken);
  options.checkpoints.resume = true;
  const Result resumed = simulate(changing, options);
  check_same(whole.final, resumed.final);
  CHECK(whole.samples.data() == resumed.samples.data());
}

TEST_CASE("what a driver cannot do is refused, and nothing has happened") {
  Model m = driven_rods();
  Simulation run(m, {.until = 1.0, .samples = 0});
  run.advance_to(0.5);
  CHECK_THROWS_WITH_AS(run.set("motor.offset", 1.0),
                       "'motor': offset is kept by the element itself and cannot be set",
                       ModelError);
  CHECK_THROWS_WITH_AS(run.set("motor.sped", 1.0),
                       "unknown parameter 'motor.sped': the model has 'motor.speed', "
                       "'motor.acceleration'",
                       ModelError);
  CHECK_THROWS_WITH_AS(run.set("motor.speed", std::nan("")), doctest::Contains("'motor': speed"),
                       ModelError);
  CHECK_THROWS_WITH_AS(state_space(m, m.start_state(), {"motor.speed"}, {}),
                       "state space: input 'motor.speed' sets a motion; inputs are loads and "
                       "parameters of forces",
                       ModelError);
  CHECK_THROWS_WITH_AS(m.add(AngleDriver{.name = "d", .body = BodyId{2}, .speed = INFINITY}),
                       doctest::Contains("angle driver 'd': speed"), ModelError);
  CHECK_THROWS_WITH_AS(m.add(AngleDriver{.name = "d", .body = BodyId{2}}),
                       doctest::Contains("angle driver 'd': angle"), ModelError);

  // Two motors on one shaft: one cannot go another way.
  Model shaft = driven_rods();
  shaft.add(AngleDriver{.name = "second", .body = BodyId{1}, .angle = constant_speed(0.0, 2.0)});
  Simulation held(shaft, {.until = 1.0, .samples = 0});
  held.advance_to(0.5);
  const State before = held.state();
  CHECK_THROWS_WITH_AS(held.set("motor.speed", 3.0),
                       "driver 'motor': speed: another joint or driver prescribes this motion too",
                       ModelError);
  CHECK(held.state().v == before.v);
  CHECK(held.get("motor.speed") == 2.0);
  held.advance_to(1.0);
  CHECK(held.get("a.angle_rad") == doctest::Approx(2.0).epsilon(1e-13));
}

TEST_CASE("events that a blow from outside leads to happen at once, and may end the run") {
  for (const bool throws : {false, true}) {
    Model m = driven_rods();
    m.add(EventFunction{.name = "too fast",
                        .function = [](const Motion& at) { return at[BodyId{1}].omega - 3.0; },
                        .crossing = Crossing::upwards,
                        .action =
                            [throws](const EventAction&) {
                              if (throws) throw std::runtime_error("of a user");
                            },
                        .stop = true});
    Simulation run(m, {.until = 1.0, .samples = 11});
    run.advance_to(0.55);
    run.set("motor.speed", 4.0);
    CHECK(run.ended());
    CHECK(run.time() == 0.55);
    CHECK(run.summary().stop == (throws ? Stop::failed : Stop::by_event));
    const Result result = run.result();
    if (throws) {
      CHECK(contains(result.summary.reason, "of a user"));
      continue;
    }
    REQUIRE(result.events.size() == 1);
    CHECK(result.events[0].t == 0.55);
    CHECK(result.samples.value(result.samples.rows() - 1, 0) == 0.55);
    CHECK(result.final.v[2] == doctest::Approx(4.0).epsilon(1e-13));
  }
}

TEST_CASE("a driver without a speed to be set has no parameters") {
  Model m = double_pendulum();
  m.add(AngleDriver{.name = "motor", .body = BodyId{1}, .angle = constant_speed(0.0, 2.0)});
  CHECK(m.start_state().parameters.empty());
  // The same motion, set or a function of time.
  const Result f = simulate(m, {.until = 1.0}), set = simulate(driven_rods(), {.until = 1.0});
  CHECK((f.final.q - set.final.q).cwiseAbs().maxCoeff() < 1e-9);
}
