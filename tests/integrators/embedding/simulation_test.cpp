// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The run as an object: stops and looks change nothing, changes and returns do what they say.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <yoke/core/control/event_function.hpp>
#include <yoke/integrators/simulation.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

void check_same(const Result& a, const Result& b) {
  CHECK(a.samples.data() == b.samples.data());
  CHECK(a.contact_samples.data() == b.contact_samples.data());
  CHECK(a.final.q == b.final.q);
  CHECK(a.final.v == b.final.v);
  CHECK(a.final.a == b.final.a);
  CHECK(a.final.lambda == b.final.lambda);
  CHECK(a.final.energy == b.final.energy);
  CHECK(a.final.contacts == b.final.contacts);
  REQUIRE(a.events.size() == b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    CHECK(a.events[i].t == b.events[i].t);
    CHECK(a.events[i].kind == b.events[i].kind);
  }
  CHECK(a.summary.stop == b.summary.stop);
  CHECK(a.summary.reason == b.summary.reason);
  CHECK(a.summary.steps == b.summary.steps);
  CHECK(a.summary.position_drift == b.summary.position_drift);
  CHECK(a.summary.energy_balance == b.summary.energy_balance);
}

/// To the end in pieces of all lengths, with looks and whole steps in between.
Result in_odd_pieces(const Model& model, const SimulationOptions& options, int pieces) {
  Simulation run(model, options);
  for (int i = 1; !run.ended(); ++i) {
    const double piece = options.until / pieces * (1.0 + 0.95 * std::sin(1.0 * i));
    if (i % 5 == 0) {
      run.step();
    } else {
      run.advance_to(std::min(options.until, run.time() + piece));
    }
    if (i % 3 == 0) CHECK(run.state().t == run.time());
    if (i % 7 == 0) CHECK(run.get("t_s") == run.time());
  }
  return run.result();
}

/// Two rods with a torque and a spring that can be changed.
Model changeable() {
  Model m = double_pendulum();
  m.add(AppliedTorque{.name = "motor", .body = m.find_body("a"), .value = 0.0});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = m.find_body("b"),
                            .at_a = {0.0, 2.0},
                            .at_b = {2.0, 0.0},
                            .stiffness = 10.0});
  return m;
}

}  // namespace

TEST_CASE("a run in odd pieces is the run of simulate(), bit for bit") {
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const bool second_order = formulation == "generalised-alpha";
    SimulationOptions options{.until = 3.0,
                              .relative_tolerance = second_order ? 1e-5 : 1e-8,
                              .formulation = formulation,
                              .samples = 301};
    check_same(simulate(double_pendulum(), options),
               in_odd_pieces(double_pendulum(), options, 997));
    options.until = 0.4 * yoke_period;
    options.contact_rows = 3;
    check_same(simulate(scotch_yoke(), options), in_odd_pieces(scotch_yoke(), options, 499));
  }
}

TEST_CASE("in pieces: an event of the user ends the run where it ends in one") {
  Model stopped = double_pendulum();
  stopped.add(EventFunction{.name = "deep",
                            .function = [](const Motion& at) { return -0.9 - at[BodyId{2}].y; },
                            .stop = true});
  const SimulationOptions options{.until = 2.0, .samples = 41};
  const Result whole = simulate(stopped, options);
  CHECK(whole.summary.stop == Stop::by_event);
  check_same(whole, in_odd_pieces(stopped, options, 321));
}

TEST_CASE("what is shown between two steps is on the constraints and agrees with a row") {
  const Model model = double_pendulum();
  const SimulationOptions options{.until = 1.0, .samples = 1001};
  const Result run = simulate(model, options);
  Simulation shown(model, {.until = 1.0, .samples = 0});
  const std::size_t angle = shown.find_output("b.angle_rad");
  const std::size_t reaction = shown.find_output("elbow.fx_N");
  for (const std::size_t row : {std::size_t{137}, std::size_t{500}, std::size_t{999}}) {
    REQUIRE(shown.advance_to(run.samples.value(row, 0)));
    CHECK(shown.output(angle) == doctest::Approx(run.samples.value(row, angle)).epsilon(1e-9));
    CHECK(shown.output(reaction) ==
          doctest::Approx(run.samples.value(row, reaction)).epsilon(1e-7));
    CHECK(shown.state().q[5] == shown.output(angle));
    CHECK(std::abs(shown.get("balance_J")) < 1e-6);
  }
  CHECK(shown.result().samples.rows() == 0);
}

TEST_CASE("a parameter that is set acts from the time shown on, and the ledger closes") {
  // A free wheel: omega' = T / I, exactly.
  Model wheel;
  const BodyId disc = wheel.add(Body{.name = "disc", .mass = 1.0, .inertia = 0.5});
  wheel.add(AppliedTorque{.name = "motor", .body = disc, .value = 0.0});
  Simulation run(wheel, {.until = 3.0, .samples = 31});
  run.advance_to(0.7);
  run.set("motor.torque", 2.0);
  CHECK(run.state().a[2] == 4.0);
  CHECK(run.get("motor.torque") == 2.0);
  run.advance_to(1.3);
  CHECK(run.state().v[2] == doctest::Approx(2.0 * 0.6 / 0.5).epsilon(1e-12));
  run.set("motor.torque", -1.0);
  const Result result = run.finish();
  const double omega = 2.0 * 0.6 / 0.5 - 1.0 * 1.7 / 0.5;
  CHECK(result.final.v[2] == doctest::Approx(omega).epsilon(1e-12));
  CHECK(result["motor.work_J"].tail(1)[0] == doctest::Approx(0.25 * omega * omega).epsilon(1e-10));
  CHECK(result.samples.rows() == 31);
  CHECK(result.summary.energy_balance < 1e-12);
}

TEST_CASE("restored, rewound and forked runs go on alike, bit for bit") {
  const Model model = changeable();
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const bool second_order = formulation == "generalised-alpha";
    Simulation run(model, {.until = 1.5,
                           .relative_tolerance = second_order ? 1e-5 : 1e-8,
                           .formulation = formulation,
                           .samples = 151});
    run.advance_to(0.5173);
    run.set("motor.torque", 3.0);
    run.set("spring.stiffness", 30.0);
    run.advance_to(0.8);
    const Snapshot here = run.snapshot();
    Simulation other = run.fork();
    CHECK(other.time() == 0.8);
    CHECK(other.result().samples.data() == run.result().samples.data());

    run.set("motor.torque", -1.0);
    run.advance_to(1.2);
    run.restore(here);
    CHECK(run.time() == 0.8);
    CHECK(run.state().q == here.state.q);
    run.advance_to(1.5);
    CHECK(run.ended());
    const Result first = run.result();
    run.restore(here);
    CHECK_FALSE(run.ended());
    const Result second = run.finish(), third = other.finish();
    for (const Result* result : {&second, &third}) {
      CHECK(result->samples.data() == first.samples.data());
      CHECK(result->final.q == first.final.q);
      CHECK(result->final.energy == first.final.energy);
    }
    REQUIRE(first.samples.rows() == 151);
    for (std::size_t i = 0; i < 151; ++i)
      CHECK(first.samples.value(i, 0) == 1.5 * (static_cast<double>(i) / 150.0));
    CHECK(first.summary.energy_balance <
          (second_order ? 1e-2 : 1e-5) * first.summary.energy_exchanged);
  }
}

TEST_CASE("a step is taken back and made again with another input") {
  const Model model = changeable();
  Simulation run(model, {.until = 1.0, .samples = 101});
  run.keep_last();
  run.advance_to(0.4);
  run.set("motor.torque", 5.0);
  run.advance_to(0.5);
  const double with = run.get("a.angle_rad");
  run.rewind();
  CHECK(run.time() == 0.4);
  CHECK(run.get("motor.torque") == 5.0);  // what was set before the step is kept
  run.set("motor.torque", 0.0);
  run.advance_to(0.5);
  CHECK(run.get("a.angle_rad") < with);
  run.rewind();
  run.set("motor.torque", 5.0);
  run.advance_to(0.5);
  CHECK(run.get("a.angle_rad") == doctest::Approx(with).epsilon(1e-8));
  run.rewind();
  CHECK(run.step());
  CHECK(run.time() > 0.4);
}

TEST_CASE("contacts: a run is taken back into an impact") {
  const Model model = scotch_yoke();
  Simulation run(model, {.until = 0.4 * yoke_period, .samples = 401});
  while (run.advance_to(run.time() + 1e-4))
    if (run.state().contacts[0].phase == ContactPhase::compressing) break;
  const Snapshot touching = run.snapshot();
  REQUIRE(touching.state.contacts[0].phase == ContactPhase::compressing);
  Simulation other = run.fork();
  const Result first = run.finish();
  const Result second = other.finish();
  CHECK(first.samples.data() != second.samples.data());  // a restart, to the tolerance
  run = Simulation(model, {.until = 0.4 * yoke_period, .samples = 401});
  run.restore(touching);
  CHECK(run.finish().final.q == second.final.q);
  CHECK((first.final.q - second.final.q).cwiseAbs().maxCoeff() < 1e-6);
  CHECK(first.events.size() == second.events.size());
}

TEST_CASE("what a simulation refuses, with option, value and range") {
  const Model model = changeable();
  Simulation run(model, {.until = 1.0});
  run.advance_to(0.5);
  CHECK_THROWS_WITH_AS(run.advance_to(0.4),
                       "advance_to: t = 0.4 s is outside the accepted range 0.5 to 1 s",
                       ModelError);
  CHECK_THROWS_WITH_AS(run.advance_to(1.5),
                       "advance_to: t = 1.5 s is outside the accepted range 0.5 to 1 s",
                       ModelError);
  CHECK_THROWS_WITH_AS(run.set("spring.stiffness", -1.0), doctest::Contains("stiffness = -1 N/m"),
                       ModelError);
  CHECK_THROWS_WITH_AS(run.set("spring.colour", 1.0),
                       doctest::Contains("unknown parameter 'spring.colour': the model has "
                                         "'motor.torque', 'spring.stiffness'"),
                       ModelError);
  CHECK_THROWS_WITH_AS(run.set(std::size_t{17}, 1.0), doctest::Contains("must be less than 4"),
                       ModelError);
  CHECK_THROWS_WITH_AS(run.get("spring.colour"), doctest::Contains("'spring.colour'"), ModelError);
  CHECK_THROWS_WITH_AS(run.output(1000), doctest::Contains("column = 1000"), ModelError);
  CHECK_THROWS_WITH_AS(run.rewind(), doctest::Contains("keep_last()"), ModelError);
  CHECK(run.get("spring.stiffness") == 10.0);
  Snapshot other;
  CHECK_THROWS_AS(run.restore(other), ModelError);
  other = run.snapshot();
  other.state.t = 2.0;
  CHECK_THROWS_WITH_AS(run.restore(other), doctest::Contains("t = 2 s"), ModelError);
  CHECK(run.time() == 0.5);

  TemporaryFolder folder;
  Simulation writing(model, {.until = 1.0, .checkpoints = {.folder = folder.path(), .every = 0.3}});
  writing.advance_to(0.5);
  CHECK_THROWS_WITH_AS(writing.restore(writing.snapshot()), doctest::Contains("checkpoints"),
                       ModelError);
  CHECK(writing.fork().finish().summary.ok());
}

TEST_CASE("a user's function that throws ends the run, and the results so far are kept") {
  Model m = double_pendulum();
  m.add(AppliedTorque{.name = "motor", .body = m.find_body("a"), .torque = [](double t) {
                        if (t > 0.5) throw std::runtime_error("out of order");
                        return 1.0;
                      }});
  Simulation run(m, {.until = 1.0, .samples = 101});
  CHECK_FALSE(run.advance_to(0.9));
  CHECK(run.ended());
  CHECK(run.time() < 0.51);
  CHECK(run.summary().stop == Stop::failed);
  CHECK(run.summary().reason.find("out of order") != std::string::npos);
  CHECK(run.result().samples.rows() > 20);
  CHECK_FALSE(run.step());
}
