// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The Geneva drive: ideal kinematics in closed form; with all its contacts, indexes and rest.
#include <algorithm>
#include <cmath>

#include <yoke/core/types.hpp>
#include <yoke/integrators/analyses/kinematics.hpp>
#include <yoke/tests/cases/slots/case_run.hpp>

using namespace yoke;
using namespace yoke::tests;

TEST_SUITE("geneva") {
  TEST_CASE("without clearance the wheel turns by the closed form, to rounding") {
    // Four slots: alpha = k pi/16, angle of the wheel, speed and acceleration over the driver's;
    // from the closed form in 24 digits.
    const double rows[5][3] = {{0.0, 2.414213562373095, 0.0},
                               {0.4229452411775460, 1.713169774005418, -5.405553565655532},
                               {0.6627088513986044, 0.7924102142086068, -3.615891689364448},
                               {0.7615308011055833, 0.2713087995413880, -1.869693980714618},
                               {0.7853981633974483, 0.0, -1.0}};
    const cases::Case& c = cases::find_case("geneva");
    const cases::Parameters p(c.parameters, {"joint=ideal"});
    const Model m = cases::make_model(c, p);
    const double omega = 4.0 * pi;
    for (const bool simulated : {false, true}) {
      const double until = c.duration(p);
      const Result run = simulated ? simulate(m, {.until = until, .samples = 9})
                                   : kinematics(m, {.until = until, .samples = 9});
      REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
      for (int k = -4; k <= 4; ++k) {
        const double* row = rows[std::abs(k)];
        const double side = k < 0 ? -1.0 : 1.0;
        CHECK(std::abs(run["wheel.angle_rad"][k + 4] + side * row[0] + 0.25 * pi) < 1e-12);
        CHECK(std::abs(run["wheel.omega_rad_per_s"][k + 4] / omega + row[1]) < 1e-12);
        CHECK(std::abs(run["wheel.alpha_rad_per_s2"][k + 4] / (omega * omega) + side * row[2]) <
              1e-11);
      }
    }
    for (const char* slots : {"slots=3", "slots=7", "slots=12"})
      run_case("geneva", {"joint=ideal", slots}, {.samples = 201});
  }

  TEST_CASE("twenty turns, twenty indexes, and no drift in between") {
    const SlotCaseRun run =
        run_case("geneva", {"turns=20"}, {.relative_tolerance = 1e-6, .samples = 2001});
    const Eigen::VectorXd wheel = run.result["wheel.angle_rad"];
    CHECK(std::abs(wheel[2000] + 10.0 * pi) < 1e-3);
    for (int turn = 1; turn <= 20; ++turn)  // pin on the far side
      CHECK(std::abs(wheel[100 * turn] + 0.5 * pi * turn) < 1.2e-3);
    // No wall is passed: nothing goes deeper than its load explains.
    for (const std::string& name : run.result.samples.names())
      if (name.ends_with(".penetration_m")) CHECK(run.result[name].maxCoeff() < 1e-5);
  }

  TEST_CASE("the impact on the other wall is that of a wheel coasting between rigid walls") {
    const SlotCaseRun run =
        run_case("geneva", {"turns=1"}, {.relative_tolerance = 1e-7, .samples = 401});
    const auto other = std::ranges::find(run.checks, "speed of the first impact on the other wall",
                                         &cases::Check::what);
    REQUIRE(other != run.checks.end());
    CHECK(other->expected == doctest::Approx(0.0420794).epsilon(1e-4));  // by another program
    CHECK(other->within());
    CHECK(std::abs(other->value / other->expected - 1.0) < 2e-3);
  }

  TEST_CASE("the first impact by clearance and speed: Omega sqrt(2 r c - c^2)") {
    for (const auto& [clearance, speed] :
         {std::pair{0.01, 60.0}, {0.05, 60.0}, {0.2, 60.0}, {0.05, 300.0}}) {
      const SlotCaseRun run = run_case(
          "geneva", {fmt::format("clearance={}mm", clearance), fmt::format("speed={}", speed)},
          {.until = 0.42 * 60.0 / speed, .samples = 2});
      const auto first = std::ranges::find_if(
          run.result.events, [](const EventRecord& e) { return e.element.starts_with("slot"); });
      REQUIRE(first != run.result.events.end());
      const double c = 1e-3 * clearance, omega = speed * pi / 30.0;
      CHECK(std::abs(first->speed - omega * std::sqrt(0.1 * c - c * c)) < 1e-7 * omega);
    }
  }

  TEST_CASE("three slots and eight index as well") {
    for (const char* slots : {"slots=3", "slots=8"})
      run_case("geneva", {slots, "turns=1"}, {.relative_tolerance = 1e-6, .samples = 401});
  }

  TEST_CASE("a pin too large for its crank is refused") {
    CHECK(contains(refusal_of("geneva", {"pin=10mm"}), "pin = 10 mm is too large for crank = 50"));
    CHECK(contains(refusal_of("geneva", {"lock_gap=2mm"}), "lock_gap = 2 mm is too large"));
  }
}
