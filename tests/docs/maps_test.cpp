// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <string>

#include <yoke/tests/docs/maps_example.hpp>
#include <yoke/tests/docs/page_commands.hpp>
#include <yoke/tests/documentation.hpp>

TEST_CASE("the code in docs/maps.md is compiled here and does what it says") {
  yoke::tests::check_blocks("docs/maps.md", "cpp", 1, {"tests/docs/maps_example.hpp"});
  const yoke::Poincare map = maps_example::points(1.2);
  CHECK(map.complete);
  CHECK(map.points.rows() == 10);
  CHECK(map.period == 1);
  const yoke::Bifurcation diagram = maps_example::diagram();
  CHECK(diagram.points.rows() == 32);
  // Forward 1.7 is on the upper branch, backward on the lower.
  CHECK(std::abs(diagram.points.value(8, 4)) > 2.0 * std::abs(diagram.points.value(24, 4)));
  const yoke::Basins basins = maps_example::where_starts_lead();
  CHECK(basins.attractors.size() == 2);
}

TEST_CASE("the commands in docs/maps.md run, and write what the page says") {
  using namespace yoke::tests;
  const TemporaryFolder scratch;
  CHECK(run_commands_of("docs/maps.md", scratch) == 3);
  const std::string page = source("docs/maps.md");
  for (const char* file : {"poincare/poincare.csv", "poincare/summary.json",
                           "bifurcation/bifurcation.csv", "bifurcation/periods.csv",
                           "basins/basins.csv", "basins/attractors.csv", "basins/journal.tsv"}) {
    CHECK_MESSAGE(std::filesystem::exists(scratch / "results" / file), file);
    CHECK_MESSAGE(
        contains(page, std::string("`") + std::filesystem::path(file).filename().string() + "`"),
        file);
  }
}
