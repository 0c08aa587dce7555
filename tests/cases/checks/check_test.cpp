// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <cmath>

#include <yoke/cases/case.hpp>
#include <yoke/cases/checks/check.hpp>
#include <yoke/core/types.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using yoke::tests::contains;

/// sin(w t) and its derivative over `until`, as a run would have recorded them.
Result sampled_sine(double w, double until, int rows) {
  Result run;
  run.samples.add_column("t", "s");
  run.samples.add_column("y", "m");
  run.samples.add_column("v", "m/s");
  for (int i = 0; i < rows; ++i) {
    const double t = until * i / (rows - 1);
    double* row = run.samples.append();
    row[0] = t, row[1] = std::sin(w * t), row[2] = w * std::cos(w * t);
  }
  run.summary.relative_tolerance = 1e-10;
  return run;
}

TEST_SUITE("checks") {
  TEST_CASE("a check says what it found, what it should be, and whether that is so") {
    Check c{.what = "period",
            .value = 1.2345,
            .expected = 1.2346,
            .unit = "s",
            .tolerance = 1e-3,
            .remark = "closed form"};
    CHECK(c.within());
    CHECK(text_of(c) == "period 1.2345 s, expected 1.2346 s within 0.001 s (closed form)");
    c.tolerance = 1e-5;
    CHECK_FALSE(c.within());
    CHECK(contains(text_of(c), "(closed form): OUTSIDE, by 0.0001 s"));
    c.value = NAN;
    CHECK_FALSE(c.within());
    CHECK(text_of({.what = "equations left out", .value = 3.0, .expected = 3.0}) ==
          "equations left out 3, expected 3");
  }

  TEST_CASE("times of crossing and period of a sine") {
    const double w = 3.7, period = 2.0 * pi / w;
    for (const int rows : {201, 2001}) {
      const Result run = sampled_sine(w, 6.2, rows);
      const std::vector<double> up = rising_times(run, "y_m", "v_m_per_s"),
                                down = falling_times(run, "y_m", "v_m_per_s", 0.5);
      REQUIRE(up.size() == 3);
      REQUIRE(down.size() == 4);
      const double error = period * interpolation_error(run, period);
      for (std::size_t i = 0; i < up.size(); ++i)
        CHECK(std::abs(up[i] - period * static_cast<double>(i + 1)) < error);
      for (std::size_t i = 0; i < down.size(); ++i)
        CHECK(std::abs(down[i] - (5.0 / 12.0 + static_cast<double>(i)) * period) < error);
      REQUIRE(period_check(run, up, period).size() == 1);
      CHECK(period_check(run, up, period).front().within());
      CHECK_FALSE(period_check(run, up, period * (1.0 + 1e-3)).front().within());
      CHECK(period_check(run, {1.0}, period).empty());
    }
  }

  TEST_CASE("the largest deviation of a column is found, in any row, and NaN is no agreement") {
    Result run = sampled_sine(2.0, 3.0, 31);
    const auto deviation = [&](double at_row_7) {
      return deviation_check("y off by", run, "y_m", "m", "", [&](std::size_t i) {
        return std::sin(0.2 * static_cast<double>(i)) + (i == 7 ? at_row_7 : 0.0);
      });
    };
    CHECK(deviation(0.0).within());
    CHECK(deviation(0.0).tolerance == doctest::Approx(2e-7).epsilon(0.01));
    CHECK(deviation(-0.02).value == doctest::Approx(0.02));
    CHECK_FALSE(deviation(1e-6).within());
    CHECK_FALSE(deviation(NAN).within());
  }

  TEST_CASE("every case has checks, and a run at its defaults is within them") {
    for (const Case& c : case_registry()) {
      CAPTURE(c.name);
      REQUIRE((c.checks || c.law_checks));
      const Parameters defaults(c.parameters);
      const Model model = make_model(c, defaults);
      const Result run = simulate(
          model, {.until = c.duration(defaults), .relative_tolerance = 1e-9, .samples = 2001});
      REQUIRE(run.summary.ok());
      const std::vector<Check> checks = run_checks(c, defaults, "", model, run);
      CHECK(!checks.empty());
      for (const Check& check : checks) CHECK_MESSAGE(check.within(), text_of(check));
      for (const std::string& body : c.paths) CHECK(run.samples.has(body + ".x_m"));
    }
  }
}

}  // namespace
