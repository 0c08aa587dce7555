// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Contact laws whose numbers are changed during a run.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/contact/laws/dissipative/exact_restitution.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/friction/coulomb.hpp>
#include <yoke/contact/laws/friction/lugre.hpp>
#include <yoke/core/control/event_function.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/integrators/simulation.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// A disc above a floor, falling at `speed` [m/s] without weight, or with it if that is 0.
Model disc(const ContactLaw& law, double height, double speed, double along = 0.0) {
  Model m;
  const BodyId disc = m.add(Body{.name = "disc",
                                 .mass = 2.0,
                                 .inertia = 0.01,
                                 .pose = {{0.0, 0.1 + height}, 0.0},
                                 .twist = {{along, -speed}, 0.0}});
  if (speed == 0.0) m.add(Gravity{});
  m.add(DiscOnCurve{.name = "floor",
                    .disc = {.body = disc, .at = {0.0, 0.1 + height}, .radius = 0.1},
                    .body = ground,
                    .curve = straight_line({-5.0, 0.0}, {5.0, 0.0}),
                    .law = law});
  return m;
}

ContactLaw bouncing(double e) {
  return {changeable(PowerLaw{1e7, 1.0}), changeable(ExactRestitution{e})};
}

}  // namespace

TEST_CASE("a restitution that is set is that of the next impact") {
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const Model m = disc(bouncing(0.8), 0.1, 1.0);
    Simulation run(m, {.until = 0.2, .formulation = formulation, .samples = 0});
    run.advance_to(0.05);
    run.set("floor.restitution", 0.4);
    run.advance_to(0.2);
    CHECK(run.get("disc.vy_m_per_s") == doctest::Approx(0.4).epsilon(1e-4));
    CHECK(std::abs(run.get("balance_J")) < 1e-4);
  }
}

TEST_CASE("a changeable law whose numbers are left alone gives the bits of the law itself") {
  const ContactLaw fixed{per_mm(49070, 1.1), HuntCrossley{0.3},
                         Coulomb{.mu = 0.1, .mu_static = 0.1}};
  const ContactLaw may_change{changeable(per_mm(49070, 1.1)), changeable(HuntCrossley{0.3}),
                              changeable(Coulomb{.mu = 0.1, .mu_static = 0.1})};
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const SimulationOptions options{.until = 0.4, .formulation = formulation, .samples = 101};
    const Result a = simulate(disc(fixed, 0.05, 0.0, 0.3), options);
    const Result b = simulate(disc(may_change, 0.05, 0.0, 0.3), options);
    REQUIRE(a.events.size() > 2);
    CHECK(a.samples.data() == b.samples.data());
    CHECK(a.final.q == b.final.q);
  }
}

TEST_CASE("a run whose law was changed at once is that of a model with the other law") {
  const Model changed = disc(bouncing(0.8), 0.1, 1.0), made = disc(bouncing(0.5), 0.1, 1.0);
  Simulation run(changed, {.until = 0.3, .samples = 0}), other(made, {.until = 0.3, .samples = 0});
  run.set("floor.restitution", 0.5);
  run.advance_to(0.3);
  other.advance_to(0.3);
  CHECK(run.state().v[1] == doctest::Approx(other.state().v[1]).epsilon(1e-9));
}

TEST_CASE("a stiffness that is set within a contact keeps the ledger") {
  for (const std::string& formulation : {"arkode-projection", "ida-ggl"}) {
    const Model m = disc({changeable(PowerLaw{1e6, 1.0})}, 1e-6, 1.0);
    Simulation run(m, {.until = 0.02, .formulation = formulation, .samples = 0});
    run.advance_to(0.001);  // deep within
    REQUIRE(run.get("floor.normal_force_N") > 100.0);
    const double d = run.get("floor.penetration_m"), v = run.get("disc.vy_m_per_s");
    run.set("floor.stiffness", 2e6);
    CHECK(run.get("floor.normal_force_N") == doctest::Approx(2e6 * d).epsilon(1e-9));
    run.advance_to(0.02);
    // What was kinetic then and what the stiffer wall stored.
    const double expected = std::sqrt(v * v + 2e6 * d * d / 2.0);
    CHECK(run.get("disc.vy_m_per_s") == doctest::Approx(expected).epsilon(1e-5));
    CHECK(std::abs(run.get("balance_J")) < 1e-5);
  }
}

TEST_CASE("friction that an event sets: a sliding disc that cannot turn brakes at mu g") {
  constexpr double g = 9.81;
  Model m = disc({changeable(PowerLaw{1e7, 1.0}), HuntCrossley{1.0},
                  changeable(Coulomb{.mu = 0.1, .mu_static = 0.5})},
                 -2.0 * g / 1e7, 0.0, 2.0);
  m.add(AngleDriver{.name = "lock", .body = BodyId{1}, .angle = constant(0.0)});
  m.add(EventFunction{.name = "brake",
                      .function = [](const Motion& at) { return at.t - 0.5; },
                      .set = {{"floor.mu", 0.3}}});
  Simulation run(m, {.until = 1.0, .samples = 0});
  run.advance_to(0.8);
  CHECK(run.get("disc.vx_m_per_s") ==
        doctest::Approx(2.0 - 0.1 * g * 0.5 - 0.3 * g * 0.3).epsilon(1e-5));
  CHECK(run.get("floor.mu") == 0.3);
}

TEST_CASE("bristles that are made stiffer keep the ledger") {
  const Model m = disc({PowerLaw{1e7, 1.0}, HuntCrossley{1.0},
                        changeable(LuGre{.mu = 0.3, .mu_static = 0.4, .stiffness = 1e5})},
                       0.0, 0.0, 0.5);
  Simulation run(m, {.until = 0.2, .formulation = "ida-ggl", .samples = 0});
  run.advance_to(0.05);
  run.set("floor.stiffness", 3e5);
  run.set("floor.mu_static", 0.5);
  run.set("floor.mu", 0.4);
  run.advance_to(0.2);
  CHECK(std::abs(run.get("balance_J")) < 1e-5);
  CHECK_THROWS_WITH_AS(
      run.set("floor.mu", 0.9),
      doctest::Contains("'floor': friction 'lugre': mu_static = 0.5 must be at least "
                        "mu = 0.9"),
      ModelError);
  CHECK(run.get("floor.mu") == 0.4);
}
