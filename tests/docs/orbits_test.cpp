// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <yoke/tests/docs/orbits_example.hpp>
#include <yoke/tests/docs/page_commands.hpp>
#include <yoke/tests/documentation.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

TEST_CASE("the code in docs/orbits.md is compiled here and does what it says") {
  using namespace yoke;
  yoke::tests::check_blocks("docs/orbits.md", "cpp", 1, {"tests/docs/orbits_example.hpp"});
  // It stands where (amplitude omega)^2 > 2 g l, l the length of the simple pendulum: 6.3 mm.
  const PeriodicOrbit slow = orbits_example::upright(5.0e-3);
  REQUIRE(slow.found);
  CHECK(slow.stability == OrbitStability::unstable);
  CHECK(slow.multipliers.front().value.imag() == 0.0);
  const PeriodicOrbit fast = orbits_example::upright(8.0e-3);
  REQUIRE(fast.found);
  CHECK(fast.stability == OrbitStability::neutral);
  CHECK(fast.multipliers.front().value.imag() != 0.0);
  CHECK(orbits_example::rate_of_chaos(yoke::tests::double_pendulum()) > 0.5);
}

TEST_CASE("the commands in docs/orbits.md run, and write what the page says") {
  using namespace yoke::tests;
  const TemporaryFolder scratch;
  CHECK(run_commands_of("docs/orbits.md", scratch) == 3);
  const std::string page = source("docs/orbits.md");
  for (const char* file : {"orbit.csv", "multipliers.csv", "events.csv", "summary.json"}) {
    CHECK(std::filesystem::exists(scratch / "results/orbit" / file));
    CHECK(contains(page, std::string("| `") + file + "`"));
  }
  CHECK(lines(scratch / "results/orbit/orbit.csv").size() == 1002);
  CHECK(lines(scratch / "results/exponents/exponents.csv").size() > 100);
}
