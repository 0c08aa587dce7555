// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Runs whose friction is so stiff that stability bounds explicit steps.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include <yoke/cases/case.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/files.hpp>

namespace {

using namespace yoke;

Result run_of(const std::string& name, const std::string& formulation, double tolerance) {
  const cases::Case& c = cases::find_case(name);
  const cases::Parameters parameters(c.parameters, {});
  return simulate(cases::make_model(c, parameters), {.until = c.duration(parameters),
                                                     .relative_tolerance = tolerance,
                                                     .formulation = formulation,
                                                     .samples = 51});
}

bool says_stiff(const Result& run) {
  return std::ranges::any_of(run.summary.notes,
                             [](const std::string& note) { return note.starts_with("stiff: "); });
}

TEST_CASE("where friction is so stiff that stability bounds explicit steps, BDF goes on") {
  for (const auto& [name, share] : {std::pair{"block_on_incline", 0.3}, {"gear_selector", 0.5}}) {
    CAPTURE(name);
    const Result chosen = run_of(name, "automatic", 1e-6),
                 steps = run_of(name, "arkode-projection", 1e-6);
    REQUIRE(chosen.summary.ok());
    CHECK(says_stiff(chosen));
    CHECK_FALSE(says_stiff(steps));
    CHECK(chosen.summary.formulation == "arkode-projection");
    const auto work = [](const Summary& s) {
      return double(s.evaluations + 5 * s.jacobians + 2 * s.steps);
    };
    CHECK(work(chosen.summary) < share * work(steps.summary));
    CHECK(chosen.events.size() == steps.events.size());
    // It is not paid with accuracy: the ledger still closes.
    CHECK(chosen.summary.energy_balance < 1e-4 * chosen.summary.energy_exchanged + 1e-9);
  }
}

TEST_CASE("a stiff run that was killed goes on bit for bit, whoever made its steps") {
  const cases::Case& c = cases::find_case("gear_selector");
  const cases::Parameters parameters(c.parameters, {});
  const Model model = cases::make_model(c, parameters);
  for (const char* formulation : {"automatic", "arkode-projection"}) {
    CAPTURE(formulation);
    const tests::TemporaryFolder scratch;
    SimulationOptions options{.until = 0.1,
                              .relative_tolerance = 1e-4,
                              .formulation = formulation,
                              .samples = 21,
                              .checkpoints = {.folder = scratch.path(), .every = 0.02}};
    const Result whole = simulate(model, options);
    options.observer = [](const Progress& p) { return p.t < 0.07; };
    simulate(model, options);
    const Result resumed = resume(model, scratch.path());
    REQUIRE(resumed.samples.rows() == whole.samples.rows());
    CHECK(resumed.samples.data() == whole.samples.data());
    CHECK((whole.summary.jacobians > 0) == (std::string(formulation) == "automatic"));
  }
}

TEST_CASE("a run that asks for explicit steps, is not stiff or wants the last digits has no BDF") {
  CHECK(run_of("scotch_yoke", "automatic", 1e-6).summary.jacobians == 0);
  CHECK(run_of("block_on_incline", "arkode-projection", 1e-6).summary.jacobians == 0);
  CHECK(run_of("block_on_incline", "automatic", 1e-11).summary.jacobians == 0);
}

}  // namespace
