// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Whole mechanisms against solutions computed independently in quadruple precision (implicit
// Runge-Kutta on the same problem data).
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <yoke/tests/integrators/mechanisms.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

double last(const Result& run, const std::string& column) {
  return run[column](static_cast<Eigen::Index>(run.samples.rows()) - 1);
}

void check_near(const Result& run, const std::string& column, double expected, double tolerance) {
  INFO(column);
  CHECK(std::abs(last(run, column) - expected) <= tolerance);
}

/// Crank, rod and slider; slider on y = 0.
struct SliderCrank {
  double l1, l2, m1, m2, m3, J1, J2, J3;
  Model build(double omega1, double omega2) const {
    Model m;
    const auto crank = m.add(Body{.name = "crank",
                                  .mass = m1,
                                  .inertia = J1,
                                  .pose = {{l1 / 2, 0.0}, 0.0},
                                  .twist = {{0.0, omega1 * l1 / 2}, omega1}});
    const auto rod = m.add(Body{.name = "rod",
                                .mass = m2,
                                .inertia = J2,
                                .pose = {{l1 + l2 / 2, 0.0}, 0.0},
                                .twist = {{0.0, omega1 * l1 + omega2 * l2 / 2}, omega2}});
    const auto slider =
        m.add(Body{.name = "slider", .mass = m3, .inertia = J3, .pose = {{l1 + l2, 0.0}, 0.0}});
    m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
    m.add(Revolute{.name = "crank pin", .a = crank, .b = rod, .at = {l1, 0.0}});
    m.add(Revolute{.name = "slider pin", .a = rod, .b = slider, .at = {l1 + l2, 0.0}});
    m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
    return m;
  }
};

}  // namespace

TEST_CASE("double pendulum meets the reference to 1e-9 with accelerations and reactions") {
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "arkode-baumgarte",
                                        "cvode-projection", "ida-baumgarte", "adams-baumgarte"}) {
    INFO(formulation);
    const double rtol = formulation.starts_with("arkode") ? 1e-12 : 1e-13;
    const Result run = simulate(
        double_pendulum(),
        {.until = 1.0, .relative_tolerance = rtol, .formulation = formulation, .samples = 2});
    REQUIRE(run.summary.ok());
    check_near(run, "a.x_m", -0.46740367507217344024, 1e-9);
    check_near(run, "a.y_m", -0.17757760142829419516, 1e-9);
    check_near(run, "b.angle_rad", -2.3851873498861929707, 1e-9);
    check_near(run, "b.omega_rad_per_s", -0.51604547210520891676, 1e-9);
    check_near(run, "b.alpha_rad_per_s2", -19.832564877784164608, 1e-7);
    // The reference's multipliers are those of (r_pivot, r_elbow): force on a, force on b.
    check_near(run, "pivot.fx_N", 18.738922100811291817, 1e-7);
    check_near(run, "pivot.fy_N", 8.9534291850644135276, 1e-7);
    check_near(run, "elbow.fx_N", 10.256342758201912552, 1e-7);
    check_near(run, "elbow.fy_N", 5.1334770551788645278, 1e-7);
  }
}

TEST_CASE("free slider-crank meets the reference with all reactions") {
  const SliderCrank mechanism{.l1 = 0.153,
                              .l2 = 0.306,
                              .m1 = 0.038,
                              .m2 = 0.038,
                              .m3 = 0.076,
                              .J1 = 7.4e-5,
                              .J2 = 5.9e-4,
                              .J3 = 2.7e-6};
  for (const std::string formulation :
       {"arkode-projection", "ida-ggl", "cvode-projection", "ida-baumgarte", "adams-baumgarte"}) {
    INFO(formulation);
    Model model = mechanism.build(150.0, -75.0);
    model.add(Gravity{.name = "gravity", .acceleration = {0.0, -9.81}});
    const Result run = simulate(
        model,
        {.until = 0.1, .relative_tolerance = 1e-12, .formulation = formulation, .samples = 2});
    REQUIRE(run.summary.ok());
    check_near(run, "crank.angle_rad", 9.1401524169416283117, 1e-8);
    check_near(run, "slider.x_m", 0.15612473949874373346, 1e-9);
    check_near(run, "slider.vx_m_per_s", -3.197019131717897268758733, 1e-7);
    check_near(run, "pivot.fx_N", 255.16113683614872734, 1e-5);
    check_near(run, "pivot.fy_N", -79.968689288375950131, 1e-5);
    check_near(run, "slider pin.fx_N", 118.15117615641746167, 1e-5);
    check_near(run, "guide.fy_N", 17.028404559426618402, 1e-5);
  }
}

TEST_CASE(
    "slider-crank driven at 5000 rpm gives reactions and drive torque to 1e-9 of their size") {
  const SliderCrank mechanism{.l1 = 0.05,
                              .l2 = 0.12,
                              .m1 = 0.30,
                              .m2 = 0.21,
                              .m3 = 0.14,
                              .J1 = 1e-5,
                              .J2 = 2.5e-5,
                              .J3 = 1e-4};
  const double omega = 5000.0_rpm;
  for (const std::string formulation :
       {"arkode-projection", "ida-ggl", "cvode-projection", "ida-baumgarte", "adams-baumgarte"}) {
    INFO(formulation);
    Model model = mechanism.build(omega, -omega * 0.05 / 0.12);
    model.add(AngleDriver{
        .name = "motor", .body = model.find_body("crank"), .angle = constant_speed(0.0, omega)});
    const Result run = simulate(
        model,
        {.until = 1.05e-2, .relative_tolerance = 1e-12, .formulation = formulation, .samples = 2});
    REQUIRE(run.summary.ok());
    const double peak = 8253.0;
    check_near(run, "pivot.fx_N", -4916.03114602221884174321, 1e-9 * peak);
    check_near(run, "pivot.fy_N", 1230.4541004300975974284933, 1e-9 * peak);
    check_near(run, "crank pin.fx_N", -3462.1011044307856054603848, 1e-9 * peak);
    check_near(run, "slider pin.fy_N", -1241.2269702753389042523096, 1e-9 * peak);
    check_near(run, "guide.fy_N", 1241.2269702753389042523096, 1e-9 * peak);
    check_near(run, "guide.moment_N_m", 0.0, 1e-9 * peak);
    check_near(run, "motor.moment_N_m", -130.3048260761835182936441, 1e-9 * peak * 0.05);
  }
}

TEST_CASE("errors fall with the tolerance") {
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "arkode-baumgarte",
                                        "cvode-projection", "ida-baumgarte", "adams-baumgarte"}) {
    INFO(formulation);
    double previous = 1.0;
    for (const double rtol : {1e-5, 1e-7, 1e-9, 1e-11}) {
      const Result run = simulate(
          double_pendulum(),
          {.until = 1.0, .relative_tolerance = rtol, .formulation = formulation, .samples = 2});
      // The largest of several: one alone may be right by chance.
      const double error =
          std::max({std::abs(last(run, "a.x_m") + 0.46740367507217344024),
                    std::abs(last(run, "b.angle_rad") + 2.3851873498861929707),
                    std::abs(last(run, "b.omega_rad_per_s") + 0.51604547210520892)});
      CHECK(error < 0.3 * previous);
      CHECK(error < 1e4 * rtol);
      previous = error;
    }
  }
}
