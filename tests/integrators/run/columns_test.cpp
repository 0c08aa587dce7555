// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Of a large model only the columns that somebody wants are kept.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include <yoke/integrators/simulation.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

}  // namespace

TEST_CASE("columns that are chosen have the bits they have among all") {
  const Model model = scotch_yoke();
  SimulationOptions options{.until = 0.01, .samples = 51, .contact_rows = 10};
  const Result all = simulate(model, options);
  options.columns = {"slider.?_m", "slot.normal_force_N", "*_J"};
  Simulation run(model, options);
  CHECK(run.get("crank.angle_rad") == doctest::Approx(-31.0_deg));  // what is shown is all there is
  const Result some = run.finish();
  REQUIRE(some.summary.ok());
  REQUIRE(some.samples.names().front() == "t_s");
  for (const char* name : {"slider.x_m", "slider.y_m", "slot.normal_force_N", "balance_J"})
    CHECK(some.samples.has(name));
  CHECK_FALSE(some.samples.has("slider.vx_m_per_s"));
  CHECK_FALSE(some.samples.has("crank.x_m"));
  for (const Table* table : {&some.samples, &some.contact_samples}) {
    const Table& whole = table == &some.samples ? all.samples : all.contact_samples;
    REQUIRE(table->rows() == whole.rows());
    REQUIRE(table->rows() > 10);
    for (std::size_t i = 0; i < table->names().size(); ++i) {
      const std::size_t j = whole.index(table->names()[i]);
      CHECK(table->part(i) == whole.part(j));
      CHECK(table->unit(i) == whole.unit(j));
      for (std::size_t row = 0; row < table->rows(); ++row)
        REQUIRE(table->value(row, i) == whole.value(row, j));
    }
  }
}

TEST_CASE("a pattern that fits no column is refused before the run") {
  CHECK_THROWS_WITH_AS(simulate(scotch_yoke(), {.until = 0.01, .columns = {"slider.z*"}}),
                       doctest::Contains("none fits 'slider.z*'"), ModelError);
}

TEST_CASE("a run with other columns is not taken up") {
  const Model model = scotch_yoke();
  TemporaryFolder folder;
  SimulationOptions options{.until = 0.01,
                            .samples = 51,
                            .columns = {"slider.*"},
                            .checkpoints = {.folder = folder.path(), .every = 0.002}};
  const Result run = simulate(model, options);
  REQUIRE(run.summary.ok());
  CHECK(resume(model, folder.path()).samples.data() == run.samples.data());
  options.checkpoints.resume = true;
  options.columns = {"crank.*"};
  CHECK_THROWS_WITH_AS(simulate(model, options), doctest::Contains("columns = slider.*"),
                       ModelError);
}
