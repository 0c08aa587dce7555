// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The bouncing disc against closed forms of flights and of the restitution that laws deliver.
#include <doctest/doctest.h>

#include <cmath>

#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/tests/cases/impacts/impact_case.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using yoke::tests::impact_run;

TEST_CASE("bouncing ball: every law delivers its restitution, in every bounce") {
  constexpr double e = 0.8, g = 9.81;
  for (const char* name : {"exact-restitution", "hu-guo", "flores", "lankarani-nikravesh",
                           "hunt-crossley", "gonthier", "herbert-mcwhannell"}) {
    CAPTURE(name);
    const double delivered = closed_form_restitution(name, {.restitution = e}, 1.5, 1.0).value();
    // Stiff: an impact is short, gravity changes the speed by little of itself.
    const auto run = impact_run("bouncing_ball", {"duration=1s"},
                                std::string("power:K=1e12,n=1.5+") + name + ":e=0.8");
    const std::vector<Impact> impacts = impacts_of(run.result, "floor");
    REQUIRE(impacts.size() >= 3);
    double v = std::sqrt(2.0 * g * 0.2);
    for (std::size_t i = 0; i < 3; ++i) {
      const double lost = g * (impacts[i].end - impacts[i].start);
      CHECK(std::abs(impacts[i].rebound - delivered * impacts[i].approach) < lost);
      CHECK(lost < 1e-3 * v);
      if (i > 0)
        CHECK(impacts[i].start - impacts[i - 1].end == doctest::Approx(2.0 * v / g).epsilon(1e-3));
      v *= delivered;
    }
  }
}

TEST_CASE("bouncing ball: it lies still in the end, and no lower than its weight presses it") {
  for (const char* law : {"restitution", "hunt-crossley", "johnson+hu-guo:e=0.6"}) {
    const auto run = impact_run("bouncing_ball", {"restitution=0.6"}, law);
    CHECK(run.checks.size() == 5);  // the rest is among them
    const Eigen::VectorXd y = run.result["ball.y_m"], f = run.result["floor.normal_force_N"];
    CHECK(f[f.size() - 1] == doctest::Approx(0.981).epsilon(1e-3));
    CHECK(y.minCoeff() > 0.02 - 0.6e-3);
  }
  // n = 1 and 2: (m g / K)^(1/n).
  for (const auto& [exponent, stiffness] : {std::pair{1.0, 1e5}, {2.0, 1e10}}) {
    const auto run =
        impact_run("bouncing_ball", {fmt::format("exponent={}", exponent), "duration=3s",
                                     fmt::format("stiffness={}", stiffness)});
    const Eigen::VectorXd y = run.result["ball.y_m"];
    CHECK(0.02 - y[y.size() - 1] ==
          doctest::Approx(std::pow(0.981 / stiffness, 1.0 / exponent)).epsilon(1e-5));
  }
}

TEST_CASE("bouncing ball: without loss it comes back to its height") {
  const auto run =
      impact_run("bouncing_ball", {"restitution=1"}, "", {.relative_tolerance = 1e-11});
  const std::vector<Impact> impacts = impacts_of(run.result, "floor");
  CHECK(impacts.size() == 10);
  for (const Impact& i : impacts) {
    CHECK(i.rebound == doctest::Approx(i.approach).epsilon(1e-9));
    CHECK(i.approach == doctest::Approx(std::sqrt(2.0 * 9.81 * 0.2)).epsilon(1e-8));
  }
}

}  // namespace
