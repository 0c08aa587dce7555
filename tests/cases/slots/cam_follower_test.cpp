// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The cam and its follower: lift and force by an own formula, the speed at which it jumps.
#include <algorithm>
#include <cmath>

#include <yoke/core/types.hpp>
#include <yoke/tests/cases/slots/case_run.hpp>

using namespace yoke;
using namespace yoke::tests;

namespace {

// Rise of 10 mm in 90 deg, cycloidal: s = L (x - sin(2 pi x)/(2 pi)).
constexpr double lift = 0.01, span = 0.5 * pi, mass = 0.5, stiffness = 5000.0, preload = 100.0;

double jump_speed() {
  double least = 1e300;
  for (int i = 0; i < 100000; ++i) {
    const double x = 0.5 + 0.5 * (i + 0.5) / 100000.0, w = 2.0 * pi * x;
    const double s = lift * (x - std::sin(w) / (2.0 * pi));
    const double bend = 2.0 * pi * lift / (span * span) * std::sin(w);
    least = std::min(least, (stiffness * s + preload) / (-mass * bend));
  }
  return std::sqrt(least);
}

bool leaves(double speed) {
  const SlotCaseRun run =
      run_case("cam_follower", {fmt::format("speed={:.9g}", speed * 30.0 / pi), "turns=1"},
               {.relative_tolerance = 1e-7, .samples = 201});
  return std::ranges::any_of(run.result.events,
                             [](const EventRecord& e) { return e.kind == "release"; });
}

}  // namespace

TEST_SUITE("cam follower") {
  TEST_CASE("the ideal follower lifts and presses by the formula") {
    const SlotCaseRun run = run_case("cam_follower", {"joint=ideal", "speed=1000", "turns=1"},
                                     {.relative_tolerance = 1e-11, .samples = 721});
    const double omega = 1000.0 * pi / 30.0;
    const Eigen::VectorXd y = run.result["follower.y_m"], force = run.result["contact.fy_N"];
    for (int degree = 121; degree < 210; ++degree) {  // the rise begins at 120 deg
      const double x = (degree - 120.0) / 90.0, w = 2.0 * pi * x;
      const double s = lift * (x - std::sin(w) / (2.0 * pi));
      const double bend = 2.0 * pi * lift / (span * span) * std::sin(w);
      CHECK(std::abs(y[2 * degree] - 0.038 - s) < 1e-13);
      CHECK(std::abs(force[2 * degree] - (mass * omega * omega * bend + stiffness * s + preload)) <
            1e-6);
    }
  }

  TEST_CASE("the follower leaves the cam from the jump speed on") {
    CHECK_FALSE(leaves(0.97 * jump_speed()));
    CHECK(leaves(1.03 * jump_speed()));
  }

  TEST_CASE("every law of motion, below its jump speed and above") {
    for (const cases::CaseParameter& p : cases::find_case("cam_follower").parameters)
      for (const std::string& law : p.name == "law" ? p.words : std::vector<std::string>{})
        for (const char* speed : {"speed=500", "speed=1500"})
          run_case("cam_follower", {"law=" + law, speed, "turns=1"},
                   {.relative_tolerance = 1e-6, .samples = 201});
  }

  TEST_CASE("cams that cannot be made are refused") {
    CHECK(contains(refusal_of("cam_follower", {"rise=200deg", "return=120deg"}),
                   "rise, top and return = 380 deg"));
    CHECK(contains(refusal_of("cam_follower", {"base=10mm", "lift=20mm", "roller=60mm"}),
                   "not greater than roller_radius"));
  }
}
