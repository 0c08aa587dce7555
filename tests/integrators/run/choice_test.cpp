// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The formulation that is chosen when none is asked for, and the second one that checks a result.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <yoke/core/authoring/auto_force.hpp>
#include <yoke/core/control/event_function.hpp>
#include <yoke/integrators/analyses/verify.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// A mass pushed through oil: after c/m seconds it creeps along with its weak spring.
Model in_oil(double damping) {
  Model m;
  const BodyId b =
      m.add(Body{.name = "mass", .mass = 1.0, .inertia = 1.0, .pose = {{1.5, 0.0}, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = b, .along = {1.0, 0.0}});
  m.add(TranslationalSpring{.name = "oil",
                            .a = ground,
                            .b = b,
                            .at_a = {0.0, 0.0},
                            .at_b = {1.5, 0.0},
                            .stiffness = damping,
                            .damping = damping,
                            .free_length = 1.0});
  return m;
}

Agreement quantity(const Verification& v, const std::string& column) {
  const auto found = std::ranges::find(v.quantities, column, &Agreement::column);
  REQUIRE(found != v.quantities.end());
  return *found;
}

}  // namespace

TEST_CASE("explicit steps are chosen where nothing is stiff, and the summary says why") {
  const Result pendulum = simulate(double_pendulum(), {.until = 0.1});
  CHECK(pendulum.summary.formulation == "arkode-projection");
  CHECK(pendulum.summary.formulation_reason == "no force is stiff at this tolerance");
  const Result yoke = simulate(scotch_yoke(), {.until = 0.01});
  CHECK(yoke.summary.formulation == "arkode-projection");
  CHECK(contains(yoke.summary.formulation_reason, "impacts"));
}

TEST_CASE("BDF is chosen where stability would bound explicit steps, and is worth it") {
  const SimulationOptions options{.until = 3.0, .relative_tolerance = 1e-6, .time_scale = 1.0};
  const Result run = simulate(in_oil(1e5), options);
  REQUIRE(run.summary.ok());
  CHECK(run.summary.formulation == "cvode-projection");
  CHECK(run.summary.formulation_reason.starts_with("'oil' is stiff: its rate of 1e+05 1/s"));
  // x'' + c x' + c (x - 1) = 0: the slow root is -1 - 1/c.
  const double expected = 1.0 + 0.5 * std::exp(-3.0 * (1.0 + 1e-5));
  CHECK(run.final.q[0] == doctest::Approx(expected).epsilon(1e-4));
  SimulationOptions explicit_options = options;
  explicit_options.formulation = "arkode-projection";
  const Result slow = simulate(in_oil(1e5), explicit_options);
  CHECK(slow.summary.evaluations > 20 * run.summary.evaluations);
}

TEST_CASE("an event that makes a force stiff changes the formulation, and back, and it is noted") {
  // x'' + c x' + c (x - 1) = 0 with c = 1e5 between 1 s and 3 s, else c = 1.
  Model m = in_oil(1.0);
  for (const double at : {1.0, 3.0}) {
    const double c = at < 2.0 ? 1e5 : 1.0;
    m.add(EventFunction{.name = at < 2.0 ? "thicker" : "thinner",
                        .function = [at](const Motion& now) { return now.t - at; },
                        .set = {{"oil.damping", c}, {"oil.stiffness", c}}});
  }
  const SimulationOptions options{.until = 4.0, .relative_tolerance = 1e-6, .time_scale = 1.0};
  const Result run = simulate(m, options);
  REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
  CHECK(run.summary.formulation == "arkode-projection");
  REQUIRE(run.summary.notes.size() == 2);
  CHECK(run.summary.notes[0].starts_with(
      "formulation changed at t = 1 s from arkode-projection to cvode-projection: 'oil' is stiff"));
  CHECK(run.summary.notes[1].starts_with(
      "formulation changed at t = 3 s from cvode-projection to arkode-projection"));
  SimulationOptions explicit_options = options;
  explicit_options.formulation = "arkode-projection";
  const Result slow = simulate(m, explicit_options);
  CHECK(slow.summary.notes.empty());
  CHECK(slow.summary.evaluations > 20 * run.summary.evaluations);
  CHECK(std::abs(slow.final.q[0] - run.final.q[0]) < 1e-5);
}

TEST_CASE("what is asked for runs; what does not exist is refused with the list") {
  CHECK(simulate(double_pendulum(), {.until = 0.1, .formulation = "ida-ggl"})
            .summary.formulation_reason == "asked for");
  CHECK_THROWS_WITH_AS(
      simulate(double_pendulum(), {.until = 0.1, .formulation = "euler"}),
      doctest::Contains("unknown formulation 'euler'; known formulations are 'automatic', "
                        "'arkode-projection'"),
      ModelError);
}

TEST_CASE("a second formulation tells how many digits of a result are right") {
  for (const double rtol : {1e-5, 1e-9}) {
    const SimulationOptions options{.until = 1.0, .relative_tolerance = rtol, .samples = 51};
    const Result run = simulate(double_pendulum(), options);
    const Verification v = verify(double_pendulum(), options, run);
    CHECK(v.formulation == "ida-ggl");
    CHECK(v.relative_tolerance == doctest::Approx(1e-2 * rtol));
    REQUIRE(v.summary.ok());
    // The angle in the end is known: the error bar must cover the error and not be far from it.
    const Agreement angle = quantity(v, "b.angle_rad");
    const double error = std::abs(run.final.q[5] + 2.3851873498861929707);
    CHECK(error < 1.1 * angle.difference);
    CHECK(angle.digits > -std::log10(rtol) - 2.5);
    CHECK(angle.digits < 14.0);
    CHECK(v.worst()->digits <= angle.digits);
    CHECK(v.same_events);
  }
}

TEST_CASE("the second formulation has another index and another family of methods") {
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    const SimulationOptions options{.until = 0.2,
                                    .relative_tolerance = 1e-6,
                                    .formulation = std::string(f.name),
                                    .samples = 11};
    const Result run = simulate(double_pendulum(), options);
    const Verification v = verify(double_pendulum(), options, run);
    const auto all = formulations();
    const auto other = std::ranges::find(all, v.formulation, &FormulationNote::name);
    CHECK(other->family != f.family);
    // BDF on accelerations has no counterpart of high order with another index.
    if (f.family != "BDF" || f.index != 1) CHECK(other->index != f.index);
    CHECK(quantity(v, "a.x_m").digits > 3.0);
  }
}

TEST_CASE("a quantity that is wrong in one run shows up, one that is zero does not alarm") {
  const SimulationOptions options{.until = 0.02, .relative_tolerance = 1e-8, .samples = 101};
  const Result run = simulate(scotch_yoke(), options);
  const Verification same = verify(scotch_yoke(), options, run);
  CHECK(same.same_events);
  CHECK(same.events > 0);
  CHECK(same.event_time_difference < 1e-6);
  CHECK(quantity(same, "slider.y_m").digits > 9.0);  // zero but for rounding
  CHECK(same.worst()->digits > 3.0);
  // Against another model the digits are gone.
  const Verification other = verify(scotch_yoke({.crank_length = 45.1_mm}), options, run);
  CHECK(quantity(other, "slider.x_m").digits < 4.0);
  CHECK(contains(to_json(other), "\"slider.x_m\""));
}
