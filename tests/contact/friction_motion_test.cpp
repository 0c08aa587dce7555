// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Friction in motion: every formulation, the ledger, bristles over impacts and checkpoints.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/geometry/curve_slot.hpp>
#include <yoke/contact/laws/catalog/friction_catalog.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/friction/brown_mcphee.hpp>
#include <yoke/contact/laws/friction/coulomb.hpp>
#include <yoke/contact/laws/friction/lugre.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/integrators/analyses/equilibrium.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/tests/files.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

namespace {

constexpr double g = 9.81, radius = 0.05;

/// A disc that falls spinning on a floor, bounces and rolls away.
Model spinning_ball(const FrictionLaw& friction, double turn = 0.0, double height = 0.02) {
  Model m;
  const Vec2 start = rotate(turn, Vec2(0.0, radius + height));
  const BodyId ball = m.add(Body{.name = "ball",
                                 .mass = 1.0,
                                 .inertia = 0.5 * radius * radius,
                                 .pose = {start, 0.0},
                                 .twist = {rotate(turn, Vec2(0.3, 0.0)), 40.0}});
  m.add(Gravity{.acceleration = rotate(turn, Vec2(0.0, -g))});
  m.add(DiscOnCurve{.name = "floor",
                    .disc = {ball, start, radius},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, rotate(turn, Vec2(1.0, 0.0))),
                    .law = ContactLaw{PowerLaw{1e8, 1.5}, HuntCrossley{0.4}, friction},
                    .reference_force = 100.0});
  return m;
}

const LuGre bristles{
    .mu = 0.3, .mu_static = 0.4, .stribeck_velocity = 0.05, .stiffness = 2e5, .damping = 400.0};
const BrownMcPhee smooth{.mu = 0.3, .mu_static = 0.4, .threshold = 0.02};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

TEST_CASE("friction in impacts: all formulations agree, and the ledger is closed") {
  for (const FrictionLaw& friction : {FrictionLaw(smooth), FrictionLaw(bristles)}) {
    const Model model = spinning_ball(friction);
    const auto run = [&](const std::string& formulation, double rtol) {
      return simulate(
          model,
          {.until = 0.25, .relative_tolerance = rtol, .formulation = formulation, .samples = 251});
    };
    const Result best = run("arkode-projection", 1e-12);
    REQUIRE(best.summary.ok());
    CHECK(best.summary.energy_balance < 1e-9 * best.summary.energy_exchanged);
    CHECK(std::abs(best.final.v[0] - 0.3) > 0.1);  // the spin has changed its speed
    for (const FormulationNote& f : formulations()) {
      INFO(f.name << " " << friction.name());
      const double rtol = f.name == "generalised-alpha" ? 1e-7 : 1e-9;
      const Result r = run(std::string(f.name), rtol);
      REQUIRE(r.summary.ok());
      CHECK(r.events.size() == best.events.size());
      CHECK(std::abs(r.final.q[0] - best.final.q[0]) < 1e3 * rtol);
      CHECK(std::abs(r.final.v[2] - best.final.v[2]) < 1e5 * rtol);
      CHECK(r.summary.energy_balance < 1e3 * rtol * r.summary.energy_exchanged);
    }
  }
}

TEST_CASE("friction: the impulse of a skidding impact is mu times that of the normal force") {
  const FrictionLaw plain =
      make_friction("regularised-coulomb", {{"mu", 0.1}, {"threshold", 1e-4}});
  const Result r = simulate(spinning_ball(plain), {.until = 0.08, .relative_tolerance = 1e-10});
  REQUIRE(r.summary.ok());
  REQUIRE(r.events.size() >= 2);
  const double v_in = std::sqrt(2.0 * g * 0.02);
  const double v_out = -r.events[1].speed, contact = r.events[1].t - r.events[0].t;
  // It spins backwards: the floor pushes it back, v' = -mu N/m over the impact.
  const double expected = 0.3 - 0.1 * (v_in + v_out + g * contact);
  CHECK(r.final.v[0] == Approx(expected).epsilon(1e-8));
}

TEST_CASE("friction: what bristles hold when a contact ends is dissipated, and they begin unbent") {
  const Result r = simulate(spinning_ball(bristles),
                            {.until = 0.12, .relative_tolerance = 1e-10, .samples = 4001});
  REQUIRE(r.summary.ok());
  const Eigen::VectorXd bent = r["floor.bristles_m"], force = r["floor.normal_force_N"];
  CHECK(bent.cwiseAbs().maxCoeff() > 1e-4);
  for (Eigen::Index i = 0; i < bent.size(); ++i)
    if (force[i] == 0.0) CHECK(bent[i] == 0.0);
  CHECK(r.summary.energy_balance < 1e-9 * r.summary.energy_exchanged);
}

TEST_CASE("friction: a run taken up while bristles hold gives the same bits") {
  for (const char* formulation : {"arkode-projection", "ida-ggl", "cvode-projection"}) {
    INFO(formulation);
    const Model model = spinning_ball(bristles, 0.0, -1e-5);  // pressed by about its weight
    TemporaryFolder whole, cut_short;
    SimulationOptions o{.until = 0.4,
                        .relative_tolerance = 1e-8,
                        .formulation = formulation,
                        .samples = 101,
                        .checkpoints = {.folder = whole.path(), .every = 0.033}};
    const Result all = simulate(model, o);
    REQUIRE(all.summary.ok());
    CHECK(all["floor.bristles_m"].tail(1)[0] != 0.0);
    o.checkpoints.folder = cut_short.path();
    SimulationOptions stopped = o;
    stopped.observer = [](const Progress& p) { return p.t < 0.38; };
    CHECK(!simulate(model, stopped).summary.ok());
    o.checkpoints.resume = true;
    const Result resumed = simulate(model, o);
    CHECK(same_bits(resumed.samples.data(), all.samples.data()));
    CHECK((resumed.final.z.array() == all.final.z.array()).all());
  }
}

TEST_CASE("friction: turned, the same motion; mirrored, the mirrored one") {
  for (const FrictionLaw& friction : {FrictionLaw(smooth), FrictionLaw(bristles)}) {
    INFO(friction.name());
    const SimulationOptions options{.until = 0.2, .relative_tolerance = 1e-9, .samples = 21};
    const Result here = simulate(spinning_ball(friction), options);
    const Result there = simulate(spinning_ball(friction, 2.1), options);
    REQUIRE(here.summary.ok());
    REQUIRE(there.summary.ok());
    const Vec2 v(here.final.v[0], here.final.v[1]);
    CHECK((rotate(2.1, v) - Vec2(there.final.v[0], there.final.v[1])).norm() < 1e-7);
    CHECK(there.final.v[2] == Approx(here.final.v[2]).epsilon(1e-7));
  }
}

TEST_CASE("friction: a free roller in a slot rolls or skids, and the ledger is closed") {
  Model m;
  const Vec2 start(0.0, -0.0601 + 1e-9);
  const double r = 7.9e-3;
  const BodyId roller = m.add(Body{.name = "roller",
                                   .mass = 0.05,
                                   .inertia = 0.5 * 0.05 * r * r,
                                   .pose = {start, 0.0},
                                   .twist = {{0.4, 0.0}, 0.0}});
  m.add(Gravity{.acceleration = {0.0, -g}});
  m.add(PinInSlot{
      .name = "slot",
      .pin = {roller, start, r},
      .slot = {ground,
               arc_slot(
                   {.radius = 0.06, .direction = -0.5 * pi, .angle = 2.0, .half_width = 8e-3})},
      .law = ContactLaw{PowerLaw{1e8, 1.5}, HuntCrossley{0.4},
                        BrownMcPhee{.mu = 0.2, .mu_static = 0.25, .threshold = 5e-3}},
      .reference_force = 1.0});
  const Result run = simulate(m, {.until = 0.4, .relative_tolerance = 1e-10, .samples = 401});
  REQUIRE(run.summary.ok());
  CHECK(run.summary.energy_balance < 1e-9 * run.summary.energy_exchanged);
  const Eigen::VectorXd slip = run["slot.tangential_velocity_m_per_s"];
  CHECK(std::abs(slip[0]) > 0.3);           // thrown in without spin
  CHECK(std::abs(slip.tail(1)[0]) < 5e-3);  // it rolls
  CHECK(run["dissipated_J"].tail(1)[0] > 0.0);
}

TEST_CASE("friction: a roller rolls through a slot without slip, from straight parts into bends") {
  const double r = 7.9e-3, half_width = 8e-3, clearance = half_width - r;
  const double depth = std::pow(0.05 * g / 1e8, 2.0 / 3.0), arm = r - depth;
  Model m;
  const Vec2 start(-0.03, -clearance - depth);
  const BodyId roller = m.add(Body{.name = "roller",
                                   .mass = 0.05,
                                   .inertia = 0.5 * 0.05 * r * r,
                                   .pose = {start, 0.0},
                                   .twist = {{0.5, 0.0}, -0.5 / arm}});
  m.add(Gravity{.acceleration = {0.0, -g}});
  const Curve floor =
      chain({line_segment({-0.05, 0.0}, {0.0, 0.0}),
             circular_arc(
                 {.center = {0.0, 0.06}, .radius = 0.06, .start = -0.5 * pi, .angle = 0.5 * pi})});
  m.add(PinInSlot{.name = "slot",
                  .pin = {roller, start, r},
                  .slot = {ground, curve_slot({.centreline = floor, .half_width = half_width})},
                  .law = ContactLaw{PowerLaw{1e8, 1.5}, HuntCrossley{0.4}, Coulomb{0.4, 0.5}},
                  .reference_force = 1.0});
  const Result run = simulate(m, {.until = 0.1, .relative_tolerance = 1e-10, .samples = 401});
  REQUIRE(run.summary.ok());
  const Eigen::VectorXd slip = run["slot.tangential_velocity_m_per_s"], x = run["roller.x_m"],
                        N = run["slot.normal_force_N"], T = run["slot.friction_force_N"];
  CHECK(x[400] > 5e-3);  // in the bend
  CHECK(run.summary.energy_balance < 1e-9 * run.summary.energy_exchanged);
  Eigen::Index held = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (N[i] > 0.0) CHECK(std::abs(T[i]) <= 0.5 * N[i] * (1.0 + 1e-9));
    if (N[i] > 0.0 && std::abs(slip[i]) < 1e-14) ++held;
  }
  CHECK(held > 350);
}

TEST_CASE("friction: rest under gravity is found with it, too") {
  for (const FrictionLaw& friction :
       {FrictionLaw(smooth), FrictionLaw(bristles), FrictionLaw(Coulomb{0.3, 0.4})}) {
    INFO(friction.name());
    Model m;
    const Vec2 start(0.0, radius + 1e-3);
    const BodyId ball = m.add(
        Body{.name = "ball", .mass = 1.0, .inertia = 0.5 * radius * radius, .pose = {start, 0.0}});
    m.add(Gravity{.acceleration = {0.0, -g}});
    m.add(DiscOnCurve{.name = "bowl",
                      .disc = {ball, start, radius},
                      .body = ground,
                      .curve = circle({0.0, 1.0}, 1.0),
                      .law = ContactLaw{PowerLaw{1e8, 1.5}, HuntCrossley{0.4}, friction},
                      .reference_force = 10.0});
    const Equilibrium e = equilibrium(m, {.allow_neutral = true});
    REQUIRE_MESSAGE(e.found, e.reason);
    CHECK(e.state.q[1] == Approx(radius - std::pow(g / 1e8, 2.0 / 3.0)).epsilon(1e-9));
  }
}

}  // namespace
