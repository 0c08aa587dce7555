// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Absorbers: the order of their swings against elliptic functions, the ripple they take away.
#include <cmath>

#include <yoke/core/types.hpp>
#include <yoke/tests/cases/slots/case_run.hpp>

using namespace yoke;
using namespace yoke::tests;

namespace {

double order_of(const std::string& path, const std::string& swing) {
  const SlotCaseRun run =
      run_case("cpva", {"rotor=driven", "number=1", "path=" + path, "swing=" + swing},
               {.relative_tolerance = 1e-12, .samples = 20001});
  return run.checks.front().value;
}

double ripple_of(const std::vector<std::string>& settings) {
  return run_case("cpva", settings, {.samples = 4001}).checks.front().value;
}

}  // namespace

TEST_SUITE("cpva") {
  TEST_CASE("the order of a swing on a circle, by elliptic functions in 24 digits") {
    CHECK(std::abs(order_of("circle", "1deg") - 1.999961922882936208) < 1e-9);
    CHECK(std::abs(order_of("circle", "10deg") - 1.996192884598919584) < 1e-9);
    CHECK(std::abs(order_of("circle", "30deg") - 1.965778165793157271) < 1e-9);
  }

  TEST_CASE("on the tautochrone every swing has the order of the small ones") {
    for (const char* swing : {"2deg", "30deg", "58deg"})
      CHECK(std::abs(order_of("tautochrone", swing) - 2.0) < 1e-8);
    CHECK(order_of("cycloid", "50deg") > 2.01);
  }

  TEST_CASE("absorbers take the ripple of their order away; on tautochrones also large ones") {
    CHECK(std::abs(ripple_of({"number=0"}) - 1.0) < 1e-4);
    const double large = ripple_of({}), small = ripple_of({"torque=50"});
    CHECK(large < 0.05);
    CHECK(small < 0.5 * large);
    CHECK(ripple_of({"path=circle"}) > 2.0 * large);
    CHECK(ripple_of({"number=4", "torque=200"}) < 0.05);
  }

  TEST_CASE("the ripple is that of the equations in theta and s alone") {
    const auto checked = [](const std::vector<std::string>& settings, int samples) {
      const SlotCaseRun run = run_case("cpva", settings, {.samples = samples});
      CAPTURE(cases::text_of(run.checks.front()));
      CHECK(run.checks.front().within());
      return run.checks.front();
    };
    for (const char* path : {"path=tautochrone", "path=cycloid", "path=circle"})
      CHECK(checked({path}, 2001).tolerance < 2e-5);
    // On the parallel of the path that rollers run on; far from it without their clearance.
    const cases::Check rollers = checked({"clearance=0.05mm", "turns=4"}, 2001);
    CHECK(rollers.tolerance < 5e-3);
    CHECK(std::abs(checked({"turns=4"}, 2001).value - rollers.value) > 2.0 * rollers.tolerance);
  }

  TEST_CASE("rollers with clearance stay on the outer walls, their path apart") {
    const SlotCaseRun run = run_case("cpva", {"clearance=0.02mm", "turns=2"},
                                     {.relative_tolerance = 1e-9, .samples = 401});
    CHECK(run.result.events.size() == 2);  // the onsets at the start
    CHECK((run.result["path 1.normal_force_N"].array() > 0.0).all());
    CHECK((run.result["path 2.region"].array() == 2.0).all());
    CHECK((run.result["path 2.penetration_m"].array() < 2e-5).all());
    CHECK(run.result.summary.energy_balance < 1e-6 * run.result.summary.energy_exchanged);
  }

  TEST_CASE("absorbers that cannot be are refused") {
    CHECK(contains(refusal_of("cpva", {"rotor=driven", "number=0"}), "number = 0"));
    CHECK(contains(refusal_of("cpva", {"torque=1000"}), "torque must be less than"));
    CHECK(contains(refusal_of("cpva", {"rotor=driven", "swing=80deg"}), "swing must be less than"));
    CHECK(contains(refusal_of("cpva", {"clearance=0.1mm", "order=6"}), "radius 3.37838 mm"));
  }
}
