// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in docs/numerics.md is compiled here, and does what the page says.
#include <doctest/doctest.h>

#include <string>

#include <yoke/tests/docs/numerics_example.hpp>
#include <yoke/tests/documentation.hpp>

using namespace yoke::tests;

TEST_CASE("the code in docs/numerics.md is compiled here") {
  check_blocks("docs/numerics.md", "cpp", 4, {"tests/docs/numerics_example.hpp"});
}

TEST_CASE("docs/numerics.md lists every formulation") {
  const std::string document = source("docs/numerics.md");
  for (const yoke::FormulationNote& f : yoke::formulations())
    CHECK_MESSAGE(contains(document, fmt::format("`{}`", f.name)), f.name);
}

TEST_CASE("docs/numerics.md: choice, second opinion, events and checkpoints") {
  using namespace numerics;
  CHECK(which_and_why(bench()).starts_with("arkode-projection: no force is stiff"));
  CHECK(digits_of_the_angle(bench()) > 6.0);

  const Result run = with_events(bench());
  CHECK(run.summary.stop == Stop::by_event);
  CHECK(run.summary.reason.starts_with("event 'turning point' at t = "));
  CHECK(run.events.front().element == "upright");
  CHECK(run.summary.energy_balance < 1e-6 * run.summary.energy_exchanged);

  const TemporaryFolder folder;
  const Result whole = long_run(bench(), folder.path());
  const Result resumed = after_a_kill(bench(), folder.path());
  CHECK(whole.samples.data() == resumed.samples.data());
}
