// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <cmath>
#include <sstream>
#include <string>

#include <yoke/tests/cases/program/program_run.hpp>
#include <yoke/tests/cases/sweep/sweep_rows.hpp>
#include <yoke/tests/docs/sweeps_example.hpp>
#include <yoke/tests/documentation.hpp>

TEST_CASE("the code in docs/sweeps.md is compiled here and does what it says") {
  using namespace yoke;
  yoke::tests::check_blocks("docs/sweeps.md", "cpp", 1, {"tests/docs/sweeps_example.hpp"});
  const yoke::tests::TemporaryFolder scratch;
  const StudyResult study = sweeps_example::drops(scratch / "drops");
  CHECK(study.complete);
  CHECK(study.progress.failed == 0);
  const Table table = study.table();
  REQUIRE(table.rows() == 20);
  for (std::size_t i = 0; i < 20; ++i) {
    // The impact's speed is that of the fall. Flores' law delivers a little less than its e.
    const double speed = std::sqrt(2.0 * 9.81 * table.value(i, 1));
    const double e = table.value(i, 2), left = table.value(i, 4) / speed;
    CHECK(left < e + 1e-3);
    CHECK(left > e - 0.1);
    if (i >= 4) CHECK(table.value(i, 3) > table.value(i - 4, 3));  // from higher, harder
  }
  CHECK(sweeps_example::drops(scratch / "drops").progress.reused == 20);
  CHECK(yoke::tests::rows_of_sweep(scratch / "drops/drops.csv") == 20);
}

TEST_CASE("the commands in docs/sweeps.md run, and write what the page says") {
  using namespace yoke::tests;
  const TemporaryFolder scratch;
  std::size_t commands = 0;
  for (const std::string& block : code_blocks("docs/sweeps.md", "sh")) {
    std::istringstream all(block);
    for (std::string line; std::getline(all, line); ++commands) {
      REQUIRE(line.starts_with("yoke sweep "));
      const auto run = run_yoke(scratch, line.substr(5));
      INFO(line << "\n" << run.out);
      CHECK(run.code == 0);
    }
  }
  CHECK(commands == 3);
  CHECK(rows_of_sweep(scratch / "results/gap/sweep.csv") == 10);
  CHECK(contains(lines(scratch / "results/laws/sweep.csv").front(), "rms.slider_a_m_per_s2"));
  CHECK(rows_of_sweep(scratch / "results/restitution/sweep.csv") == 8);
  const std::string page = source("docs/sweeps.md");
  for (const char* file :
       {"sweep.csv", "summary.json", "report.html", "journal.tsv", "sweep.json"}) {
    CHECK(std::filesystem::exists(scratch / "results/gap" / file));
    CHECK(contains(page, std::string("| `") + file + "`"));
  }
  // Every quantity is explained.
  for (const std::string& name : cells(lines(scratch / "results/gap/sweep.csv").front()))
    if (name != "clearance_m" && name != "speed") CHECK_MESSAGE(contains(page, name + "`"), name);
}
