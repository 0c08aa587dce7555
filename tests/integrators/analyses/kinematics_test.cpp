// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Kinematic analysis against closed forms, through and into singular positions.
#include <doctest/doctest.h>

#include <yoke/integrators/analyses/kinematics.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/tests/integrators/analyses/analysed.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

}  // namespace

TEST_CASE("a driven slider-crank moves as its closed form says, with velocity and acceleration") {
  const double r = 0.05, l = 0.12, omega = 5000.0_rpm;
  // Few rows for many revolutions: the analysis chooses its own steps in between.
  for (const int samples : {26, 401}) {
    const Result run =
        kinematics(slider_crank({.omega = omega}), {.until = 0.1, .samples = samples});
    REQUIRE(run.summary.ok());
    CHECK(run.summary.degrees_of_freedom == 0);
    CHECK(run.samples.rows() == static_cast<std::size_t>(samples));
    CHECK(run.summary.singular_positions.empty());
    const Eigen::VectorXd t = run["t_s"], x = run["slider.x_m"], v = run["slider.vx_m_per_s"],
                          a = run["slider.ax_m_per_s2"];
    double dx = 0.0, dv = 0.0, da = 0.0;
    for (Eigen::Index i = 0; i < t.size(); ++i) {
      const double phi = omega * t[i], s = std::sin(phi), c = std::cos(phi);
      const double root = std::sqrt(l * l - r * r * s * s);
      const double root_1 = -r * r * s * c / root;  // derivatives by phi
      const double root_2 = -r * r * (c * c - s * s) / root - root_1 * root_1 / root;
      dx = std::max(dx, std::abs(x[i] - (r * c + root)));
      dv = std::max(dv, std::abs(v[i] - omega * (-r * s + root_1)));
      da = std::max(da, std::abs(a[i] - omega * omega * (-r * c + root_2)));
    }
    CHECK(dx < 1e-14);
    CHECK(dv < 1e-12 * omega * r);
    CHECK(da < 1e-11 * omega * omega * r);
  }
}

TEST_CASE("a crank that its links cannot follow round stops at the dead point, by time and name") {
  // a + d > b + c: the crank reaches as far as coupler and rocker in line, |B - D| = b + c.
  const double a = 0.6, b = 0.5, c = 0.7, d = 1.0, start = 1.0, omega = 2.0;
  const double limit = std::acos((a * a + d * d - (b + c) * (b + c)) / (2.0 * a * d));
  const double t_dead = (limit - start) / omega;
  const Result run = kinematics(four_bar(a, b, c, d, start, omega), {.until = 2.0, .samples = 201});
  CHECK(run.summary.stop == Stop::failed);
  CHECK(std::abs(run.summary.t_end - t_dead) < 1e-9);
  CHECK_MESSAGE(contains(run.summary.reason, "dead point at t = "), run.summary.reason);
  CHECK_MESSAGE(contains(run.summary.reason, "'motor: angle' is nearly dependent"),
                run.summary.reason);
  REQUIRE(!run.summary.singular_positions.empty());
  CHECK(std::abs(run.summary.singular_positions.back().t - t_dead) < 1e-9);
  // What was reached is kept: all rows up to there, and one at the end.
  CHECK(run.samples.rows() == static_cast<std::size_t>(t_dead / 0.01) + 2);
}

TEST_CASE("a position that is nearly singular is located in time, and is passed") {
  // Nearly a parallelogram: coupler and rocker come close to being in line twice a turn.
  const double a = 0.3, b = 1.0, c = 0.30001, d = 1.0;
  const double omega = 2.0 * pi;
  const Model model = four_bar(a, b, c, d, 1.0, omega);
  const Result run = kinematics(model, {.until = 1.0, .samples = 101});
  REQUIRE(run.summary.ok());
  REQUIRE(run.summary.singular_positions.size() == 2);
  // Nearest to in line: where the crank lies along the ground.
  CHECK(std::abs(run.summary.singular_positions[0].t - (pi - 1.0) / omega) < 2e-3);
  CHECK(std::abs(run.summary.singular_positions[1].t - (2.0 * pi - 1.0) / omega) < 2e-3);
  for (const SingularPosition& p : run.summary.singular_positions) {
    CHECK(p.independence < 1e-4);
    CHECK(p.independence > 0.0);
    CHECK(!p.equation.empty());
  }
  // On the same branch after a turn.
  const Eigen::VectorXd rocker = run["rocker.angle_rad"];
  CHECK(std::abs(std::remainder(rocker[100] - rocker[0], 2.0 * pi)) < 1e-10);
  // And in between: the joint C stays on its side of the line from B to D.
  const Eigen::VectorXd crank = run["crank.angle_rad"];
  for (Eigen::Index i = 0; i < rocker.size(); ++i) {
    const Vec2 B = rotate(crank[i], {a, 0.0}), D(d, 0.0), C = D + rotate(rocker[i], {c, 0.0});
    CHECK(cross(D - B, C - B) > 0.0);
  }
  const Result calm = kinematics(model, {.until = 1.0, .samples = 101, .warn_below = 1e-12});
  CHECK(calm.summary.singular_positions.empty());
}

TEST_CASE("an over-closed driven mechanism is analysed without its redundant equations") {
  Model m = four_bar(0.3, 1.0, 0.3, 1.0, 1.1, 4.0);
  const Vec2 up = rotate(1.1, {0.3, 0.0});
  const auto third = add_link(m, "third", {0.5, 0.0}, Vec2(0.5, 0.0) + up);
  m.add(Revolute{.name = "E", .a = ground, .b = third, .at = {0.5, 0.0}});
  m.add(Revolute{.name = "F", .a = m.find_body("coupler"), .b = third, .at = Vec2(0.5, 0.0) + up});
  const Result run = kinematics(m, {.until = 0.4, .samples = 41});
  REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
  CHECK(run.summary.redundant_equations.size() == 1);
  CHECK(std::abs(run["third.angle_rad"][40] - (1.1 + 4.0 * 0.4)) < 1e-12);
}

TEST_CASE("a mechanism that is not fully driven is refused, with what is left free") {
  const std::string free_crank =
      message_of([] { kinematics(slider_crank({.driven = false}), {.until = 1.0}); });
  CHECK_MESSAGE(contains(free_crank, "kinematics: 1 degree of freedom is left, of 'crank', 'rod'"),
                free_crank);
  const std::string free_slider = message_of([] { kinematics(scotch_yoke(), {.until = 1.0}); });
  CHECK_MESSAGE(contains(free_slider, "1 degree of freedom is left, of 'slider': drive it"),
                free_slider);
  const std::string two = message_of([] { kinematics(double_pendulum(), {.until = 1.0}); });
  CHECK_MESSAGE(contains(two, "2 degrees of freedom are left, of 'a', 'b': drive them"), two);
  CHECK(contains(message_of([] { kinematics(slider_crank({.omega = 1.0}), {.until = -1.0}); }),
                 "until = -1 s must be later"));
  CHECK(contains(
      message_of([] { kinematics(slider_crank({.omega = 1.0}), {.until = 1.0, .samples = 1}); }),
      "samples = 1 must be at least 2"));
}

TEST_CASE("a driver that jumps is told from a dead point") {
  Model m;
  const auto rotor = m.add(Body{.name = "rotor", .mass = 1.0, .inertia = 1.0});
  m.add(Revolute{.name = "pivot", .a = ground, .b = rotor, .at = {0.0, 0.0}});
  m.add(AngleDriver{.name = "motor", .body = rotor, .angle = TimeFunction([](double t) {
                                                      return TimeValue{.value =
                                                                           t < 0.55 ? 0.0 : 0.3};
                                                    })});
  const Result run = kinematics(m, {.until = 1.0, .samples = 11});
  CHECK(run.summary.stop == Stop::failed);
  CHECK_MESSAGE(contains(run.summary.reason, "does a driver jump?"), run.summary.reason);
  CHECK(run.summary.t_end == doctest::Approx(0.55));
}
