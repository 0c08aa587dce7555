// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Drive torques and reactions against quadruple precision, closed forms and simulate().
#include <doctest/doctest.h>

#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/integrators/analyses/inverse_dynamics.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/tests/integrators/analyses/analysed.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/relaxing_spring.hpp>
#include <yoke/tests/integrators/wall.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// Multipliers of the reference solution (quadruple precision): on crank at the pivot (2), crank
/// pin (2), slider pin (2), guide, guide moment, drive.
struct Reference {
  int row;
  double value[9];
};
constexpr Reference reference[] = {
    {0, {8253.228217346136, 0.0, -6197.060633785853, 0.0, -2718.7104715963742, 0.0, 0.0, 0.0, 0.0}},
    {1,
     {7854.7734278714934, 266.55189979252108, -5868.6680557322302, 265.62343075530894,
      -2559.0824544198548, 638.14616213878996, 638.14616213878996, 0.0, -88.774779702117091}},
    {3,
     {4916.0311460222188, 1230.4541004300976, -3462.1011044307856, 223.47594116133564,
      -1396.7714716095899, 1241.2269702753389, 1241.2269702753389, 0.0, -130.30482607618352}},
    {8,
     {-4121.0051278793734, 3287.1475424855966, 3092.9213360992318, -1506.4541806843289,
      1356.1501039160759, -259.96882742344159, -259.96882742344159, 0.0, 96.266067931333914}},
    {21,
     {4916.0311460222188, -1230.4541004300976, -3462.1011044307856, -223.47594116133564,
      -1396.7714716095899, -1241.2269702753389, -1241.2269702753389, 0.0, 130.30482607618352}}};

}  // namespace

TEST_CASE("inverse dynamics of the slider-crank at 5000 rpm meets the reference to 1e-11 of peak") {
  const double omega = 5000.0_rpm, peak = 8253.0;
  const Result run =
      inverse_dynamics(slider_crank({.omega = omega}), {.until = 0.012, .samples = 25});
  REQUIRE(run.summary.ok());
  for (const Reference& r : reference) {
    INFO("row " << r.row);
    const auto near = [&](const char* column, double expected, double size) {
      INFO(column);
      CHECK(std::abs(run[column][r.row] - expected) < 1e-11 * size);
    };
    near("pivot.fx_N", -r.value[0], peak);
    near("pivot.fy_N", -r.value[1], peak);
    near("crank pin.fx_N", r.value[2], peak);
    near("crank pin.fy_N", r.value[3], peak);
    near("slider pin.fx_N", r.value[4], peak);
    near("slider pin.fy_N", r.value[5], peak);
    near("guide.fy_N", -r.value[6], peak);
    near("guide.moment_N_m", 0.0, 0.05 * peak);
    near("motor.moment_N_m", -r.value[8], 0.05 * peak);
    near("motor.power_W", -r.value[8] * omega, 0.05 * peak * omega);
  }
  // Work of the drive and kinetic energy are found on different ways.
  CHECK(run.summary.energy_balance < 1e-9 * run.summary.energy_exchanged);
  CHECK(run.summary.energy_exchanged > 10.0);
}

TEST_CASE("springs, dampers and loads have their part in the drive's torque, power and work") {
  Model m = slider_crank({.angle = 0.7, .omega = 40.0});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = m.find_body("slider"),
                            .at_a = {0.3, 0.0},
                            .at_b = m.body(m.find_body("slider")).pose.position,
                            .stiffness = 900.0,
                            .damping = 12.0});
  m.add(AppliedForce{
      .name = "load", .body = m.find_body("rod"), .at = {0.06, 0.02}, .force = [](double t) {
        return Vec2(3.0, -20.0 * std::cos(30.0 * t));
      }});
  m.add(Gravity{});
  const Result exact = inverse_dynamics(m, {.until = 0.3, .samples = 301});
  REQUIRE(exact.summary.ok());
  const Result run = simulate(m, {.until = 0.3, .relative_tolerance = 1e-12, .samples = 301});
  for (const std::string& column : run.samples.names()) {
    if (column == "balance_J") continue;
    INFO(column);
    const double peak = std::max(run[column].cwiseAbs().maxCoeff(), 1e-3);
    CHECK((exact[column] - run[column]).cwiseAbs().maxCoeff() < 1e-8 * peak);
  }
  CHECK(exact.summary.energy_balance < 1e-10);
  CHECK(exact["spring.dissipated_power_W"].minCoeff() >= 0.0);
  CHECK(exact["spring.dissipated_power_W"].maxCoeff() > 1.0);
  // Power is the derivative of work: by a difference of order 4.
  const Eigen::VectorXd work = exact["motor.work_J"], power = exact["motor.power_W"];
  for (const Eigen::Index i : {50, 150, 250}) {
    const double h = 1e-3;
    const double slope =
        (8.0 * (work[i + 1] - work[i - 1]) - (work[i + 2] - work[i - 2])) / (12 * h);
    CHECK(power[i] == doctest::Approx(slope).epsilon(1e-4));
  }
}

TEST_CASE("forces with a memory are integrated along the driven motion") {
  Model m = slider_crank({.angle = 0.5, .omega = 20.0});
  m.add(RelaxingSpring{.name = "maxwell", .body = m.find_body("slider")});
  const Result run = inverse_dynamics(m, {.until = 0.2, .samples = 21});
  REQUIRE(run.summary.ok());
  CHECK(contains(run.summary.formulation_reason, "memory"));
  CHECK(std::abs(run["maxwell.extension_m"][20]) > 1e-4);
  Model pressed = slider_crank({.angle = 0.5, .omega = 20.0});
  const auto crank = pressed.find_body("crank");
  pressed.add(Wall{.name = "stop",
                   .body = crank,
                   .law = {per_mm(1e4, 1.5), HuntCrossley{0.1}},
                   .height = -0.0245});
  const Result contact = inverse_dynamics(pressed, {.until = 0.35, .samples = 201});
  REQUIRE(contact.summary.ok());
  CHECK(contact.events.size() == 2);
  CHECK(contact["stop.normal_force_N"].maxCoeff() > 10.0);
}

TEST_CASE("the drive found for a free motion is zero, for a driven one it is the driver") {
  // A double pendulum that swings by itself needs no drives.
  const Model free = double_pendulum();
  const Result swing = simulate(free, {.until = 1.0, .relative_tolerance = 1e-11, .samples = 51});
  const std::vector<Drive> both = {{.body = "a"}, {.body = "b", .against = "a"}};
  const Result none = inverse_dynamics(free, swing.samples, both);
  CHECK(none["a.angle.drive_N_m"].cwiseAbs().maxCoeff() < 1e-9);
  CHECK(none["b.angle.drive_N_m"].cwiseAbs().maxCoeff() < 1e-9);
  CHECK((none["pivot.fy_N"] - swing["pivot.fy_N"]).cwiseAbs().maxCoeff() < 1e-8);

  // The same slider-crank with and without its motor.
  const SliderCrankOptions o{.angle = 0.4, .omega = 60.0};
  const Result driven = inverse_dynamics(slider_crank(o), {.until = 0.1, .samples = 101});
  SliderCrankOptions without = o;
  without.driven = false;
  const Model bare = slider_crank(without);
  // The table of the driven one has other columns: the motion goes in as a function.
  const Table& table = driven.samples;
  const auto motion = [&](double t) {
    State state = bare.start_state();
    const auto row = static_cast<std::size_t>(std::lround(t / 1e-3));
    std::size_t column = 1;
    for (Eigen::Index i = 0; i < 9; i += 3)
      for (Eigen::VectorXd* values : {&state.q, &state.v, &state.a})
        for (Eigen::Index j = 0; j < 3; ++j) (*values)[i + j] = table.value(row, column++);
    return state;
  };
  const Result torque =
      inverse_dynamics(bare, motion, {{.body = "crank"}}, {.until = 0.1, .samples = 101});
  const Eigen::VectorXd expected = driven["motor.moment_N_m"];
  CHECK((torque["crank.angle.drive_N_m"] - expected).cwiseAbs().maxCoeff() <
        1e-10 * expected.cwiseAbs().maxCoeff());
  CHECK((torque["pivot.fx_N"] - driven["pivot.fx_N"]).cwiseAbs().maxCoeff() < 1e-9);
  CHECK((torque["crank.angle.drive_power_W"] - driven["motor.power_W"]).cwiseAbs().maxCoeff() <
        1e-8);
  // A force at the slider does the same work.
  const Result push =
      inverse_dynamics(bare, motion, {{.body = "slider", .coordinate = Coordinate::x}},
                       {.until = 0.1, .samples = 101});
  CHECK((push["slider.x.drive_power_W"] - driven["motor.power_W"]).cwiseAbs().maxCoeff() <
        1e-7 * driven["motor.power_W"].cwiseAbs().maxCoeff());
}

TEST_CASE("drives that do not fit are refused") {
  const Model m = double_pendulum();
  const Result swing = simulate(m, {.until = 0.1, .samples = 3});
  CHECK(contains(message_of([&] { inverse_dynamics(m, swing.samples, {{.body = "a"}}); }),
                 "1 drives are given for 2 degrees of freedom"));
  CHECK(contains(message_of([&] {
                   inverse_dynamics(m, swing.samples, {{.body = "a"}, {.body = "a"}});
                 }),
                 "the drives cannot act on all degrees of freedom"));
  CHECK(contains(message_of([&] { inverse_dynamics(slider_crank({}), swing.samples, {}); }),
                 "these are not samples of this model"));
  CHECK(contains(message_of([&] {
                   inverse_dynamics(m,
                                    [&](double) {
                                      State s = m.start_state();
                                      s.q[0] += 0.01;
                                      return s;
                                    },
                                    {{.body = "a"}, {.body = "b"}}, {.until = 1.0, .samples = 2});
                 }),
                 "the motion given violates 'pivot: x' by 0.01 m"));
  CHECK(contains(message_of([&] { inverse_dynamics(m, {.until = 1.0}); }),
                 "inverse dynamics: 2 degrees of freedom are left"));
}

TEST_CASE(
    "work and power are right across a singular position, on a sample or not, and it is told") {
  // All links in line at t = 1 s. The coupler does not turn and no speed changes: the drive lifts
  // three links of 1 kg, P = 2 r m g omega cos(angle). Samples 11 and 101 have a row at t = 1 s.
  const double r = 0.3, start = pi - 1.0;
  for (const int samples : {11, 12, 101, 102}) {
    for (const double stiffness : {0.0, 5.0}) {
      INFO(samples, " samples, spring ", stiffness);
      Model m = four_bar(r, 1.0, r, 1.0, start, 1.0);
      m.add(Gravity{});
      if (stiffness > 0.0)
        m.add(TorsionalSpring{.name = "spring",
                              .a = ground,
                              .b = m.find_body("rocker"),
                              .stiffness = stiffness,
                              .free_angle = 0.2});
      const Result run = inverse_dynamics(m, {.until = 2.0, .samples = samples});
      REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
      REQUIRE(run.samples.rows() == static_cast<std::size_t>(samples));
      CHECK(run.summary.energy_balance < 1e-6 * run.summary.energy_exchanged);
      REQUIRE(run.summary.singular_positions.size() == 1);
      CHECK(std::abs(run.summary.singular_positions[0].t - 1.0) < 1e-8);
      CHECK(!run.summary.singular_positions[0].equation.empty());
      CHECK(run.summary.singular_positions[0].independence < 1e-12);
      const Eigen::VectorXd t = run["t_s"], power = run["motor.power_W"],
                            work = run["motor.work_J"], rocker = run["rocker.angle_rad"];
      for (Eigen::Index i = 0; i < t.size(); ++i) {
        const double angle = start + t[i];
        INFO("t = ", t[i]);
        const double turned = std::remainder(rocker[i] - angle, 2.0 * pi);
        CHECK(std::abs(turned) < 1e-8);
        const double lift = 2.0 * r * 9.81, twist = rocker[i] - 0.2, twist_0 = rocker[0] - 0.2;
        CHECK(std::abs(power[i] - (lift * std::cos(angle) + stiffness * twist)) < 1e-5);
        CHECK(std::abs(work[i] - lift * (std::sin(angle) - std::sin(start)) -
                       0.5 * stiffness * (twist * twist - twist_0 * twist_0)) < 1e-7);
      }
    }
  }
  // Where nothing is singular nothing is told.
  const Result calm =
      inverse_dynamics(slider_crank({.angle = 0.7, .omega = 40.0}), {.until = 0.3, .samples = 31});
  CHECK(calm.summary.singular_positions.empty());
}

TEST_CASE("a slider-crank with equal links is taken through its fold, where velocities are lost") {
  for (const int samples : {11, 12, 101}) {
    INFO(samples);
    const Model m = slider_crank({.crank = 0.1, .rod = 0.1, .angle = pi / 2 - 1.0, .omega = 1.0});
    const Result run = inverse_dynamics(m, {.until = 2.0, .samples = samples});
    REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
    CHECK(run.summary.energy_balance < 1e-6 * run.summary.energy_exchanged);
    CHECK(run.summary.singular_positions.size() == 1);
    CHECK(run["motor.power_W"].cwiseAbs().maxCoeff() < 0.01);
    // On the branch it came on: the slider goes through the pivot.
    const Eigen::VectorXd t = run["t_s"], x = run["slider.x_m"];
    for (Eigen::Index i = 0; i < t.size(); ++i)
      CHECK(std::abs(x[i] - 0.2 * std::cos(pi / 2 - 1.0 + t[i])) < 1e-9);
  }
}
