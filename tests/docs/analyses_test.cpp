// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include <yoke/cases/case.hpp>
#include <yoke/tests/docs/analyses_example.hpp>
#include <yoke/tests/documentation.hpp>

namespace {

yoke::Model model_of(const char* name) {
  const yoke::cases::Case& c = yoke::cases::find_case(name);
  return make_model(c, yoke::cases::Parameters(c.parameters));
}

}  // namespace

TEST_CASE("the code in docs/analyses.md is compiled here and does what it says") {
  yoke::tests::check_blocks("docs/analyses.md", "cpp", 6, {"tests/docs/analyses_example.hpp"});

  using namespace yoke;
  const Model driven = model_of("slider_crank"), pendulum = model_of("hanging_chain");
  CHECK(analyses_example::slider_acceleration(driven).size() == 25);
  CHECK(analyses_example::largest_torque(driven) ==
        doctest::Approx(139.29195312875739).epsilon(1e-10));
  CHECK(analyses_example::lowest_frequency(pendulum) ==
        doctest::Approx(std::sqrt(1.5 * 9.81) / (2.0 * pi)).epsilon(1e-10));
  // The two limits of the truss: L^2 = b^2 + h^2, b^2 + y^2 = (L b^2)^(2/3).
  const double L = std::hypot(1.0, 0.2), y = std::sqrt(std::pow(L, 2.0 / 3.0) - 1.0);
  const double limit = 2.0 * 5000.0 * y * (L / std::hypot(1.0, y) - 1.0);
  const std::vector<double> loads = analyses_example::buckling_loads(model_of("truss"), 20.0);
  REQUIRE(loads.size() == 2);
  CHECK(loads[0] == doctest::Approx(limit).epsilon(1e-11));
  CHECK(loads[1] == doctest::Approx(-limit).epsilon(1e-11));
  const Result run = simulate(driven, {.until = 0.012, .samples = 25});
  CHECK(analyses_example::pivot_force(driven, run, 0.0) ==
        doctest::Approx(8253.228217346136).epsilon(1e-8));
  // The driver is in the model already: no drive is left to be found.
  CHECK_THROWS_AS(analyses_example::torque_needed(driven, run), ModelError);
}

TEST_CASE("the verbs of the analyses run their cases, and say why one does not fit") {
  const auto run = [](const std::string& arguments) {
    return std::system(("'" YOKE_BINARY_DIR "/yoke' " + arguments + " >/dev/null 2>&1").c_str()) >>
           8;
  };
  CHECK(run("kinematics scotch_yoke -o /dev/null/none") == 1);
  CHECK(run("equilibrium hanging_chain --format json") == 0);
  CHECK(run("equilibrium scotch_yoke --law johnson") == 1);  // the slider is free in its gap
  CHECK(run("equilibrium scotch_yoke --law johnson --allow-neutral") == 0);
  const std::string path = "equilibrium truss -o '" YOKE_BINARY_DIR "/tests/truss-path' --path ";
  CHECK(run(path + "0:1") == 0);
  CHECK(run(path + "left.stiffness=5000:100 --format json") == 0);
  CHECK(run(path + "0") == 1);
  CHECK(run(path + "stiffness=1:2") == 1);
  CHECK(run("modes hanging_chain --set links=3") == 0);
  CHECK(run("modes hanging_chain --about nowhere") == 2);
}
