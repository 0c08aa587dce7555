// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Over-closed mechanisms and singular positions in motion, in every formulation.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <yoke/cases/n_four_bar.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/gear.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/tests/integrators/wall.hpp>
#include <yoke/tests/messages.hpp>
#include <yoke/tests/over_closed.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

BodyId add_rod(Model& m, const std::string& name, const Vec2& from, const Vec2& to,
               double omega = 0.0) {
  const Vec2 d = to - from;
  return m.add({.name = name,
                .mass = 1.0,
                .inertia = 0.1,
                .pose = {0.5 * (from + to), std::atan2(d.y(), d.x())},
                .twist = {0.5 * omega * perp(d), omega}});
}

/// A coupler on parallel cranks at x = 0, 1 and, if there are three, 0.5; the third has next to no
/// inertia, so that it does not change the motion.
Model parallelogram(int cranks) {
  Model m;
  const Vec2 up = rotate(1.1, {0.3, 0.0});
  const BodyId coupler = add_rod(m, "coupler", up, up + Vec2(1.0, 0.0));
  for (int i = 0; i < cranks; ++i) {
    const Vec2 foot(i == 0 ? 0.0 : i == 1 ? 1.0 : 0.5, 0.0);
    const std::string name = "crank " + std::to_string(i + 1);
    const BodyId crank = m.add({.name = name,
                                .mass = i < 2 ? 1.0 : 1e-15,
                                .inertia = i < 2 ? 0.1 : 1e-16,
                                .pose = {foot + 0.5 * up, 1.1},
                                .twist = {1.0 * perp(up), 2.0}});
    m.add(Revolute{.name = name + " foot", .a = ground, .b = crank, .at = foot});
    m.add(Revolute{.name = name + " tip", .a = coupler, .b = crank, .at = foot + up});
  }
  m.add(Gravity{});
  return m;
}

/// Crank and rod of 1 m each, slider along x: singular with the crank upright, where the slider is
/// at the pivot and the rod may begin to turn with the crank.
Model equal_slider_crank(double angle, double omega) {
  Model m;
  const Vec2 tip = rotate(angle, {1.0, 0.0}), end(2.0 * tip.x(), 0.0);
  const BodyId crank = add_rod(m, "crank", {0.0, 0.0}, tip, omega);
  const BodyId rod = m.add({.name = "rod",
                            .mass = 1.0,
                            .inertia = 0.1,
                            .pose = {0.5 * (tip + end), -angle},
                            .twist = {{-1.5 * omega * tip.y(), 0.5 * omega * tip.x()}, -omega}});
  const BodyId slider = m.add({.name = "slider",
                               .mass = 1.0,
                               .inertia = 0.1,
                               .pose = {end, 0.0},
                               .twist = {{-2.0 * omega * tip.y(), 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "pin", .a = crank, .b = rod, .at = tip});
  m.add(Revolute{.name = "wrist", .a = rod, .b = slider, .at = end});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  return m;
}

/// What each step leaves adds up further than with a method of one step.
bool is_multistep(const FormulationNote& f) { return f.family == "BDF" || f.family == "Adams"; }

/// What may be asked of a formulation: Runge-Kutta, multistep, or a method of order 2.
double bar(const FormulationNote& f, double runge_kutta, double multistep, double second_order) {
  return f.order <= 2 ? second_order : is_multistep(f) ? multistep : runge_kutta;
}

/// Three parallelograms that have nothing to do with each other, each turning 1 rad/s, `behind` s after
/// the one before: every half turn three singular positions. They lie flat pi - 1.1 s after the start.
Model parallelograms_in_a_row(double behind) {
  Model m;
  for (int i = 0; i < 3; ++i) {
    const std::string name = std::to_string(i + 1);
    const Vec2 left(0.0, 3.0 * i), right = left + Vec2(2.0, 0.0);
    const Vec2 up = rotate(1.1 - behind * i, {1.0, 0.0});
    const BodyId a = add_rod(m, "left " + name, left, left + up, 1.0);
    const BodyId b = add_rod(m, "right " + name, right, right + up, 1.0);
    const BodyId coupler = m.add({.name = "coupler " + name,
                                  .mass = 1.0,
                                  .inertia = 0.1,
                                  .pose = {left + up + Vec2(1.0, 0.0), 0.0},
                                  .twist = {perp(up), 0.0}});
    m.add(Revolute{.name = "foot a" + name, .a = ground, .b = a, .at = left});
    m.add(Revolute{.name = "foot b" + name, .a = ground, .b = b, .at = right});
    m.add(Revolute{.name = "tip a" + name, .a = a, .b = coupler, .at = left + up});
    m.add(Revolute{.name = "tip b" + name, .a = b, .b = coupler, .at = right + up});
  }
  return m;
}

double n_four_bar_error(const Result& run, int loops) {
  const Eigen::VectorXd t = run["t_s"], angle = run["link 0.angle_rad"];
  double worst = 0.0;
  for (Eigen::Index i = 0; i < t.size(); ++i)
    worst = std::max(worst, std::abs(angle[i] - cases::n_four_bar_angle(loops, t[i])));
  return worst;
}

}  // namespace

TEST_CASE("three parallel cranks move as two, though the choice of equations changes on the way") {
  for (const FormulationNote& formulation : formulations()) {
    INFO(formulation.name);
    const SimulationOptions options{.until = 0.5,
                                    .relative_tolerance = 1e-11,
                                    .formulation = std::string(formulation.name),
                                    .samples = 51};
    const Result two = simulate(parallelogram(2), options);
    const Result three = simulate(parallelogram(3), options);
    INFO(three.summary.reason);
    REQUIRE(two.summary.ok());
    REQUIRE(three.summary.ok());
    CHECK(two.summary.redundant_equations.empty());
    CHECK(three.summary.redundant_equations.size() == 1);
    CHECK(three.summary.degrees_of_freedom == 1);
    const double difference =
        (two["crank 1.angle_rad"] - three["crank 1.angle_rad"]).cwiseAbs().maxCoeff();
    CHECK(difference < (is_multistep(formulation) ? 1e-7 : 1e-10));
    const auto& doubtful = three.summary.not_unique_reactions;
    CHECK(std::ranges::find(doubtful, "crank 1 foot.fx_N") != doubtful.end());
  }
}

TEST_CASE("what is nearly the same is chosen anew in time, at any tolerance: nothing is singular") {
  // The plate is tied to the wheel by a guide and a pin. As they turn, the guide's equation comes to
  // say what that of the pin says of x, and later of y. Found by the random mechanisms (20022).
  Model m = tests::plate_on_heavy_wheel();
  m.add(Gravity{.acceleration = {0.8, -0.95}});
  for (const double rtol : {1e-5, 1e-6, 1e-7, 1e-9}) {
    INFO(rtol);
    const Result run = simulate(m, {.until = 2.0, .relative_tolerance = rtol});
    REQUIRE(run.summary.ok());
    CHECK(run.summary.singular_positions.empty());
    CHECK(run["plate.angle_rad"].maxCoeff() - run["plate.angle_rad"].minCoeff() > 0.5);
    CHECK(run.summary.energy_balance < 10.0 * rtol * run.summary.energy_exchanged);
  }
}

TEST_CASE("motors that come to disagree end the run and are named") {
  Model m;
  const BodyId crank = add_rod(m, "crank", {0.0, 0.0}, {1.0, 0.0});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(0.0, 3.0)});
  m.add(AngleDriver{.name = "second", .body = crank, .angle = time_function([](auto t) {
                                                       return 3.0 * t + 0.1 * t * t * t * t;
                                                     })});
  for (const FormulationNote& formulation : formulations()) {
    INFO(formulation.name);
    const Result run = simulate(m, {.until = 1.0, .formulation = std::string(formulation.name)});
    CHECK(run.summary.stop == Stop::failed);
    CHECK(contains(run.summary.reason,
                   "'second: angle' was redundant at the start but is in conflict with "
                   "'motor: angle'"));
    CHECK(run.summary.t_end < 0.5);
  }
}

TEST_CASE("the N-four-bar passes its singular positions on the smooth branch") {
  for (const FormulationNote& formulation : formulations()) {
    for (const int loops : {1, 2}) {
      INFO(formulation.name, " ", loops);
      const bool multistep = is_multistep(formulation);
      const Result run = simulate(cases::n_four_bar({.loops = loops}),
                                  {.until = 3.0,
                                   .relative_tolerance = multistep ? 1e-12 : 1e-10,
                                   .formulation = std::string(formulation.name),
                                   .samples = 301});
      INFO(run.summary.reason);
      REQUIRE(run.summary.ok());
      CHECK(n_four_bar_error(run, loops) < 1e-7);
      CHECK(run["bar 1.angle_rad"].cwiseAbs().maxCoeff() < 1e-9);
      CHECK(run.summary.energy_balance < 1e-8 * run.summary.energy_exchanged);
      REQUIRE(run.summary.singular_positions.size() == 3);
      for (const SingularPosition& p : run.summary.singular_positions) {
        const double angle = cases::n_four_bar_angle(loops, p.t);
        CHECK(std::abs(std::sin(angle)) < 1e-5);
        CHECK(std::abs(p.energy_after - p.energy_before) < 1e-9 * run.summary.energy_exchanged);
      }
      CHECK(std::ranges::count(run.events, "singular_position", &EventRecord::kind) == 3);
    }
  }
}

TEST_CASE("no singular position is passed without notice, however long the steps") {
  for (const FormulationNote& formulation : formulations()) {
    for (const int loops : {1, 2, 3}) {
      for (const double rtol : {1e-2, 1e-3, 1e-4, 1e-5}) {
        INFO(formulation.name, " ", loops, " ", rtol);
        const Result run = simulate(cases::n_four_bar({.loops = loops}),
                                    {.until = 3.0,
                                     .relative_tolerance = rtol,
                                     .formulation = std::string(formulation.name),
                                     .samples = 301});
        REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
        CHECK(run["bar 1.angle_rad"].cwiseAbs().maxCoeff() < 1e-9);  // the branch
        const Eigen::VectorXd t = run["t_s"], angle = run["link 0.angle_rad"];
        const auto& found = run.summary.singular_positions;
        std::size_t passed = 0;
        for (Eigen::Index i = 1; i < t.size(); ++i) {
          if (std::floor(angle[i] / pi) == std::floor(angle[i - 1] / pi)) continue;
          REQUIRE(passed < found.size());
          CHECK(found[passed].t > t[i - 1]);
          CHECK(found[passed].t < t[i]);
          ++passed;
        }
        CHECK(passed >= 2);
        CHECK(passed == found.size());
        CHECK(std::ranges::count(run.events, "singular_position", &EventRecord::kind) ==
              static_cast<std::ptrdiff_t>(passed));
        for (const SingularPosition& p : found)
          CHECK(std::abs(p.energy_after - p.energy_before) < rtol * run.summary.energy_exchanged);
      }
    }
  }
}

TEST_CASE("singular positions that follow each other closely are told apart, at any tolerance") {
  for (const FormulationNote& formulation : formulations()) {
    for (const double behind : {0.01, 0.03}) {
      for (const double rtol : {1e-2, 1e-6}) {
        INFO(formulation.name, " ", behind, " ", rtol);
        const Result run =
            simulate(parallelograms_in_a_row(behind), {.until = 6.0,
                                                       .relative_tolerance = rtol,
                                                       .formulation = std::string(formulation.name),
                                                       .samples = 0});
        REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
        const auto& found = run.summary.singular_positions;
        REQUIRE(found.size() == 6);
        for (const std::size_t half_turn : {0UL, 3UL})
          for (std::size_t i = half_turn + 1; i < half_turn + 3; ++i)
            CHECK(found[i].t - found[i - 1].t == doctest::Approx(behind).epsilon(0.1));
        CHECK(std::abs(found[0].t - (pi - 1.1)) < 100.0 * rtol);
        CHECK(std::ranges::count(run.events, "singular_position", &EventRecord::kind) == 6);
        for (const Eigen::Index coupler : {2, 5, 8})  // the branch
          CHECK(std::abs(run.final.q[3 * coupler + 2]) < 1e-9);
      }
    }
  }
}

TEST_CASE("a run can start exactly at a singular position; the velocities choose the branch") {
  for (const FormulationNote& formulation : formulations()) {
    INFO(formulation.name);
    const SimulationOptions options{.until = 0.4,
                                    .relative_tolerance = 1e-10,
                                    .formulation = std::string(formulation.name),
                                    .samples = 41};
    // theta'^2 / 2 + k sin(theta) = const with theta = 0, theta' = -2 at the start.
    const Result run =
        simulate(cases::n_four_bar({.loops = 2, .angle = 0.0, .speed = 2.0}), options);
    INFO(run.summary.reason);
    REQUIRE(run.summary.ok());
    const double k = 1.5 * 9.81 * 7.0 / 9.0;
    const Eigen::VectorXd angle = run["link 0.angle_rad"], omega = run["link 0.omega_rad_per_s"];
    for (Eigen::Index i = 0; i < angle.size(); ++i)
      CHECK(std::abs(0.5 * omega[i] * omega[i] + k * std::sin(angle[i]) - 2.0) < 1e-7);
    CHECK(run["bar 2.angle_rad"].cwiseAbs().maxCoeff() < 1e-9);
  }
}

// Its carrier makes a thousand turns for one of its wheel, so equations come near to dependence, always.
TEST_CASE("a run that starts near dependence and stays there goes on with its formulation") {
  for (const double sense : {1.0, -1.0}) {
    Model m;
    const BodyId crank =
        m.add({.name = "crank", .mass = 1.0, .inertia = 0.01, .pose = {{0.1, 0.0}, 0.0}});
    const BodyId carrier =
        m.add({.name = "carrier", .mass = 0.1, .inertia = 0.001, .pose = {{0.3, 0.15}, 0.3}});
    const BodyId wheel =
        m.add({.name = "wheel", .mass = 0.1, .inertia = 0.001, .pose = {{0.1, 0.08}, 0.0}});
    m.add(Revolute{.name = "pin", .a = ground, .b = crank, .at = {0.0, 0.0}});
    m.add(Revolute{.name = "tip", .a = crank, .b = carrier, .at = {0.2, 0.0}});
    m.add(Revolute{.name = "hub", .a = crank, .b = wheel, .at = {0.1, 0.06}});
    m.add(Gear{.name = "gear", .a = ground, .b = wheel, .carrier = carrier, .ratio = 1.001});
    m.add(
        Distance{.name = "rod", .a = wheel, .b = crank, .at_a = {0.14, 0.08}, .at_b = {0.08, 0.0}});
    m.add(AngleDriver{.name = "motor", .body = crank, .angle = time_function([=](auto t) {
                                                        return 0.3 * sense * (1.0 - cos(t));
                                                      })});
    const Result r = simulate(m, {.until = 1.5,
                                  .relative_tolerance = 1e-9,
                                  .formulation = "arkode-projection",
                                  .samples = 11});
    INFO("sense ", sense, ", ", r.summary.steps, " steps");
    CHECK(r.summary.ok());
    CHECK(r["crank.angle_rad"][10] == doctest::Approx(0.3 * sense * (1.0 - std::cos(1.5))));
    CHECK(r.summary.position_drift / r.summary.length_scale < 1e-9);
  }
}

TEST_CASE("behind a singular position BDF takes steps of high order again") {
  // Once at order 1 it would stay there, with steps a thousand times too short.
  for (const double rtol : {1e-8, 1e-9, 1e-10}) {
    for (const char* formulation : {"ida-ggl", "ida-baumgarte", "cvode-projection"}) {
      INFO(formulation, " ", rtol);
      const Result run =
          simulate(cases::n_four_bar({.loops = 40}),
                   {.until = 1.2, .relative_tolerance = rtol, .formulation = formulation});
      REQUIRE(run.summary.ok());
      CHECK(run.summary.singular_positions.size() == 1);
      CHECK(run.summary.steps < 1500);
    }
  }
}

TEST_CASE("a slider-crank with equal crank and rod goes on as a slider-crank through the pivot") {
  for (const FormulationNote& formulation : formulations()) {
    for (const double start : {1.2, pi / 2.0}) {
      INFO(formulation.name, " ", start);
      const Model m = equal_slider_crank(start, 2.0);
      const Result run =
          simulate(m, {.until = 1.0,
                       .relative_tolerance = is_multistep(formulation) ? 1e-12 : 1e-10,
                       .formulation = std::string(formulation.name),
                       .samples = 101});
      INFO(run.summary.reason);
      REQUIRE(run.summary.ok());
      const Eigen::VectorXd crank = run["crank.angle_rad"], rod = run["rod.angle_rad"];
      CHECK((crank + rod).cwiseAbs().maxCoeff() < 1e-7);
      CHECK(crank[100] > start + 1.0);
      CHECK(run.summary.energy_balance < 1e-7);
    }
  }
}

TEST_CASE("a contact that begins while a singular position is being crossed is located there") {
  // The tip of the last link meets a floor a little above the pivots, 0.01 rad before all is in
  // line, and is thrown back: the singular position itself is not reached.
  const double height = std::sin(0.01);
  for (const FormulationNote& formulation : formulations()) {
    INFO(formulation.name);
    Model m = cases::n_four_bar();
    m.add(Wall{.name = "floor",
               .body = m.find_body("link 1"),
               .law = ContactLaw(PowerLaw{.K = 1e9, .n = 1.5}),
               .height = height,
               .point = {0.5, 0.0}});
    const bool multistep = is_multistep(formulation);
    const Result run = simulate(m, {.until = 0.9,
                                    .relative_tolerance = multistep ? 1e-12 : 1e-10,
                                    .formulation = std::string(formulation.name),
                                    .samples = 91});
    INFO(run.summary.reason);
    REQUIRE(run.summary.ok());
    REQUIRE(run.events.size() >= 2);
    const auto onset = std::ranges::find(run.events, "onset", &EventRecord::kind);
    REQUIRE(onset != run.events.end());
    CHECK(std::abs(cases::n_four_bar_angle(1, onset->t) - 0.01) <
          bar(formulation, 1e-8, 1e-7, 1e-4));
    const auto release = std::ranges::find(run.events, "release", &EventRecord::kind);
    REQUIRE(release != run.events.end());
    CHECK(std::abs(release->speed / onset->speed + 1.0) < bar(formulation, 1e-6, 1e-6, 1e-2));
    // Thrown back it goes where it came from.
    const double back = 2.0 * onset->t - 0.9 + (release->t - onset->t);
    CHECK(std::abs(run["link 0.angle_rad"](90) - cases::n_four_bar_angle(1, back)) <
          bar(formulation, 1e-5, 1e-5, 1e-2));
  }
}

TEST_CASE("a double rocker turns round at its dead positions, which are not singular") {
  // Rockers of 1 m, coupler 0.6 m, ground 1.8 m: no link can turn over. At its limits coupler and
  // one rocker are in line, and the other rocker stands still for an instant.
  for (const FormulationNote& formulation : formulations()) {
    INFO(formulation.name);
    const double lean = std::acos(0.6);
    const Vec2 left = rotate(lean, {1.0, 0.0}),
               right = Vec2(1.8, 0.0) + rotate(pi - lean, {1.0, 0.0});
    Model m;
    const BodyId a = add_rod(m, "left", {0.0, 0.0}, left, 3.0);
    const BodyId b = m.add(
        {.name = "coupler", .mass = 1.0, .inertia = 0.1, .pose = {0.5 * (left + right), 0.0}});
    const BodyId c = add_rod(m, "right", {1.8, 0.0}, right, 3.0);
    m.add(Revolute{.name = "left pivot", .a = ground, .b = a, .at = {0.0, 0.0}});
    m.add(Revolute{.name = "left tip", .a = a, .b = b, .at = left});
    m.add(Revolute{.name = "right tip", .a = b, .b = c, .at = right});
    m.add(Revolute{.name = "right pivot", .a = ground, .b = c, .at = {1.8, 0.0}});
    const Result run = simulate(m, {.until = 4.0,
                                    .relative_tolerance = 1e-8,
                                    .formulation = std::string(formulation.name),
                                    .samples = 401});
    INFO(run.summary.reason);
    REQUIRE(run.summary.ok());
    CHECK(run.summary.singular_positions.empty());
    const Eigen::VectorXd omega = run["left.omega_rad_per_s"], angle = run["left.angle_rad"];
    CHECK(omega.minCoeff() < -1.0);
    CHECK(omega.maxCoeff() > 1.0);
    // With coupler and right rocker in line the left tip is 1.6 m from the right pivot.
    const double limit = std::acos((1.0 + 1.8 * 1.8 - 1.6 * 1.6) / (2.0 * 1.8));
    CHECK(angle.maxCoeff() < limit + 1e-6);
    CHECK(angle.maxCoeff() > limit - 0.01);
    CHECK(angle.minCoeff() > -limit - 1e-6);
    CHECK(run.summary.energy_balance < 1e-6 * run["kinetic_J"](0));
  }
}

TEST_CASE("a slider driven beyond its reach ends the run where it can go no further") {
  Model m;
  const BodyId crank = add_rod(m, "crank", {0.0, 0.0}, rotate(0.8, {1.0, 0.0}));
  const Vec2 tip = rotate(0.8, {1.0, 0.0}), end(tip.x() + std::sqrt(4.0 - tip.y() * tip.y()), 0.0);
  const BodyId rod = add_rod(m, "rod", tip, end);
  const BodyId slider = m.add({.name = "slider", .mass = 1.0, .inertia = 0.1, .pose = {end, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "pin", .a = crank, .b = rod, .at = tip});
  m.add(Revolute{.name = "wrist", .a = rod, .b = slider, .at = end});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  m.add(DisplacementDriver{.name = "pull",
                           .body = slider,
                           .at = end,
                           .along = {1.0, 0.0},
                           .displacement = constant_speed(0.0, 1.0)});
  const double reach = 3.0 - end.x();  // [s] at 1 m/s
  for (const FormulationNote& formulation : formulations()) {
    INFO(formulation.name);
    const Result run =
        simulate(m, {.until = 2.0 * reach, .formulation = std::string(formulation.name)});
    INFO(run.summary.reason);
    CHECK(run.summary.stop == Stop::failed);
    CHECK(run.summary.t_end < 1.001 * reach);
    CHECK(run.summary.t_end > 0.9 * reach);
    CHECK(run.final.q.allFinite());
  }
}
