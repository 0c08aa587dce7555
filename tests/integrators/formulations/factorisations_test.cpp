// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <string>

#include <yoke/tests/integrators/mechanisms.hpp>

TEST_CASE("a run chooses new pivots a handful of times, whatever the tolerance") {
  using namespace yoke;
  using namespace yoke::tests;
  const Model model = scotch_yoke();
  for (const std::string formulation : {"arkode-projection", "arkode-baumgarte", "ida-ggl"}) {
    for (const double rtol : {1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
      INFO(formulation, " ", rtol);
      const Result run = simulate(model, {.until = 2.0 * yoke_period,
                                          .relative_tolerance = rtol,
                                          .formulation = formulation,
                                          .samples = 101});
      REQUIRE(run.summary.ok());
      CHECK(run.summary.events > 40);
      // Elimination by blocks chooses no pivots; a matrix of the integrator's own does.
      if (formulation == "ida-ggl")
        CHECK(run.summary.fresh_factorisations >= 1);
      else
        CHECK(run.summary.fresh_factorisations == 0);
      CHECK(run.summary.fresh_factorisations <= 4);
      CHECK(run.summary.refactorisations > run.summary.steps / 10);
    }
  }
}
