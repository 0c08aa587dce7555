// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Contacts that begin and end, through the whole engine and with both formulations.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/wall.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

const PowerLaw linear{3.1e7, 1.0};
const PowerLaw hertzian{2.7e9, 1.5};
constexpr double mass = 0.83;

/// A ball at height y with the velocity v_y, over a floor at 0.
Model ball_over_floor(double y, double v_y, const ContactLaw& law, double g) {
  Model m;
  const BodyId ball = m.add(Body{.name = "ball",
                                 .mass = mass,
                                 .inertia = 1e-3,
                                 .pose = {{0.2, y}, 0.3},
                                 .twist = {{0.4, v_y}, 1.1}});
  m.add(Gravity{.acceleration = {0.0, -g}});
  m.add(Wall{.name = "floor", .body = ball, .law = law});
  return m;
}

/// Real restitution of F = F_e (1 + chi d') for X = chi v_i: the root of
/// X (1 + e) = ln((1 + X)/(1 - e X)), by bisection.
double restitution(double X) {
  double low = 0.0, high = std::min(1.0, 1.0 / X);
  for (int i = 0; i < 100; ++i) {
    const double e = 0.5 * (low + high);
    (X * (1.0 + e) > std::log((1.0 + X) / (1.0 - e * X)) ? low : high) = e;
  }
  return low;
}

long count(const Result& run, const std::string& kind) {
  return std::count_if(run.events.begin(), run.events.end(),
                       [&](const EventRecord& e) { return e.kind == kind; });
}

double last(const Result& run, const std::string& column) {
  return run[column](static_cast<Eigen::Index>(run.samples.rows()) - 1);
}

}  // namespace

TEST_CASE("a falling ball meets the floor when it must") {
  // Up with v, down to the floor from h: t = (v + sqrt(v^2 + 2 g h))/g.
  const double h = 0.37, v = 0.6, g = 9.81;
  const double speed = std::sqrt(v * v + 2.0 * g * h), t = (v + speed) / g;
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const Result run =
        simulate(ball_over_floor(h, v, {hertzian}, g),
                 {.until = t + 1e-4, .relative_tolerance = 1e-12, .formulation = formulation});
    REQUIRE(run.summary.ok());
    REQUIRE(run.events.size() == 1);
    CHECK(run.events[0].kind == "onset");
    CHECK(run.events[0].element == "floor");
    CHECK(std::abs(run.events[0].t - t) < 1e-12);
    CHECK(std::abs(run.events[0].speed - speed) < 1e-11);
    CHECK(run.final.contacts[0].onset_time == run.events[0].t);
    CHECK(run.final.contacts[0].approach_velocity == run.events[0].speed);
    CHECK(run.final.contacts[0].effective_mass == doctest::Approx(mass).epsilon(1e-13));
  }
}

TEST_CASE("a swinging mass meets the floor when it must") {
  // y = A sin(w t) on a spring along y, whose other end is far away: a spring of the axis only.
  const double k = 530.0, A = 0.07, w = std::sqrt(k / mass), floor = -0.041;
  const double t = (pi + std::asin(-floor / A)) / w;
  for (const std::string& formulation : both_formulations) {
    INFO(formulation);
    Model m;
    const BodyId ball =
        m.add(Body{.name = "ball", .mass = mass, .inertia = 1e-3, .twist = {{0.0, A * w}, 0.0}});
    m.add(applied_force("spring", ball, {0.0, 0.0},
                        [k](auto, const auto& b) { return vec(0.0 * b.x, -k * b.y); }));
    m.add(Wall{.name = "floor", .body = ball, .law = {hertzian}, .height = floor});
    const Result run =
        simulate(m, {.until = 1.01 * t, .relative_tolerance = 1e-12, .formulation = formulation});
    REQUIRE(run.summary.ok());
    REQUIRE(run.events.size() >= 1);
    CHECK(std::abs(run.events[0].t - t) < 1e-11);  // of which the swing itself is the larger part
  }
}

TEST_CASE("an impact returns the closed form of its law") {
  for (const std::string& formulation : both_formulations) {
    for (const PowerLaw& elastic : {linear, hertzian}) {
      for (const double e : {0.9, 0.5, 0.1}) {
        INFO(formulation, " n = ", elastic.n, " e = ", e);
        const Result run =
            simulate(ball_over_floor(1e-4, -0.19, {elastic, hunt_crossley_restitution(e)}, 0.0),
                     {.until = 0.012, .relative_tolerance = 1e-12, .formulation = formulation});
        REQUIRE(run.summary.ok());
        REQUIRE(run.events.size() == 2);
        CHECK(run.events[1].kind == "release");
        const double real = -run.events[1].speed / run.events[0].speed;
        CHECK(std::abs(real - restitution(1.5 * (1.0 - e))) < 1e-8);
        CHECK(std::abs(last(run, "ball.vy_m_per_s") + run.events[1].speed) < 1e-14);
        CHECK(last(run, "floor.penetration_m") < 0.0);
        CHECK(last(run, "stored_J") == 0.0);
      }
    }
  }
}

TEST_CASE("the closed form agrees with values published to ten digits") {
  CHECK(restitution(0.15) == doctest::Approx(0.9090157413).epsilon(1e-9));
  CHECK(restitution(0.75) == doctest::Approx(0.6629622000).epsilon(1e-9));
  CHECK(restitution(10.0) == doctest::Approx(0.0999816248).epsilon(1e-8));
}

TEST_CASE("a conservative impact gives the speed back") {
  for (const std::string& formulation : both_formulations) {
    for (const PowerLaw& elastic : {linear, hertzian}) {
      INFO(formulation, " n = ", elastic.n);
      const Result run =
          simulate(ball_over_floor(1e-4, -0.19, {elastic}, 0.0),
                   {.until = 0.01, .relative_tolerance = 1e-13, .formulation = formulation});
      REQUIRE(run.summary.ok());
      REQUIRE(run.events.size() == 2);
      // BDF keeps each of its 300 to 600 steps to the tolerance, and what they leave adds up.
      const double bar = formulation == "arkode-projection" ? 1e-10 : 1e-9;
      CHECK(std::abs(run.events[1].speed / run.events[0].speed + 1.0) < bar);
    }
  }
}

TEST_CASE("contacts of one body that begin at the same instant all begin") {
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    Model m;
    const BodyId table =
        m.add(Body{.name = "table", .mass = mass, .inertia = 0.02, .pose = {{0.2, 0.137}, 0.0}});
    m.add(Gravity{});
    for (const auto& [name, x] : {std::pair{"left", -0.1}, {"middle", 0.0}, {"right", 0.1}})
      m.add(Wall{.name = name, .body = table, .law = {hertzian}, .point = {x, -0.02}});
    const Result run =
        simulate(m, {.until = 0.17, .relative_tolerance = 1e-10, .formulation = formulation});
    REQUIRE(run.summary.ok());
    REQUIRE(run.events.size() == 6);
    for (const std::size_t first : {std::size_t{0}, std::size_t{3}}) {
      for (std::size_t i = first; i < first + 3; ++i) {
        CHECK(run.events[i].kind == (first == 0 ? "onset" : "release"));
        CHECK(run.events[i].t == run.events[first].t);
        CHECK(run.events[i].element != run.events[first + (i - first + 1) % 3].element);
      }
    }
    CHECK(std::abs(last(run, "table.angle_rad")) < 1e-9);
  }
}

TEST_CASE("contacts of two bodies that begin at the same instant both begin") {
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    Model m;
    const Body ball{.name = "light", .mass = 0.3, .inertia = 1e-3, .pose = {{0.0, 0.137}, 0.0}};
    Body other = ball;
    other.name = "heavy";
    other.mass = 4.1;
    other.pose.position.x() = 0.7;
    const BodyId light = m.add(ball), heavy = m.add(other);
    m.add(Gravity{});
    m.add(Wall{.name = "under light", .body = light, .law = {hertzian}});
    m.add(Wall{.name = "under heavy", .body = heavy, .law = {linear}});
    const Result run =
        simulate(m, {.until = 0.171, .relative_tolerance = 1e-10, .formulation = formulation});
    REQUIRE(run.summary.ok());
    REQUIRE(run.events.size() == 4);
    CHECK(run.events[0].t == run.events[1].t);
    CHECK(run.events[0].element != run.events[1].element);
    for (const char* column : {"light.vy_m_per_s", "heavy.vy_m_per_s"})
      CHECK(last(run, column) > 1.2);
  }
}

TEST_CASE("a touch at the top of a throw is seen however shallow it is, and not looped on") {
  // A ball rises to `depth` beyond the wall above it: upside down, with g away from the wall.
  for (const std::string& formulation : every_formulation) {
    for (const double rtol : {1e-6, 1e-9, 1e-12}) {
      for (const double depth : {1e-3, 1e-5, 1e-7, 1e-9, 1e-14, 0.0, -1e-14, -1e-9}) {
        INFO(formulation, " rtol = ", rtol, " depth = ", depth);
        const double g = 9.81, v = 1.3;
        const Result run =
            simulate(ball_over_floor(0.5 * v * v / g - depth, -v, {hertzian}, -g),
                     {.until = 0.4, .relative_tolerance = rtol, .formulation = formulation});
        REQUIRE(run.summary.ok());
        if (depth > 1e-8 && depth > 10.0 * rtol) CHECK(count(run, "onset") == 1);
        if (depth < 0.0 && -depth > 10.0 * rtol) CHECK(run.events.empty());
        CHECK(count(run, "onset") == count(run, "release"));
        CHECK(run.events.size() <= 4);
        // Back where an elastic contact, or none, sends it.
        CHECK(last(run, "ball.vy_m_per_s") > 0.0);
      }
    }
  }
}

TEST_CASE("a ball dropped on the floor comes to rest on it") {
  const double g = 9.81;
  for (const std::string& formulation : every_formulation) {
    for (const double rtol : {1e-6, 1e-10}) {
      INFO(formulation, " rtol = ", rtol);
      const Result run =
          simulate(ball_over_floor(0.05, 0.0, {hertzian, hunt_crossley_restitution(0.5)}, g),
                   {.until = 1.5, .relative_tolerance = rtol, .formulation = formulation});
      REQUIRE(run.summary.ok());
      const auto& events = run.events;
      // Every bounce is slower than the one before.
      double speed = 10.0;
      for (const EventRecord& e : events) {
        if (e.kind != "onset") continue;
        CHECK(e.speed < 0.9 * speed);
        speed = e.speed;
      }
      CHECK(events.size() > 8);
      CHECK(events.size() < 60);
      CHECK(events.back().kind == "onset");
      CHECK(run.final.contacts[0].phase == ContactPhase::compressing);
      const double rest = std::pow(mass * g / hertzian.K, 1.0 / hertzian.n);
      CHECK(last(run, "floor.penetration_m") == doctest::Approx(rest).epsilon(1e-3));
      CHECK(last(run, "floor.normal_force_N") == doctest::Approx(mass * g).epsilon(1e-3));
      // All of the fall is dissipated, but for the little that is stored and the weight's sinking.
      CHECK(last(run, "floor.dissipated_J") == doctest::Approx(mass * g * 0.05).epsilon(1e-3));
    }
  }
}

TEST_CASE("a ball hardly damped goes on bouncing without an end and without a pile of events") {
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const Result run =
        simulate(ball_over_floor(1e-3, 0.0, {hertzian}, 9.81),
                 {.until = 1.0, .relative_tolerance = 1e-9, .formulation = formulation});
    REQUIRE(run.summary.ok());
    // Free flight down and up takes 2 sqrt(2 h/g), the contact 1/40 of it.
    const double flight = 2.0 * std::sqrt(2e-3 / 9.81);
    CHECK(count(run, "onset") > static_cast<long>(0.95 / flight));
    CHECK(count(run, "onset") < static_cast<long>(1.05 / flight) + 1);
    CHECK(run["ball.y_m"].maxCoeff() < 1e-3 * (1.0 + 1e-5));
    // In 70 impacts; a multistep method, which starts anew in each, loses up to 3e-7 in one.
    const bool one_step = formulation.starts_with("arkode") || formulation == "generalised-alpha";
    const double bar = one_step ? 1e-5 : 3e-5;
    CHECK(run.summary.energy_balance < bar * run.summary.energy_exchanged);
  }
}

TEST_CASE("a run may start touching") {
  for (const std::string& formulation : every_formulation) {
    for (const double v : {0.0, -1e-9, 1e-9, -0.1, 0.1}) {
      INFO(formulation, " v = ", v);
      const Result run =
          simulate(ball_over_floor(0.0, v, {hertzian, hunt_crossley_restitution(0.5)}, 9.81),
                   {.until = 0.1, .relative_tolerance = 1e-9, .formulation = formulation});
      REQUIRE(run.summary.ok());
      REQUIRE(run.events.size() >= 1);
      CHECK(run.events[0].kind == "onset");
      if (v <= 0.0) CHECK(run.events[0].t < 1e-5);
      if (v == 0.1) CHECK(run.events[0].t == doctest::Approx(2.0 * v / 9.81).epsilon(1e-9));
      CHECK(run["floor.penetration_m"].maxCoeff() < 1e-4);
      CHECK(run.final.contacts[0].phase == ContactPhase::compressing);
      CHECK(run.events.size() < 15);
    }
  }
}

TEST_CASE("a run may start at rest in contact and then nothing happens") {
  const double rest = std::pow(mass * 9.81 / hertzian.K, 1.0 / hertzian.n);
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const Result run =
        simulate(ball_over_floor(-rest, 0.0, {hertzian, HuntCrossley{0.3}}, 9.81),
                 {.until = 0.1, .relative_tolerance = 1e-9, .formulation = formulation});
    REQUIRE(run.summary.ok());
    REQUIRE(run.events.size() == 1);
    CHECK(run.events[0].kind == "onset");
    CHECK(run.events[0].t == 0.0);
    CHECK(run.summary.events == 1);
    CHECK((run["floor.penetration_m"].array() - rest).abs().maxCoeff() < 1e-4 * rest);
  }
}

TEST_CASE("a pin pressed round the end of a slot passes from wall to cap and its ledger closes") {
  // A force that turns presses a free pin along the outer wall, round the cap and along the inner
  // wall back. Three laws of very different stiffness, so the stored energy jumps at the borders.
  const auto law = [](double K, double n) { return ContactLaw(PowerLaw{K, n}, HuntCrossley{1.0}); };
  Model m;
  const Vec2 start(0.06, 0.0);
  const BodyId pin =
      m.add(Body{.name = "pin", .mass = 0.05, .inertia = 1e-6, .pose = {start, 0.0}});
  m.add(PinInSlot{
      .name = "slot",
      .pin = {pin, start, 7.9_mm},
      .slot = {ground, arc_slot({.radius = 60.0_mm, .angle = 60.0_deg, .half_width = 8.0_mm})},
      .law = {law(2e7, 1.1), law(3e7, 1.1), law(9e8, 1.3)}});
  m.add(AppliedForce{.name = "push", .body = pin, .at = start, .force = [](double t) -> Vec2 {
                       return rotate(14.0 * t, {50.0, 0.0});
                     }});
  for (const std::string& formulation : both_formulations) {
    INFO(formulation);
    const Result run = simulate(
        m,
        {.until = 0.25, .relative_tolerance = 1e-11, .formulation = formulation, .samples = 501});
    REQUIRE(run.summary.ok());
    CHECK(count(run, "region") >= 2);
    std::vector<std::string> seen;
    for (const EventRecord& e : run.events) {
      if (e.kind == "region") {
        CHECK(e.element == "slot");
        // At the border the two formulas of the distance agree: still in contact.
        CHECK(e.penetration > -1e-11);
      }
      if (std::find(seen.begin(), seen.end(), e.region) == seen.end()) seen.push_back(e.region);
    }
    CHECK(seen.size() == 3);
    CHECK(run.summary.energy_balance < 1e-7 * run.summary.energy_exchanged);
  }
}

TEST_CASE("a sample on the instant of an event and an event on the end of the run are both kept") {
  // The ball lands after 1/8 s exactly: 2 y = g t^2 with g = 16, y = 1/8.
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    for (const double until : {0.125, 0.25}) {
      const Result run = simulate(
          ball_over_floor(0.125, 0.0, {hertzian}, 16.0),
          {.until = until, .relative_tolerance = 1e-10, .formulation = formulation, .samples = 5});
      REQUIRE(run.summary.ok());
      REQUIRE(run.samples.rows() == 5);
      CHECK(run["t_s"](4) == until);
      CHECK(run.final.t == until);
      CHECK(run["ball.y_m"](2) == doctest::Approx(until == 0.25 ? 0.0 : 0.125 - 8.0 / 256.0));
    }
  }
}

TEST_CASE("a snapshot taken in contact or in flight goes on as the run that was not interrupted") {
  const Model model = scotch_yoke();
  for (const std::string& formulation : both_formulations) {
    SimulationOptions options{
        .until = 0.012, .relative_tolerance = 1e-11, .formulation = formulation, .samples = 2};
    const Result whole = simulate(model, options);
    REQUIRE(whole.events.size() >= 10);
    const double in_contact = 0.5 * (whole.events[2].t + whole.events[3].t);
    const double in_flight = 0.5 * (whole.events[3].t + whole.events[4].t);
    for (const double t : {in_contact, in_flight}) {
      INFO(formulation, " ", t);
      options.until = t;
      const Result first = simulate(model, options);
      CHECK((first.final.contacts[0].phase == ContactPhase::apart) == (t == in_flight));
      options.until = 0.012;
      const Result second = simulate(model, first.final, options);
      REQUIRE(second.summary.ok());
      CHECK(first.events.size() + second.events.size() == whole.events.size());
      // Errors of 1e-11 of the size, which the bounces multiply.
      CHECK((second.final.q - whole.final.q).cwiseAbs().maxCoeff() < 1e-10);
      CHECK((second.final.v - whole.final.v).cwiseAbs().maxCoeff() < 1e-6);
      CHECK((second.final.energy - whole.final.energy).cwiseAbs().maxCoeff() < 1e-5);
      CHECK(second.summary.energy_balance < 1e-7 * whole.summary.energy_exchanged);
    }
  }
}

TEST_CASE("two slots with different laws in one model keep their own regions, events and ledgers") {
  // Two pins of one crank, each in its own slotted slider.
  Model m = scotch_yoke();
  const BodyId crank = m.find_body("crank");
  const double r = 30.0_mm, R = 40.0_mm, phi = -31.0_deg;
  const double root = std::sqrt(R * R - std::pow(r * std::sin(phi), 2));
  const Vec2 tip = rotate(phi, Vec2(-r, 0.0)), centre(-r * std::cos(phi) - root, 0.0);
  const double omega = 24.0 * pi;
  const double speed = r * std::sin(phi) * (1.0 + r * std::cos(phi) / root) * omega;
  const BodyId second = m.add(Body{.name = "second",
                                   .mass = 0.7,
                                   .inertia = 1e-3,
                                   .pose = {centre, 0.0},
                                   .twist = {{speed, 0.0}, 0.0}});
  m.add(Prismatic{.name = "second guide", .a = ground, .b = second, .along = {1.0, 0.0}});
  m.add(PinInSlot{
      .name = "second slot",
      .pin = {crank, tip, 5.0_mm},
      .slot = {second,
               arc_slot({.center = centre, .radius = R, .angle = 110.0_deg, .half_width = 5.2_mm})},
      .law = ContactLaw(hertzian, hunt_crossley_restitution(0.7))});
  const Result alone = simulate(scotch_yoke(), {.until = 0.02, .relative_tolerance = 1e-11});
  const Result run = simulate(m, {.until = 0.02, .relative_tolerance = 1e-11});
  REQUIRE(run.summary.ok());
  // The crank's speed is imposed, so the first slider knows nothing of the second.
  CHECK((run["slider.x_m"] - alone["slider.x_m"]).cwiseAbs().maxCoeff() < 1e-9);
  const auto of = [&](const std::string& name) {
    return std::count_if(run.events.begin(), run.events.end(),
                         [&](const EventRecord& e) { return e.element == name; });
  };
  CHECK(of("slot") == static_cast<long>(alone.events.size()));
  CHECK(of("second slot") > 2);
  CHECK(last(run, "slot.dissipated_J") ==
        doctest::Approx(last(alone, "slot.dissipated_J")).epsilon(1e-5));
  CHECK(last(run, "second slot.dissipated_J") > 0.0);
  CHECK(run.summary.energy_balance < 1e-7 * run.summary.energy_exchanged);
}
