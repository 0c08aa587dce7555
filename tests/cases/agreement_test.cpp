// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Formulations agree about cases with impacts in which runs do not part (docs/cases, `yoke study CASE
// --agreement`); of those in which they do, about the beginning.
#include <doctest/doctest.h>

#include <cmath>

#include <yoke/tests/cases/slots/case_run.hpp>

using namespace yoke;
using namespace yoke::tests;

TEST_CASE("formulations agree about cases with impacts, until runs part") {
  struct Agreement {
    const char* name;
    double until;  // [s] 0: to the end
  };
  for (const auto& [name, until] : {Agreement{"bouncing_ball", 0.0},
                                    {"pendulum_stop", 0.0},
                                    {"slider_crank_clearance", 2e-3},
                                    {"four_bar_clearance", 5e-3}}) {
    CAPTURE(name);
    const auto run = [name = name, until = until](const char* formulation, double tolerance) {
      const cases::Case& c = cases::find_case(name);
      const cases::Parameters p(c.parameters, {});
      return simulate(cases::make_model(c, p), {.until = until > 0.0 ? until : c.duration(p),
                                                .relative_tolerance = tolerance,
                                                .formulation = formulation,
                                                .samples = 101});
    };
    const Result reference = run("arkode-projection", 1e-12);
    REQUIRE(reference.summary.ok());
    for (const char* formulation : {"ida-ggl", "cvode-projection", "adams-baumgarte"}) {
      CAPTURE(formulation);
      const Result other = run(formulation, 5e-11);
      REQUIRE(other.summary.ok());
      CHECK(other.events.size() == reference.events.size());
      for (const std::string& column : reference.samples.names())
        if (column.ends_with(".x_m") || column.ends_with(".y_m")) {
          CAPTURE(column);
          CHECK((other[column] - reference[column]).cwiseAbs().maxCoeff() < 1e-9);
        }
    }
  }
}
