// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <yoke/cases/jobs/job.hpp>
#include <yoke/cases/program/request.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/documentation.hpp>
#include <yoke/tests/tutorial/steps.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;

/// A run of a step under one of its laws.
Result run_of(const Case& c, const std::string& law) {
  const Parameters parameters = make_request(c, {}).parameters;
  const Model model = make_model(c, parameters, law);
  const Result run = simulate(model, {.until = c.duration(parameters),
                                      .relative_tolerance = 1e-9,
                                      .samples = 4001,
                                      .contact_rows = 16});
  INFO(run.summary.reason);
  REQUIRE(run.summary.ok());
  for (const Check& check : run_checks(c, parameters, law, model, run)) {
    INFO(text_of(check));
    CHECK(check.within());
  }
  return run;
}

double peak_of(const Result& run) {
  return std::max(run.samples["slot.normal_force_N"].maxCoeff(),
                  run.contact_samples["slot.normal_force_N"].maxCoeff());
}

long onsets_of(const Result& run) {
  return std::ranges::count(run.events, "onset", &EventRecord::kind);
}

}  // namespace

TEST_CASE("the code in docs/tutorial/ is that of the steps compiled here") {
  std::size_t blocks = 0;
  for (const TutorialStep& step : tutorial_steps()) {
    const std::string page = "docs/tutorial/" + step.page + ".md";
    tests::check_blocks(page, "cpp", 1, {"tests/tutorial/" + step.page + ".hpp"});
    blocks += tests::code_blocks(page, "cpp").size();
  }
  CHECK(blocks >= 10);
  // The first page prints its file whole.
  std::string printed;
  for (const std::string& block : tests::code_blocks("docs/tutorial/ideal.md", "cpp"))
    printed += (printed.empty() ? "" : "\n") + block;
  const std::string compiled = tests::source("tests/tutorial/ideal.hpp");
  CHECK(printed == compiled.substr(compiled.find("// A slotted lever")));
}

TEST_CASE("docs/tutorial/: each step passes its own checks, and does what its page says") {
  const Result ideal = run_of(slotted_lever_ideal(), "");
  CHECK(ideal["lever.angle_rad"].maxCoeff() == doctest::Approx(pi / 6.0).epsilon(1e-5));
  CHECK(ideal["motor.moment_N_m"].maxCoeff() == doctest::Approx(53.3).epsilon(1e-3));
  const Eigen::VectorXd fx = ideal["slot.fx_N"], fy = ideal["slot.fy_N"];
  CHECK(std::sqrt((fx.cwiseAbs2() + fy.cwiseAbs2()).maxCoeff()) ==
        doctest::Approx(654.0).epsilon(1e-3));

  // Peaks are between samples: a few per cent.
  const auto dissipated = [](const Result& run) { return run["dissipated_J"].tail(1)[0]; };
  const Result bare = run_of(slotted_lever_clearance(), "steel");
  CHECK(peak_of(bare) == doctest::Approx(11e3).epsilon(0.03));
  CHECK(onsets_of(bare) > 40);
  CHECK(dissipated(bare) == doctest::Approx(0.35).epsilon(0.01));

  const Result oiled = run_of(slotted_lever_friction(), "oiled");
  CHECK(peak_of(oiled) == doctest::Approx(peak_of(bare)).epsilon(0.02));
  CHECK(dissipated(oiled) - dissipated(bare) == doctest::Approx(15.2).epsilon(0.01));
  CHECK(oiled["motor.work_J"].tail(1)[0] ==
        doctest::Approx(10.0 * bare["motor.work_J"].tail(1)[0]).epsilon(0.02));

  const Result lined = run_of(slotted_lever_own_law(), "lined");
  CHECK(peak_of(lined) == doctest::Approx(0.2 * peak_of(bare)).epsilon(0.05));
  CHECK(onsets_of(lined) < 20);
}
