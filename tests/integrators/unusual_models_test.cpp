// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Models and options at the edge of what makes sense: each runs, or is refused with a reason.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/gear.hpp>
#include <yoke/joints/weld.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double last(const Result& run, const std::string& column) {
  return run[column](static_cast<Eigen::Index>(run.samples.rows()) - 1);
}

std::string refusal(const Model& model, const SimulationOptions& options) {
  return message_of([&] { simulate(model, options); });
}

/// A uniform rod from p to q, 1 kg/m.
BodyId add_rod(Model& m, const std::string& name, const Vec2& p, const Vec2& q) {
  const Vec2 d = q - p;
  const double l = d.norm();
  return m.add(Body{.name = name,
                    .mass = l,
                    .inertia = l * l * l / 12.0,
                    .pose = {0.5 * (p + q), std::atan2(d.y(), d.x())}});
}

/// Crank and rocker of the same length, upright, so that the coupler stays horizontal.
Model parallelogram() {
  Model m;
  const Vec2 crank_foot(0.0, 0.0), crank_tip(0.0, 0.3), rocker_tip(1.0, 0.3), rocker_foot(1.0, 0.0);
  const BodyId crank = add_rod(m, "crank", crank_foot, crank_tip);
  const BodyId coupler = add_rod(m, "coupler", crank_tip, rocker_tip);
  const BodyId rocker = add_rod(m, "rocker", rocker_foot, rocker_tip);
  m.add(Revolute{.name = "crank foot", .a = ground, .b = crank, .at = crank_foot});
  m.add(Revolute{.name = "crank tip", .a = crank, .b = coupler, .at = crank_tip});
  m.add(Revolute{.name = "rocker tip", .a = coupler, .b = rocker, .at = rocker_tip});
  m.add(Revolute{.name = "rocker foot", .a = ground, .b = rocker, .at = rocker_foot});
  m.add(Gravity{});
  return m;
}

/// The scotch-yoke's pin as a body of its own that turns on the crank.
Model with_roller() {
  const Model fixed = scotch_yoke();
  const double r = 45.0_mm, phi = -31.0_deg, omega = 24.0 * pi;
  const Vec2 tip = rotate(phi, Vec2(r, 0.0));
  Model m;
  const BodyId crank = m.add(fixed.body(fixed.find_body("crank")));
  const BodyId slider = m.add(fixed.body(fixed.find_body("slider")));
  const BodyId roller = m.add(Body{.name = "roller",
                                   .mass = 0.015_kg,
                                   .inertia = 0.48_kg_mm2,
                                   .pose = {tip, 0.2},
                                   .twist = {omega * perp(tip), 5.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank});
  m.add(Revolute{.name = "axle", .a = crank, .b = roller, .at = tip});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(phi, omega)});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  const auto law = [](double K, double n) { return ContactLaw(per_mm(K, n), HuntCrossley{0.32}); };
  m.add(PinInSlot{.name = "slot",
                  .pin = {roller, tip, 7.9_mm},
                  .slot = {slider, arc_slot({.center = m.body(slider).pose.position,
                                             .radius = 60.0_mm,
                                             .direction = pi,
                                             .angle = 120.0_deg,
                                             .half_width = 8.0_mm})},
                  .law = {law(4.914e4, 1.10), law(4.907e4, 1.10), law(3.147e5, 1.28)}});
  return m;
}

}  // namespace

TEST_CASE("a model without bodies runs to its end or is refused, but does not crash") {
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const std::string message = refusal(Model(), {.until = 1.0, .formulation = formulation});
    CHECK((message == "no error" || contains(message, "bod")));
  }
}

TEST_CASE("a state that does not belong to the model is refused") {
  const Model model = double_pendulum();
  CHECK_THROWS_AS(simulate(model, State{}, {.until = 1.0}), ModelError);
  CHECK_THROWS_AS(simulate(model, scotch_yoke().start_state(), {.until = 1.0}), ModelError);
  State state = model.start_state();
  state.q.conservativeResize(3);
  CHECK_THROWS_AS(simulate(model, state, {.until = 1.0}), ModelError);
  state = model.start_state();
  state.v[2] = not_a_number;
  CHECK_THROWS_AS(simulate(model, state, {.until = 1.0}), ModelError);
}

TEST_CASE("a body without joints flies, one without forces rests") {
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    Model m;
    m.add(Body{.name = "free", .mass = 2.0, .inertia = 0.3, .twist = {{1.5, 2.5}, 3.5}});
    const Result straight = simulate(m, {.until = 2.0, .formulation = formulation});
    REQUIRE(straight.summary.ok());
    CHECK(last(straight, "free.angle_rad") == doctest::Approx(7.0).epsilon(1e-12));
    m.add(Gravity{});
    const Result thrown = simulate(m, {.until = 2.0, .formulation = formulation});
    REQUIRE(thrown.summary.ok());
    CHECK(last(thrown, "free.y_m") == doctest::Approx(5.0 - 2.0 * 9.81).epsilon(1e-9));

    Model still;
    still.add(Body{.name = "still", .mass = 2.0, .inertia = 0.3, .pose = {{0.1, 0.2}, 0.3}});
    const Result rest = simulate(still, {.until = 2.0, .formulation = formulation});
    REQUIRE(rest.summary.ok());
    CHECK(last(rest, "still.x_m") == 0.1);
  }
}

TEST_CASE("a closed loop runs; of a link too many in it an equation is left out and named") {
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    Model m = parallelogram();
    m.add(AppliedTorque{
        .name = "push", .body = m.find_body("crank"), .torque = [](double) { return 2.0; }});
    const Result run =
        simulate(m, {.until = 0.4, .relative_tolerance = 1e-9, .formulation = formulation});
    REQUIRE(run.summary.ok());
    CHECK(run["coupler.angle_rad"].cwiseAbs().maxCoeff() < 1e-7);
    CHECK(run.summary.energy_balance < 1e-6 * run.summary.energy_exchanged);

    const BodyId third = add_rod(m, "third", {0.5, 0.0}, {0.5, 0.3});
    m.add(Revolute{.name = "third foot", .a = ground, .b = third, .at = {0.5, 0.0}});
    m.add(Revolute{.name = "third tip", .a = m.find_body("coupler"), .b = third, .at = {0.5, 0.3}});
    const Result three =
        simulate(m, {.until = 0.4, .relative_tolerance = 1e-9, .formulation = formulation});
    REQUIRE(three.summary.ok());
    REQUIRE(three.summary.redundant_equations.size() == 1);
    CHECK(contains(three.summary.redundant_equations[0], "third tip: "));
    CHECK(three["coupler.angle_rad"].cwiseAbs().maxCoeff() < 1e-7);
    CHECK(three.summary.energy_balance < 1e-6 * three.summary.energy_exchanged);
  }
}

TEST_CASE("of a body welded twice the second weld is redundant") {
  Model twice;
  const BodyId a = twice.add(Body{.name = "a", .mass = 1.0, .inertia = 1.0});
  twice.add(Weld{.name = "first", .a = ground, .b = a});
  twice.add(Weld{.name = "second", .a = ground, .b = a});
  const Result run = simulate(twice, {.until = 1.0});
  REQUIRE(run.summary.ok());
  CHECK(run.summary.degrees_of_freedom == 0);
  std::vector<std::string> names = run.summary.redundant_equations;
  std::ranges::sort(names);
  CHECK(names == std::vector<std::string>{"second: rotation", "second: x", "second: y"});
  CHECK(run.summary.not_unique_reactions.size() == 6);
}

TEST_CASE("a gear train turns as one wheel with the reduced inertia") {
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    Model m;
    const double ratios[] = {-0.5, -1.5, 2.5};
    const double inertia[] = {0.11, 0.07, 0.23, 0.05};
    BodyId wheel[4];
    for (int i = 0; i < 4; ++i) {
      const std::string name = "wheel " + std::to_string(i);
      wheel[i] = m.add(Body{
          .name = name, .mass = 1.3, .inertia = inertia[i], .pose = {{0.8 * i, 0.1}, 0.4 * i}});
      m.add(Revolute{.name = name + " axle", .a = ground, .b = wheel[i], .at = {0.8 * i, 0.1}});
    }
    double reduced = inertia[0], speed = 1.0;
    for (int i = 0; i < 3; ++i) {
      m.add(Gear{.name = "mesh " + std::to_string(i),
                 .a = wheel[i],
                 .b = wheel[i + 1],
                 .ratio = ratios[i]});
      speed *= ratios[i];
      reduced += inertia[i + 1] * speed * speed;
    }
    m.add(AppliedTorque{.name = "motor", .body = wheel[0], .torque = [](double) { return 0.7; }});
    const Result run =
        simulate(m, {.until = 1.0, .relative_tolerance = 1e-10, .formulation = formulation});
    REQUIRE(run.summary.ok());
    CHECK(last(run, "wheel 0.alpha_rad_per_s2") == doctest::Approx(0.7 / reduced).epsilon(1e-12));
    CHECK(last(run, "wheel 3.omega_rad_per_s") ==
          doctest::Approx(speed * 0.7 / reduced).epsilon(1e-8));
  }
}

TEST_CASE("masses from a milligram to a thousand tonnes move alike, also side by side") {
  const auto pendulum = [](double first, double second) {
    Model m;
    const BodyId a =
        m.add(Body{.name = "a", .mass = first, .inertia = first / 12.0, .pose = {{0.5, 0.0}, 0.0}});
    const BodyId b = m.add(
        Body{.name = "b", .mass = second, .inertia = second / 12.0, .pose = {{1.5, 0.0}, 0.0}});
    m.add(Revolute{.name = "pivot", .a = ground, .b = a, .at = {0.0, 0.0}});
    m.add(Revolute{.name = "elbow", .a = a, .b = b, .at = {1.0, 0.0}});
    m.add(Gravity{});
    return m;
  };
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const SimulationOptions options{
        .until = 1.0, .relative_tolerance = 1e-10, .formulation = formulation, .samples = 101};
    const double angle = last(simulate(double_pendulum(), options), "b.angle_rad");
    for (const double scale : {1e-6, 1e6}) {
      const Result run = simulate(pendulum(scale, scale), options);
      REQUIRE(run.summary.ok());
      CHECK(last(run, "b.angle_rad") == doctest::Approx(angle).epsilon(1e-7));
    }
    // A mote on a boulder does not disturb it, and the ledger is kept.
    const Result alone = simulate(pendulum(1e6, 1e-6), options);
    const Result heavy_end = simulate(pendulum(1e-6, 1e6), options);
    for (const Result* run : {&alone, &heavy_end}) {
      REQUIRE(run->summary.ok());
      CHECK(run->summary.energy_balance < 1e-7 * run->summary.energy_exchanged);
    }
    Model rod;
    const BodyId a =
        rod.add(Body{.name = "a", .mass = 1e6, .inertia = 1e6 / 12.0, .pose = {{0.5, 0.0}, 0.0}});
    rod.add(Revolute{.name = "pivot", .a = ground, .b = a, .at = {0.0, 0.0}});
    rod.add(Gravity{});
    CHECK(last(alone, "a.angle_rad") ==
          doctest::Approx(last(simulate(rod, options), "a.angle_rad")).epsilon(1e-7));
  }
}

TEST_CASE("a stiff spring holds a mass at its static deflection") {
  for (const std::string& formulation : every_formulation) {
    for (const double k : {1e4, 1e8}) {
      INFO(formulation, " ", k);
      Model m;
      const BodyId mass = m.add(Body{.name = "mass", .mass = 2.0, .inertia = 0.1});
      m.add(Prismatic{.name = "guide", .a = ground, .b = mass, .along = {0.0, 1.0}});
      m.add(TranslationalSpring{.name = "spring",
                                .a = ground,
                                .b = mass,
                                .at_a = {0.0, 1.0},
                                .at_b = {0.0, 0.0},
                                .stiffness = k,
                                .damping = 1.4 * std::sqrt(2.0 * k)});
      m.add(Gravity{});
      const Result run = simulate(
          m, {.until = 0.5, .relative_tolerance = 1e-8, .formulation = formulation, .samples = 11});
      REQUIRE(run.summary.ok());
      CHECK(last(run, "mass.y_m") == doctest::Approx(-2.0 * 9.81 / k).epsilon(1e-3));
    }
  }
}

TEST_CASE("a roller as a body of its own moves the slider as a fixed pin does") {
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const SimulationOptions options{
        .until = 0.02, .relative_tolerance = 1e-11, .formulation = formulation};
    const Result fixed = simulate(scotch_yoke(), options),
                 rolling = simulate(with_roller(), options);
    REQUIRE(rolling.summary.ok());
    CHECK(rolling.events.size() == fixed.events.size());
    CHECK((rolling["slider.x_m"] - fixed["slider.x_m"]).cwiseAbs().maxCoeff() < 1e-9);
    // Without friction nothing changes how the roller turns.
    CHECK((rolling["roller.omega_rad_per_s"].array() - 5.0).abs().maxCoeff() < 1e-9);
    CHECK(rolling.summary.energy_balance < 1e-7 * rolling.summary.energy_exchanged);
  }
}

TEST_CASE("any length of a run, and no, two or odd numbers of samples") {
  const Model model = double_pendulum();
  for (const std::string& formulation : every_formulation) {
    for (const double until : {1e-15, 1e-9, 1e-3, 3.0}) {
      INFO(formulation, " ", until);
      const Result none =
          simulate(model, {.until = until, .formulation = formulation, .samples = 0});
      const Result two =
          simulate(model, {.until = until, .formulation = formulation, .samples = 2});
      const Result seven =
          simulate(model, {.until = until, .formulation = formulation, .samples = 7});
      for (const Result* run : {&none, &two, &seven}) {
        REQUIRE(run->summary.ok());
        CHECK(run->summary.t_end == until);
        CHECK(run->final.t == until);
        CHECK(run->final.q == none.final.q);  // samples do not change the steps
      }
      CHECK(none.samples.rows() == 0);
      REQUIRE(two.samples.rows() == 2);
      REQUIRE(seven.samples.rows() == 7);
      CHECK(two["t_s"](0) == 0.0);
      CHECK(two["t_s"](1) == until);
      CHECK(seven["t_s"](6) == until);
      CHECK(seven["b.x_m"](6) == two["b.x_m"](1));
      CHECK(two["b.x_m"](1) == two.final.q[3]);
    }
    CHECK(refusal(model, {.until = 1.0, .formulation = formulation, .samples = -5}) ==
          "simulation: samples = -5 must be 0 (none) or at least 2");
    CHECK(refusal(model, {.until = INFINITY, .formulation = formulation}) ==
          "simulation: until = inf must be a finite number");
  }
}

TEST_CASE("a driver that stops being a number ends the run by name, with results up to there") {
  const auto driven = [](TimeFunction angle) {
    Model m = double_pendulum();
    m.add(AngleDriver{.name = "motor", .body = m.find_body("a"), .angle = std::move(angle)});
    return m;
  };
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const Result run = simulate(driven(TimeFunction([](double t) {
                                  const double x = t < 0.5 ? 0.0 : not_a_number;
                                  return TimeValue{t + x, 1.0 + x, x};
                                })),
                                {.until = 1.0, .formulation = formulation});
    CHECK(run.summary.stop == Stop::failed);
    CHECK(contains(run.summary.reason, "'motor' gives a value that is not finite"));
    CHECK(run.samples.rows() > 450);
    // A root that ends: the rate goes to infinity before the value does.
    // How close they come before the steps run out is not asked: a million steps at 1e-8.
    const Result root =
        simulate(driven(time_function([](auto t) { return 0.1 * sqrt(0.5 - t); })),
                 {.until = 1.0, .relative_tolerance = 1e-6, .formulation = formulation});
    CHECK(root.summary.stop == Stop::failed);
    CHECK(root.summary.t_end == doctest::Approx(0.5).epsilon(1e-3));
    CHECK((contains(root.summary.reason, "last steps ") ||
           contains(root.summary.reason, "gives a value that is not finite")));
  }
}

TEST_CASE("a driver that throws after a while ends the run there, with its own words") {
  Model m = double_pendulum();
  m.add(AngleDriver{.name = "motor", .body = m.find_body("a"), .angle = [](double t) {
                      if (t > 0.5) throw std::runtime_error("no data beyond 0.5 s");
                      return TimeValue{.value = t, .rate = 1.0};
                    }});
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    Result run;
    CHECK_NOTHROW(run = simulate(m, {.until = 1.0, .formulation = formulation}));
    INFO(run.summary.reason);
    CHECK(run.summary.stop == Stop::failed);
    CHECK(contains(run.summary.reason, "no data beyond 0.5 s"));
    CHECK(run.samples.rows() > 450);
  }
}

TEST_CASE("a driver whose value jumps ends the run; the mechanism is not put somewhere else") {
  Model m = double_pendulum();
  m.add(AngleDriver{.name = "motor", .body = m.find_body("a"), .angle = [](double t) {
                      return TimeValue{.value = t < 0.5 ? 0.0 : 0.3};
                    }});
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const Result run = simulate(m, {.until = 1.0, .formulation = formulation});
    CHECK(run.summary.stop == Stop::failed);
    CHECK(run.summary.t_end == doctest::Approx(0.5).epsilon(0.05));
  }
}

TEST_CASE("a user's function that throws during a run ends it with what was computed") {
  Model m = double_pendulum();
  m.add(AppliedTorque{.name = "broken", .body = m.find_body("a"), .torque = [](double t) {
                        if (t > 0.5) throw std::runtime_error("no data beyond 0.5 s");
                        return 0.1;
                      }});
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    Result run;
    CHECK_NOTHROW(run = simulate(m, {.until = 1.0, .formulation = formulation}));
    CHECK(run.summary.stop == Stop::failed);
    CHECK(contains(run.summary.reason, "no data beyond 0.5 s"));
    CHECK(run.samples.rows() > 450);
  }
}

TEST_CASE("implicit steps do not slow down after many turns of the crank") {
  for (const double rtol : {1e-9, 1e-11}) {
    INFO(rtol);
    const SimulationOptions options{
        .until = yoke_period, .relative_tolerance = rtol, .formulation = "ida-ggl"};
    const Result first = simulate(scotch_yoke(), options);
    const Result later = simulate(scotch_yoke({.start_angle = -31.0_deg + 200.0 * pi}), options);
    REQUIRE(later.summary.ok());
    CHECK(later.summary.steps < 3 * first.summary.steps);
  }
}
