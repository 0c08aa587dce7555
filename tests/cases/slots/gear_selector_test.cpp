// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The selector: the work of a shift by the energy of the spring, and what clearance does.
#include <algorithm>
#include <cmath>

#include <yoke/core/types.hpp>
#include <yoke/tests/cases/slots/case_run.hpp>

using namespace yoke;
using namespace yoke::tests;

TEST_SUITE("gear selector") {
  TEST_CASE("slowly, the work to half-way is what the spring of the ball takes up") {
    const SlotCaseRun run =
        run_case("gear_selector", {"clearance=0mm", "speed=20"}, {.samples = 4001});
    const Eigen::VectorXd y = run.result["fork.y_m"], force = run.result["groove.fy_N"];
    double work = 0.0;
    for (Eigen::Index i = 1; i < y.size() && y[i] <= 5e-3; ++i)
      work += 0.5 * (force[i] + force[i - 1]) * (y[i] - y[i - 1]);
    const double depth = 1.5e-3, stored = depth * (40.0 + 0.5 * 5000.0 * depth);
    CHECK(std::abs(work - stored) < 0.01 * stored);
    CHECK(force.minCoeff() < -10.0);  // then it pushes
  }

  TEST_CASE("the fork arrives with clearance and without, and overshoots by the play at most") {
    double before = -1.0;
    for (const char* clearance : {"clearance=0mm", "clearance=0.02mm", "clearance=0.2mm"}) {
      const SlotCaseRun run =
          run_case("gear_selector", {clearance}, {.relative_tolerance = 1e-6, .samples = 1001});
      const double overshoot = run.result["fork.y_m"].maxCoeff() - 0.01;
      CHECK(overshoot > before);
      before = overshoot;
    }
    CHECK(before > 1e-5);
  }

  TEST_CASE("a ball that does not fit its notch is refused") {
    CHECK(contains(refusal_of("gear_selector", {"ball=5mm"}), "ball = 5 mm does not fit"));
  }
}
