// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <limits>
#include <string>

#include <yoke/joints/distance.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

std::string refusal(const Model& model, const SimulationOptions& options) {
  return message_of([&] { simulate(model, options); });
}

}  // namespace

TEST_CASE("options out of range are refused with name, value and range") {
  const Model model = double_pendulum();
  CHECK(contains(refusal(model, {.until = 1.0, .relative_tolerance = 1e-15}),
                 "relative_tolerance = 1e-15 is outside the accepted range 1e-13 to 0.01"));
  CHECK(contains(refusal(model, {.until = 1.0, .relative_tolerance = std::nan("")}),
                 "relative_tolerance = nan"));
  CHECK(contains(refusal(model, {.until = -1.0}), "until = -1 s must be later than the start"));
  CHECK(contains(refusal(model, {.until = 1.0, .samples = 1}), "samples = 1"));
  const std::string unknown = refusal(model, {.until = 1.0, .formulation = "newmark"});
  CHECK(contains(unknown, "unknown formulation 'newmark'"));
  CHECK(contains(unknown, "'ida-ggl'"));
}

TEST_CASE("a start pose that cannot be assembled names the equation and the residual") {
  Model m;
  const auto a = m.add(Body{.name = "a", .mass = 1.0, .inertia = 0.1});
  // Two points of one body cannot be 2 m apart if they are 1 m apart on the body.
  m.add(Revolute{.name = "pivot", .a = ground, .b = a, .at = {0.0, 0.0}});
  m.add(Distance{
      .name = "rope", .a = ground, .b = a, .at_a = {5.0, 0.0}, .at_b = {0.0, 1.0}, .length = 9.0});
  const std::string message = refusal(m, {.until = 1.0});
  CHECK(contains(message, "the start pose cannot be assembled"));
  CHECK((contains(message, "rope") || contains(message, "pivot")));
}

TEST_CASE("a driver in conflict with a joint is refused by name") {
  Model m = double_pendulum();
  m.add(AngleDriver{.name = "motor", .body = m.find_body("a"), .angle = constant_speed(0.0, 3.0)});
  m.add(AngleDriver{
      .name = "second motor", .body = m.find_body("a"), .angle = constant_speed(0.0, 4.0)});
  const std::string message = refusal(m, {.until = 1.0});
  CHECK(contains(message, "'motor: angle' is in conflict with 'second motor: angle'"));
  CHECK(contains(message, "0.5 rad/s"));
}

TEST_CASE("a force that returns NaN at the start is refused, later it ends the run with results") {
  const auto pushed = [](double t_bad) {
    Model m = double_pendulum();
    m.add(AppliedForce{.name = "broken",
                       .body = m.find_body("b"),
                       .at = {1.5, 0.0},
                       .force = [t_bad](double t) -> Vec2 {
                         const double nan = std::numeric_limits<double>::quiet_NaN();
                         return {t < t_bad ? 0.1 : nan, 0.0};
                       }});
    return m;
  };
  CHECK_THROWS_WITH_AS(
      pushed(-1.0), "applied force 'broken': force at t = 0 = (nan, 0) must have finite components",
      ModelError);
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "generalised-alpha"}) {
    INFO(formulation);
    const Result run = simulate(pushed(0.5), {.until = 1.0, .formulation = formulation});
    CHECK(run.summary.stop == Stop::failed);
    CHECK(contains(run.summary.reason, "'broken' gives a value that is not finite"));
    CHECK(contains(run.summary.reason, "t = 0."));
    CHECK(run.summary.t_end == doctest::Approx(0.5).epsilon(2e-2));
    CHECK(run.samples.rows() > 450);
    for (std::size_t i = 0; i < run.samples.rows(); ++i)
      for (std::size_t j = 0; j < run.samples.names().size(); ++j)
        REQUIRE(std::isfinite(run.samples.value(i, j)));
  }
}

TEST_CASE("an observer stops the run and keeps what was computed") {
  const Result run =
      simulate(double_pendulum(),
               {.until = 1.0, .observer = [](const Progress& p) { return p.fraction < 0.4; }});
  CHECK(run.summary.stop == Stop::interrupted);
  CHECK(run.summary.t_end >= 0.4);
  CHECK(run.summary.t_end < 0.5);
  CHECK(run.samples.rows() >= 400);
}

TEST_CASE("a driver whose rate is not the derivative of its value is refused, a fast one is not") {
  const auto driven = [](double factor, double frequency) {
    Model m = double_pendulum();
    m.add(AngleDriver{.name = "motor",
                      .body = m.find_body("a"),
                      .angle = TimeFunction([=](double t) -> TimeValue {
                        const double w = frequency, a = 0.01 / (w * w);
                        return {a * std::sin(w * t), factor * a * w * std::cos(w * t),
                                -a * w * w * std::sin(w * t)};
                      })});
    return m;
  };
  // 200 Hz over a long run: the differences of the check must not be coarser than the motion.
  const SimulationOptions options{
      .until = 100.0, .samples = 0, .observer = [](const Progress&) { return false; }};
  CHECK(contains(refusal(driven(1.1, 1257.0), options),
                 "driver 'motor': its rate is not the derivative"));
  CHECK(refusal(driven(1.0, 1257.0), options) == "no error");
}

TEST_CASE("scales and rates that make no sense are refused with their range") {
  const Model model = double_pendulum();
  CHECK(contains(refusal(model, {.until = 1.0, .length_scale = -1.0}),
                 "length_scale = -1 m must be finite and at least 0 m"));
  CHECK(contains(refusal(model, {.until = 1.0, .time_scale = -0.1}), "time_scale = -0.1 s must"));
  CHECK(contains(refusal(model, {.until = 1.0, .baumgarte_rate = -3.0}),
                 "baumgarte_rate = -3 1/s must be finite and at least 0 1/s"));
  for (const char* formulation : {"arkode-baumgarte", "ida-baumgarte"})
    CHECK(contains(
        refusal(
            model,
            {.until = 1.0, .formulation = formulation, .time_scale = 0.1, .baumgarte_rate = 1e12}),
        "baumgarte_rate = 1e+12 1/s: at relative_tolerance = 1e-08 and a time scale of "
        "0.1 s accepted is up to 6.71e+05 1/s"));
}

TEST_CASE("a driven body on a spring of 1e9 N m/rad runs in every formulation") {
  // The work of the drive is k phi^2/2 = 5e8 J; the body itself never has more than 0.5 J.
  const double k = 1e9;
  for (const FormulationNote& f : formulations()) {
    for (const double rtol : {1e-6, 1e-8, 1e-10}) {
      INFO(f.name, " ", rtol);
      Model m;
      const auto wheel = m.add(Body{.name = "wheel", .mass = 1.0, .inertia = 1.0});
      m.add(Revolute{.name = "pivot", .a = ground, .b = wheel, .at = {0.0, 0.0}});
      m.add(TorsionalSpring{.name = "spring", .a = ground, .b = wheel, .stiffness = k});
      m.add(AngleDriver{.name = "motor", .body = wheel, .angle = constant_speed(0.0, 1.0)});
      const Result run = simulate(
          m, {.until = 1.0, .relative_tolerance = rtol, .formulation = std::string(f.name)});
      REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
      CHECK(run["motor.work_J"].tail(1)[0] == doctest::Approx(0.5 * k).epsilon(1e-6));
      CHECK(run.summary.energy_balance < 1e-12 * k);
    }
  }
}
