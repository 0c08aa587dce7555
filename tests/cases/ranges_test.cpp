// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Parameters at the ends of their ranges: refused before a run, by name and with what is accepted,
// or run with the checks of the case within their tolerances.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using namespace yoke::tests;

std::string refusal(const std::string& name, const std::vector<std::string>& settings) {
  const Case& c = find_case(name);
  return message_of([&] { make_model(c, Parameters(c.parameters, settings)); });
}

void check_run(const std::string& name, const std::vector<std::string>& settings,
               int samples = 2001) {
  const Case& c = find_case(name);
  const Parameters p(c.parameters, settings);
  const Model model = make_model(c, p);
  const Result run =
      simulate(model, {.until = c.duration(p), .relative_tolerance = 1e-8, .samples = samples});
  INFO(name, " ", settings.front());
  REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
  const std::vector<Check> checks = run_checks(c, p, "", model, run);
  CHECK_FALSE(checks.empty());
  for (const Check& check : checks) CHECK_MESSAGE(check.within(), text_of(check));
}

}  // namespace

TEST_SUITE("ranges of parameters") {
  TEST_CASE("mechanisms that would be none are refused by the parameters that make them so") {
    CHECK(contains(refusal("newtons_cradle", {"stiffness=1000"}), "newtons_cradle: an impact of"));
    CHECK(contains(refusal("newtons_cradle", {"exponent=5"}), "accepted is less than 4.5 ms"));
    CHECK(contains(refusal("ratchet", {"stiffness=1000"}), "accepted is less than 0.2 mm"));
    CHECK(contains(refusal("ratchet", {"exponent=5"}), "with a greater stiffness"));
    CHECK(contains(refusal("cpva", {"inertia=0.003"}), "cpva: inertia = 0.003 kg m^2 must be"));
    CHECK(
        contains(refusal("cam_follower", {"rise=5deg"}),
                 "base = 30 mm and roller = 8 mm do not suit lift, rise and return: cam profile"));
    CHECK(contains(refusal("gear_selector", {"drum=5mm"}),
                   "drum = 5 mm and angle = 60 deg do not suit shift = 10 mm: slot 'groove'"));
    CHECK(refusal("gear_selector", {"drum=30mm"}) == "no error");
  }

  TEST_CASE("checks are right where little is exchanged, much is at stake, or nothing can happen") {
    check_run("truss", {"stiffness=1e8"});
    check_run("truss", {"load=0.001"});
    check_run("cpva", {"torque=0"});
    check_run("cpva", {"inertia=1000"});
    check_run("cpva", {"speed=20000"});
    check_run("cpva", {"inertia=0.006"});
    check_run("cam_follower", {"turns=0.01"});
    check_run("hanging_chain", {"angle=180deg"});
  }

  TEST_CASE("the limit of small clearance is the ideal slider-crank") {
    check_run("slider_guide_clearance", {"clearance=1um"}, 20001);
    check_run("slider_guide_clearance", {"clearance=5mm"}, 20001);
  }
}
