// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include <yoke/core/control/event_function.hpp>
#include <yoke/core/units.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

constexpr double mass = 1.3, stiffness = 52.0, amplitude = 0.2;
const double omega = std::sqrt(stiffness / mass);

/// x = 1 + amplitude cos(omega t): a mass on a spring that is relaxed at x = 1.
Model oscillator() {
  Model m;
  const BodyId b = m.add(
      Body{.name = "mass", .mass = mass, .inertia = 1.0, .pose = {{1.0 + amplitude, 0.0}, 0.0}});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = b,
                            .at_a = {0.0, 0.0},
                            .at_b = {1.0 + amplitude, 0.0},
                            .stiffness = stiffness,
                            .free_length = 1.0});
  return m;
}

std::function<double(const Motion&)> position_minus(double x) {
  return [x](const Motion& at) { return at[BodyId{1}].x - x; };
}

SimulationOptions options(std::string_view formulation, double until) {
  return {.until = until, .relative_tolerance = 1e-10, .formulation = std::string(formulation)};
}

/// How far an event may be off: what the method can do at this tolerance.
double bar(std::string_view formulation) {
  return formulation == "generalised-alpha" ? 1e-5 : 1e-8;
}

}  // namespace

TEST_CASE("a user's event is located and recorded, in the direction asked for") {
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    Model m = oscillator();
    m.add(EventFunction{.name = "half way", .function = position_minus(1.0 + 0.5 * amplitude)});
    m.add(EventFunction{
        .name = "upwards", .function = position_minus(1.0), .crossing = Crossing::upwards});
    const Result run = simulate(m, options(f.name, 2.0 * pi / omega));
    REQUIRE(run.summary.ok());
    REQUIRE(run.events.size() == 3);
    CHECK(std::abs(run.events[0].t - pi / 3.0 / omega) < bar(f.name));
    CHECK(run.events[0].element == "half way");
    CHECK(run.events[0].kind == "event");
    CHECK(run.events[0].region == "downwards");
    CHECK(std::abs(run.events[1].t - 1.5 * pi / omega) < bar(f.name));
    CHECK(run.events[1].element == "upwards");
    CHECK(run.events[2].region == "upwards");
  }
}

TEST_CASE("a blow at a crossing that turns the motion back is struck once") {
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    for (int k = 0; k < 12; ++k) {
      const double distance = 0.1 + 0.00371 * k;
      Model m;
      const BodyId ball = m.add(Body{.name = "ball",
                                     .mass = mass,
                                     .inertia = 1.0,
                                     .pose = {{-distance, 0.0}, 0.0},
                                     .twist = {{1.0, 0.0}, 0.0}});
      m.add(EventFunction{.name = "mirror",
                          .function = [ball](const Motion& at) { return at[ball].x; },
                          .action =
                              [ball](const EventAction& at) {
                                at.impulse(ball, {-2.0 * mass * at.motion[ball].vx, 0.0}, 0.0);
                              }});
      const Result run = simulate(m, options(f.name, 2.0 * distance));
      REQUIRE(run.summary.ok());
      CHECK(run.events.size() == 1);
      CHECK(run.final.q[0] == doctest::Approx(-distance).epsilon(1e-9));
    }
  }
}

TEST_CASE("an event that stops ends the run well, at the event, with a row of its own") {
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    Model m = oscillator();
    m.add(EventFunction{.name = "middle", .function = position_minus(1.0), .stop = true});
    const Result run = simulate(m, options(f.name, 10.0));
    CHECK(run.summary.ok());
    CHECK(run.summary.stop == Stop::by_event);
    CHECK(run.summary.reason.starts_with("event 'middle' at t = 0.24"));
    CHECK(std::abs(run.summary.t_end - 0.5 * pi / omega) < bar(f.name));
    CHECK(run.final.t == run.summary.t_end);
    const auto last = static_cast<Eigen::Index>(run.samples.rows()) - 1;
    CHECK(run["t_s"](last) == run.final.t);
    CHECK(std::abs(run["mass.x_m"](last) - 1.0) < bar(f.name));
  }
}

TEST_CASE("an event changes a parameter, the motion follows and the ledger closes") {
  // A quarter of a period on the first spring; then, at x = 1, four times as stiff: half as far.
  // At the turning point the stiffness is put back, which takes energy out.
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    Model m = oscillator();
    m.add(EventFunction{.name = "stiffer",
                        .function = position_minus(1.0),
                        .crossing = Crossing::downwards,
                        .set = {{"spring.stiffness", 4.0 * stiffness}}});
    m.add(EventFunction{
        .name = "back",
        .function = [](const Motion& at) { return at[BodyId{1}].vx; },
        .crossing = Crossing::upwards,
        .action = [](const EventAction& a) { a.parameter("spring.stiffness") *= 0.25; }});
    const double quarter = 0.5 * pi / omega;
    const Result run = simulate(m, options(f.name, 2.5 * quarter));
    REQUIRE(run.summary.ok());
    REQUIRE(run.events.size() == 2);
    CHECK(std::abs(run.events[1].t - 1.5 * quarter) < bar(f.name));
    const double x = 1.0 - 0.5 * amplitude * std::cos(omega * quarter);
    CHECK(std::abs(run.final.q[0] - x) < 10.0 * bar(f.name));
    CHECK(run.summary.energy_balance < 100.0 * bar(f.name) * run.summary.energy_exchanged);
    // 1/2 (k - 4k) (amplitude/2)^2 is taken out at the turning point.
    const Eigen::VectorXd work = run["back.work_J"];
    CHECK(std::abs(work(work.size() - 1) + 1.5 * stiffness * 0.01) < 10.0 * bar(f.name));
  }
}

TEST_CASE("a wrong event is refused before the run, one that throws ends it with what there is") {
  Model m = oscillator();
  CHECK_THROWS_WITH_AS(m.add(EventFunction{.name = "none"}), "event 'none': it has no function",
                       ModelError);
  m.add(EventFunction{
      .name = "softer", .function = position_minus(1.0), .set = {{"spring.stiffnes", 1.0}}});
  CHECK_THROWS_WITH_AS(simulate(m, {.until = 1.0}),
                       doctest::Contains("unknown parameter 'spring.stiffnes'"), ModelError);

  Model thrower = oscillator();
  thrower.add(EventFunction{.name = "bad",
                            .function = position_minus(1.0),
                            .action = [](const EventAction& a) { a.parameter("none") = 1.0; }});
  const Result run = simulate(thrower, {.until = 1.0});
  CHECK(run.summary.stop == Stop::failed);
  CHECK(contains(run.summary.reason, "unknown parameter 'none'"));
  CHECK(run.samples.rows() > 100);

  Model nan = oscillator();
  nan.add(EventFunction{
      .name = "nan", .function = position_minus(1.0), .action = [](const EventAction& a) {
        a.parameter("spring.stiffness") = std::nan("");
      }});
  const Result lost = simulate(nan, {.until = 1.0});
  CHECK(lost.summary.stop == Stop::failed);
  CHECK(lost.final.q.allFinite());
}

TEST_CASE("an event fires once at a crossing, on whichever side rounding leaves the state") {
  // The stiffness changes at every passage of x = 1; with the wrong number of changes the motion is
  // another. Half periods alternate between both stiffnesses.
  for (const FormulationNote& f : formulations()) {
    for (const double rtol : {1e-6, 1e-8, 1e-10}) {
      if (f.order <= 2 && rtol < 1e-8) continue;
      INFO(f.name, " ", rtol);
      Model m = oscillator();
      m.add(EventFunction{
          .name = "toggle", .function = position_minus(1.0), .action = [](const EventAction& a) {
            double& k = a.parameter("spring.stiffness");
            k = k == stiffness ? 4.0 * stiffness : stiffness;
          }});
      const double half = pi / omega;
      const Result run = simulate(
          m, {.until = 3.9 * half, .relative_tolerance = rtol, .formulation = std::string(f.name)});
      REQUIRE(run.summary.ok());
      // A quarter, then halves of 1/2, 1, 1/2, 1 half periods.
      CHECK(run.events.size() == 5);
      for (std::size_t i = 1; i < run.events.size(); ++i)
        CHECK(run.events[i].t - run.events[i - 1].t > 0.4 * half);
    }
  }
}

TEST_CASE("a run that an event has ended goes on from there without meeting it again") {
  for (const FormulationNote& f : formulations()) {
    for (int i = 0; i < 12; ++i) {
      INFO(f.name, " ", i);
      const double x = 1.0 + amplitude * (0.013 + 0.07 * i);
      Model m = oscillator();
      m.add(EventFunction{.name = "gate", .function = position_minus(x), .stop = true});
      const Result first = simulate(m, options(f.name, 1.0));
      REQUIRE(first.summary.stop == Stop::by_event);
      const Result second = simulate(m, first.final, options(f.name, 2.0));
      REQUIRE(second.summary.stop == Stop::by_event);
      CHECK(second.summary.t_end > first.summary.t_end + 0.1);
    }
  }
}

TEST_CASE("an event function that is not a number is named") {
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    Model m = oscillator();
    m.add(EventFunction{.name = "lost", .function = [](const Motion& at) {
                          return at.t > 0.3 ? std::nan("") : 1.0;
                        }});
    const Result run = simulate(m, options(f.name, 1.0));
    CHECK(run.summary.stop == Stop::failed);
    INFO(run.summary.reason);
    CHECK(contains(run.summary.reason, "'lost' gives a value that is not finite"));
  }
}

TEST_CASE("an event cannot give a parameter a value that its element would refuse") {
  Model m = oscillator();
  m.add(EventFunction{
      .name = "wrong", .function = position_minus(1.0), .set = {{"spring.stiffness", -5.0}}});
  CHECK_THROWS_WITH_AS(simulate(m, {.until = 1.0}),
                       "event 'wrong': spring.stiffness = -5 N/m is outside the accepted range, at "
                       "least 0 N/m",
                       ModelError);
  CHECK_THROWS_AS(m.add(EventFunction{.name = "nan",
                                      .function = position_minus(1.0),
                                      .set = {{"spring.stiffness", std::nan("")}}}),
                  ModelError);

  // What an action does is known only when it has been done.
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    Model late = oscillator();
    late.add(EventFunction{
        .name = "late", .function = position_minus(1.0), .action = [](const EventAction& a) {
          a.parameter("spring.damping") = -2.0;
        }});
    const Result run = simulate(late, options(f.name, 1.0));
    CHECK(run.summary.stop == Stop::failed);
    CHECK(run.summary.reason.find("'spring': damping = -2 N s/m is outside the accepted range") !=
          std::string::npos);
    CHECK(run.samples.rows() > 100);
  }

  // A state that a run starts from is held to the same.
  State start = assembled_state(oscillator());
  start.parameters[oscillator().find_parameter("spring.free_length")] = -0.1;
  CHECK_THROWS_WITH_AS(simulate(oscillator(), start, {.until = 1.0}),
                       doctest::Contains("'spring': free_length = -0.1 m is outside"), ModelError);
}

TEST_CASE("what a user's function says when it throws comes first, in every formulation") {
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    Model m = oscillator();
    m.add(EventFunction{.name = "picky", .function = [](const Motion& at) {
                          if (at.t > 0.1) throw std::runtime_error("my table ends at 0.1 s");
                          return 1.0 + at[BodyId{1}].x;
                        }});
    const Result run = simulate(m, options(f.name, 1.0));
    CHECK(run.summary.stop == Stop::failed);
    CHECK_MESSAGE(run.summary.reason.starts_with("after t = "), run.summary.reason);
    CHECK_MESSAGE(run.summary.reason.ends_with(" s: my table ends at 0.1 s"), run.summary.reason);
    CHECK(run.summary.t_end < 0.11);
  }
}

TEST_CASE("an excursion above zero and back within one step is found") {
  // A cart swings slowly, x = 1.5 sin(0.2 t), with steps of a second. It passes a light barrier of
  // 8 mm, and a resonance in time is above its threshold for 20 ms.
  const double gate = 1.1, half = 0.004, peak = 6.7, width = 0.01;
  for (const FormulationNote& f : formulations()) {
    for (const double rtol : {1e-3, 1e-5, 1e-8}) {
      INFO(f.name, " ", rtol);
      Model m;
      const BodyId cart = m.add(Body{
          .name = "cart", .mass = 1.0, .inertia = 1.0, .pose = {}, .twist = {{0.3, 0.0}, 0.0}});
      m.add(TranslationalSpring{.name = "spring",
                                .a = ground,
                                .b = cart,
                                .at_a = {-10.0, 0.0},
                                .at_b = {0.0, 0.0},
                                .stiffness = 0.04,
                                .free_length = 10.0});
      m.add(EventFunction{.name = "barrier", .function = [=](const Motion& at) {
                            const double off = (at[cart].x - gate) / half;
                            return 1.0 - off * off;
                          }});
      m.add(EventFunction{.name = "resonance", .function = [=](const Motion& at) {
                            const double off = (at.t - peak) / width;
                            return 1.0 / (1.0 + off * off) - 0.5;
                          }});
      const Result run = simulate(m, {.until = 10.0,
                                      .relative_tolerance = rtol,
                                      .formulation = std::string(f.name),
                                      .samples = 0});
      REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
      REQUIRE(run.events.size() == 4);
      const double sooner = std::asin((gate - half) / 1.5) / 0.2;
      const double later = std::asin((gate + half) / 1.5) / 0.2;
      // Velocities err by the tolerance times the amplitude's rate, in a run of this length.
      const double place = 100.0 * rtol;
      CHECK(run.events[0].element == "barrier");
      CHECK(run.events[0].region == "upwards");
      CHECK(std::abs(run.events[0].t - sooner) < place);
      CHECK(run.events[1].region == "downwards");
      CHECK(std::abs(run.events[1].t - later) < place);
      CHECK(run.events[2].element == "resonance");
      CHECK(run.events[2].region == "upwards");
      CHECK(std::abs(run.events[2].t - (peak - width)) < 1e-9);
      CHECK(run.events[3].region == "downwards");
      CHECK(std::abs(run.events[3].t - (peak + width)) < 1e-9);
    }
  }
}
