// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Static equilibria against closed forms: springs, chains, contacts, bistable mechanisms.
#include <doctest/doctest.h>

#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/dissipative/lankarani_nikravesh_1994.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/integrators/analyses/equilibrium.hpp>
#include <yoke/integrators/analyses/modes.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/tests/integrators/analyses/analysed.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/relaxing_spring.hpp>
#include <yoke/tests/integrators/wall.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

constexpr double g = 9.81;

/// A ball that can only go up and down, its lowest point `height` above the floor.
Model ball_over_floor(double height, const ContactLaw& law, bool guided = true) {
  Model m;
  const auto ball =
      m.add(Body{.name = "ball", .mass = 0.4, .inertia = 1e-4, .pose = {{0.0, height}, 0.0}});
  if (guided) m.add(Prismatic{.name = "guide", .a = ground, .b = ball, .along = {0.0, 1.0}});
  m.add(Wall{.name = "floor", .body = ball, .law = law});
  m.add(Gravity{});
  return m;
}

}  // namespace

TEST_CASE("a mass on a spring hangs m g / k lower, and the spring's force is its weight") {
  Model m;
  const auto mass =
      m.add(Body{.name = "mass", .mass = 3.0, .inertia = 0.1, .pose = {{0.0, -0.5}, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = mass, .along = {0.0, 1.0}});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = mass,
                            .at_a = {0.0, 0.0},
                            .at_b = {0.0, -0.5},
                            .stiffness = 700.0,
                            .damping = 4.0});
  m.add(Gravity{});
  const Equilibrium e = equilibrium(m);
  REQUIRE_MESSAGE(e.found, e.reason);
  CHECK(e.route == EquilibriumRoute::direct);
  CHECK(e["mass.y_m"] == doctest::Approx(-0.5 - 3.0 * g / 700.0).epsilon(1e-13));
  CHECK(e.stable);
  CHECK(e.lowest_stiffness.value() == doctest::Approx(700.0 / 3.0).epsilon(1e-12));
  CHECK(std::abs(e.residual) < 1e-9);
  // It stays there.
  const Result run = simulate(m, e.state, {.until = 1.0, .samples = 11});
  CHECK((run["mass.y_m"].array() - e["mass.y_m"]).abs().maxCoeff() < 1e-12);
}

TEST_CASE("a rod leans against a torsion spring: k phi = m g l/2 cos(phi)") {
  const double k = 6.0, mass = 1.5, length = 0.8;
  Model m;
  const auto rod = m.add(Body{.name = "rod",
                              .mass = mass,
                              .inertia = mass * length * length / 12.0,
                              .pose = {{0.5 * length, 0.0}, 0.0}});
  m.add(Revolute{.name = "hinge", .a = ground, .b = rod, .at = {0.0, 0.0}});
  m.add(TorsionalSpring{.name = "spring", .a = ground, .b = rod, .stiffness = k});
  m.add(Gravity{});
  const Equilibrium e = equilibrium(m);
  REQUIRE_MESSAGE(e.found, e.reason);
  const double phi = e["rod.angle_rad"];
  CHECK(phi < -0.3);
  CHECK(std::abs(k * phi + mass * g * 0.5 * length * std::cos(phi)) < 1e-12);
  CHECK(e["hinge.fy_N"] == doctest::Approx(mass * g).epsilon(1e-13));
  CHECK(std::abs(e["hinge.fx_N"]) < 1e-12);
}

TEST_CASE("a chain between two hooks hangs as its closed form says, found from a straight line") {
  // 10 links of 0.12 m over 1 m, weight w each, pins at both ends: the link's inclination follows
  // from the horizontal force H by tan(a_i) = (i - 4.5) w / H, and sum l cos(a_i) = 1 gives H.
  const int links = 10;
  const double l = 0.12, mass = 0.2, w = mass * g;
  Model m;
  BodyId last = ground;
  for (int i = 0; i < links; ++i) {
    // A shallow polygon with the right lengths, nearly flat ends: two straight halves.
    const double rise = std::sqrt(l * l - 0.01), side = i < links / 2 ? -1.0 : 1.0;
    const auto corner = [&](int k) { return Vec2(0.1 * k, -rise * std::min(k, links - k)); };
    const Vec2 a = corner(i), b = corner(i + 1);
    const auto link = m.add(Body{.name = "link " + std::to_string(i),
                                 .mass = mass,
                                 .inertia = mass * l * l / 12.0,
                                 .pose = {0.5 * (a + b), side * std::acos(0.1 / l)}});
    m.add(Revolute{.name = "pin " + std::to_string(i), .a = last, .b = link, .at = a});
    last = link;
  }
  m.add(Revolute{.name = "hook", .a = last, .b = ground, .at = {1.0, 0.0}});
  m.add(Gravity{});
  const Equilibrium e = equilibrium(m);
  REQUIRE_MESSAGE(e.found, e.reason);
  CHECK(e.stable);
  const double H = std::abs(e["pin 0.fx_N"]);
  double span = 0.0;
  for (int i = 0; i < links; ++i) {
    const double slope = (i - 4.5) * w / H;
    span += l / std::hypot(1.0, slope);
    CHECK(std::tan(e["link " + std::to_string(i) + ".angle_rad"]) ==
          doctest::Approx(slope).epsilon(1e-9));
  }
  CHECK(span == doctest::Approx(1.0).epsilon(1e-11));
  CHECK(e["pin 0.fy_N"] == doctest::Approx(0.5 * links * w).epsilon(1e-11));
}

TEST_CASE("a ball rests on the floor at the penetration (W/K)^(1/n), from above and from within") {
  const double K = 2e7, n = 1.5, d = std::pow(0.4 * g / K, 1.0 / n);
  for (const DissipativeLaw& damping : {DissipativeLaw(), DissipativeLaw(HuntCrossley{0.3}),
                                        DissipativeLaw(LankaraniNikravesh1994{.e = 0.7})})
    for (const double height : {0.3, 1e-6, -1e-4}) {
      INFO("from " << height << ", " << damping.name());
      const Equilibrium e = equilibrium(ball_over_floor(height, {PowerLaw{K, n}, damping}));
      REQUIRE_MESSAGE(e.found, e.reason);
      CHECK(-e["ball.y_m"] == doctest::Approx(d).epsilon(1e-9));
      CHECK(e["floor.normal_force_N"] == doctest::Approx(0.4 * g).epsilon(1e-8));
      CHECK(e.touching == std::vector<std::string>{"floor"});
      CHECK(e.stable);
    }
  // And its mode is that of the contact's stiffness.
  const Model m = ball_over_floor(0.3, {PowerLaw{K, n}});
  const Modes found = modes(m, equilibrium(m).state);
  REQUIRE(found.modes.size() == 1);
  CHECK(2.0 * pi * found.modes[0].frequency == doctest::Approx(std::sqrt(n * g / d)).epsilon(1e-7));
  CHECK(found.linearisation.warning.empty());
}

TEST_CASE("a pin comes to rest in its slot, on the wall its load presses it to") {
  // The scotch-yoke with its motor held and the slider pressed by a force: one wall bears it all.
  for (const double push : {-40.0, 40.0}) {
    INFO("push " << push);
    Model m = scotch_yoke();
    m.add(AppliedForce{.name = "push",
                       .body = m.find_body("slider"),
                       .at = m.body(m.find_body("slider")).pose.position,
                       .force = [push](double) { return Vec2(push, 0.0); }});
    const Equilibrium e = equilibrium(m);
    REQUIRE_MESSAGE(e.found, e.reason);
    CHECK(e.touching == std::vector<std::string>{"slot"});
    const double along = std::abs(e["slot.normal_force_N"]);
    CHECK(along >= 40.0);  // the wall is inclined
    CHECK(along < 60.0);
    // K d^n of the wall: inner and outer have nearly the same.
    CHECK(e["slot.penetration_m"] ==
          doctest::Approx(1e-3 * std::pow(along / 4.91e4, 1.0 / 1.10)).epsilon(2e-3));
    CHECK(std::abs(e["slider.vx_m_per_s"]) == 0.0);
    CHECK(e.stable);
  }
}

TEST_CASE("a bistable truss: below its limit it sinks a little, above it snaps through") {
  const double b = 1.0, h = 0.2, k = 5000.0;
  const double y = 0.16, load = truss_load(b, h, k, y);
  const Equilibrium sunk = equilibrium(truss(b, h, k, load, h));
  REQUIRE_MESSAGE(sunk.found, sunk.reason);
  CHECK(sunk["node.y_m"] == doctest::Approx(y).epsilon(1e-10));
  CHECK(sunk.stable);
  // The limit lies near h / sqrt(3).
  double limit = 0.0;
  for (double s = 0.05; s < h; s += 1e-4) limit = std::max(limit, truss_load(b, h, k, s));
  const Equilibrium snapped = equilibrium(truss(b, h, k, 1.2 * limit, h));
  REQUIRE_MESSAGE(snapped.found, snapped.reason);
  CHECK(snapped["node.y_m"] < -h);
  CHECK(truss_load(b, h, k, snapped["node.y_m"]) == doctest::Approx(1.2 * limit).epsilon(1e-9));
  CHECK(snapped.stable);
  // Between the two it can stand, but not for long.
  const double middle = 0.05;
  const Equilibrium between = equilibrium(truss(b, h, k, truss_load(b, h, k, middle), middle));
  REQUIRE(between.found);
  CHECK(between["node.y_m"] == doctest::Approx(middle));
  CHECK(!between.stable);
  CHECK(between.lowest_stiffness.value() < 0.0);
  CHECK(contains(between.reason, "unstable"));
}

TEST_CASE("element states come to rest too: a Maxwell damper does not hold anything") {
  Model m;
  const auto mass =
      m.add(Body{.name = "mass", .mass = 3.0, .inertia = 0.1, .pose = {{0.5, 0.0}, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = mass, .along = {1.0, 0.0}});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = mass,
                            .at_a = {0.0, 0.0},
                            .at_b = {0.5, 0.0},
                            .stiffness = 700.0,
                            .free_length = 0.4});
  m.add(RelaxingSpring{.name = "maxwell", .body = mass});
  const Equilibrium e = equilibrium(m);
  REQUIRE_MESSAGE(e.found, e.reason);
  CHECK(e["mass.x_m"] == doctest::Approx(0.4).epsilon(1e-12));
  CHECK(std::abs(e["maxwell.extension_m"]) < 1e-12);
}

TEST_CASE("what nothing holds is refused by its name") {
  Model free;
  free.add(Body{.name = "stone", .mass = 1.0, .inertia = 1.0});
  CHECK(contains(message_of([&] { equilibrium(free); }), "nothing holds 'stone'"));
  free.add(Gravity{});
  CHECK(contains(message_of([&] { equilibrium(free); }), "nothing holds 'stone': it moves away"));
  const ContactLaw law{PowerLaw{2e7, 1.5}};
  const std::string rolls = message_of([&] { equilibrium(ball_over_floor(0.1, law, false)); });
  CHECK_MESSAGE(contains(rolls, "nothing holds 'ball'"), rolls);
  const Equilibrium allowed =
      equilibrium(ball_over_floor(0.1, law, false), {.allow_neutral = true});
  REQUIRE(allowed.found);
  CHECK(allowed.neutral);
  CHECK_MESSAGE(contains(rolls, "allow_neutral, --allow-neutral"), rolls);
  CHECK(contains(message_of([&] { equilibrium(free, {.loads = {"wind"}}); }),
                 "there is no force 'wind'"));
}

TEST_CASE("no equilibrium: the reason names the worst residual, its size and its unit") {
  const Johnson law(1e11, 1e-4, 1e-3);
  const double press = 3.0 * law(law.limit()).force;  // the law cannot carry it
  Model m = ball_over_floor(-1e-6, {law});
  m.add(AppliedForce{
      .name = "press", .body = m.find_body("ball"), .at = {0.0, -1e-6}, .force = [press](double) {
        return Vec2(0.0, -press);
      }});
  const Equilibrium e = equilibrium(m);
  CHECK(!e.found);
  CHECK(!e.stable);
  CHECK(e.worst == "ball");
  CHECK(e.unit == "N");
  CHECK(std::abs(e.residual) > 1.0);
  CHECK(e.load > 0.2);
  CHECK(e.load < 0.4);
  const std::string left = fmt::format("at {:.3g} % of the loads 'ball' is left with {:.3g} N",
                                       100.0 * e.load, e.residual);
  CHECK_MESSAGE(contains(e.reason, "no equilibrium was found; " + left), e.reason);
  CHECK_MESSAGE(contains(e.reason, "Try another start pose"), e.reason);
}

TEST_CASE("a load that nothing can balance carries its body away, which is named") {
  Model m = ball_over_floor(0.0, {PowerLaw{2e7, 1.5}});
  m.add(applied_force("lift", m.find_body("ball"), {0.0, 0.0},
                      [](auto, const auto& b) { return vec(0.0 * b.x, 8.0 + 0.0 * b.y); }));
  const std::string away = message_of([&] { equilibrium(m); });
  CHECK_MESSAGE(contains(away, "nothing holds 'ball'"), away);
}
