// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The ratchet counts whole pitches, whatever its teeth.
#include <doctest/doctest.h>

#include <cmath>

#include <yoke/tests/cases/impacts/impact_case.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using yoke::tests::impact_run;

TEST_CASE("ratchet: one tooth for each cycle, none for a short stroke, two for a long one") {
  struct Variant {
    int teeth;
    double stroke, indexed;
  };
  for (const Variant& x :
       {Variant{8, 1.5, 1}, {12, 1.4, 1}, {12, 1.8, 1}, {20, 1.5, 1}, {12, 0.7, 0}, {12, 2.5, 2}}) {
    CAPTURE(x.teeth);
    CAPTURE(x.stroke);
    const auto run = impact_run(
        "ratchet", {fmt::format("teeth={}", x.teeth), fmt::format("stroke={}", x.stroke)},
        "hunt-crossley", {.samples = 601});
    const double pitch = 2.0 * pi / x.teeth;
    const Eigen::VectorXd wheel = run.result["wheel.angle_rad"] / pitch;
    // 3 cycles of 200 rows: between the ends of the first and the third lie two cycles.
    CHECK(wheel[600] - wheel[200] == doctest::Approx(2.0 * x.indexed).epsilon(1e-3));
    // Held: after each cycle the wheel never comes back below where it lies on the pawl. It bounces
    // there by 0.01 of a pitch at most.
    for (const int cycle : {1, 2})
      CHECK(wheel.tail(600 - 200 * cycle).minCoeff() > wheel[200 * cycle] - 0.01);
    // Nothing passes through: the tips are 0.8 mm.
    for (const char* tip : {"driving pawl tip.penetration_m", "holding pawl tip.penetration_m"})
      CHECK(run.result[tip].maxCoeff() < 0.1e-3);
  }
}

TEST_CASE("ratchet: a formulation of another kind counts the same, and stands at the same angle") {
  const auto first = impact_run("ratchet", {"cycles=1"}, "restitution"),
             second = impact_run("ratchet", {"cycles=1"}, "restitution",
                                 {.formulation = "cvode-projection"});
  const Eigen::Index last = static_cast<Eigen::Index>(first.result.samples.rows()) - 1;
  CHECK(first.result["wheel.angle_rad"][last] ==
        doctest::Approx(second.result["wheel.angle_rad"][last]).epsilon(1e-4));
}

}  // namespace
