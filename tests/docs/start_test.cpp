// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <cmath>
#include <utility>

#include <yoke/cases/case.hpp>
#include <yoke/core/equations/dynamics.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/docs/start_example.hpp>
#include <yoke/tests/documentation.hpp>

TEST_CASE("the code in docs/start_and_redundancy.md is compiled here and does what it says") {
  using namespace yoke;
  tests::check_blocks("docs/start_and_redundancy.md", "cpp", 1, {"tests/docs/start_example.hpp"});

  Model m;
  const BodyId upper =
      m.add({.name = "upper", .mass = 1.0, .inertia = 0.1, .pose = {{0.4, 0.3}, 0.6435}});
  m.add(Revolute{.name = "shoulder", .a = ground, .b = upper, .at = {0.0, 0.0}});
  const State state = start_example::elbow_down(m);
  CHECK(std::abs(state.q[2] + 0.6) < 1.6);
  CHECK(state.v[2] == 2.0);
}

TEST_CASE("the cases to look at are what they claim to be") {
  using namespace yoke;
  for (const auto& [name, redundant] : {std::pair{"parallelogram", 1}, {"n_four_bar", 0}}) {
    const cases::Case& c = cases::find_case(name);
    const Model model = make_model(c, cases::Parameters(c.parameters));
    Dynamics dynamics(model);
    State state = model.start_state();
    REQUIRE(dynamics.assemble(state));
    CHECK(static_cast<int>(dynamics.redundancy().redundant.size()) == redundant);
  }
}
