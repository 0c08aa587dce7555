// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A joint and its twin with clearance; points held on curves.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <yoke/contact/clearance.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/core/curves/absorber_paths.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/curves/smooth_curves.hpp>
#include <yoke/core/units.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/point_on_curve.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::tests;
using namespace yoke::literals;
using doctest::Approx;

namespace {

const ContactLaw law{per_mm(49070, 1.10), HuntCrossley{1.0}};

/// A crank at constant speed drives a slider; rod pin, guide or neither with clearance.
Model slider_crank(std::optional<Clearance> pin, std::optional<Clearance> guide) {
  const double r = 0.05, l = 0.12, omega = 20.0;
  Model m;
  const BodyId crank = m.add({.name = "crank",
                              .mass = 0.3,
                              .inertia = 1e-4,
                              .pose = {{0.5 * r, 0.0}, 0.0},
                              .twist = {{0.0, 0.5 * r * omega}, omega}});
  const double rate = -omega * r / l;
  const BodyId rod = m.add({.name = "rod",
                            .mass = 0.21,
                            .inertia = 2.5e-4,
                            .pose = {{r + 0.5 * l, 0.0}, 0.0},
                            .twist = {{0.0, r * omega + 0.5 * l * rate}, rate}});
  const BodyId slider =
      m.add({.name = "slider", .mass = 0.14, .inertia = 1e-4, .pose = {{r + l, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "crank pin", .a = crank, .b = rod, .at = {r, 0.0}});
  m.add(
      Revolute{.name = "slider pin", .a = rod, .b = slider, .at = {r + l, 0.0}, .clearance = pin});
  m.add(Prismatic{
      .name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}, .clearance = guide});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(0.0, omega)});
  return m;
}

}  // namespace

TEST_CASE("one word gives a joint clearance; the motion is the ideal one to within it") {
  const BearingClearance bearing{.journal_radius = 10.0_mm, .radial = 0.1_mm, .law = law};
  const GuideClearance guide{
      .length = 50.0_mm, .width = 20.0_mm, .gap = 0.1_mm, .law = law, .corner_radius = 1.0_mm};
  const SimulationOptions options{.until = 0.4, .relative_tolerance = 1e-8, .samples = 201};
  const Result ideal = simulate(slider_crank({}, {}), options);
  REQUIRE(ideal.summary.ok());
  CHECK(ideal.events.empty());
  for (const int which : {1, 2, 3}) {
    const Model m = which == 1   ? slider_crank(bearing, {})
                    : which == 2 ? slider_crank({}, guide)
                                 : slider_crank(bearing, guide);
    const Result run = simulate(m, options);
    INFO(which << ": " << run.summary.reason);
    REQUIRE(run.summary.ok());
    CHECK(run.events.size() > 5);
    CHECK((run["slider.x_m"] - ideal["slider.x_m"]).cwiseAbs().maxCoeff() < 0.3_mm);
    CHECK((run["slider.y_m"]).cwiseAbs().maxCoeff() < 0.25_mm);
    CHECK(run.summary.energy_balance < 1e-5 * run.summary.energy_exchanged);
    CHECK(run.summary.degrees_of_freedom == (which == 1 ? 2 : which == 2 ? 2 : 4));
    if (which != 1) CHECK(run.samples.has("guide front left.normal_force_N"));
    if (which != 2) CHECK(run.samples.has("slider pin.penetration_m"));
  }
}

TEST_CASE("a bead on a cycloid swings at one period, whatever its amplitude") {
  const double a = 0.2;  // [m] of the rolling circle; T = 4 pi sqrt(a/g)
  const double period = 4.0 * pi * std::sqrt(a / 9.81);
  const Curve cycloid = curve_of(
      [a](double u) { return Vec2(a * (u + std::sin(u)), a * (1.0 - std::cos(u))); }, -2.8, 2.8);
  for (const double u : {0.3, 1.2, 2.4}) {
    Model m;
    const Vec2 start(a * (u + std::sin(u)), a * (1.0 - std::cos(u)));
    const BodyId bead = m.add({.name = "bead", .mass = 0.1, .inertia = 1e-5, .pose = {start, 0.0}});
    m.add(PointOnCurve{.name = "wire", .a = bead, .at = start, .b = ground, .curve = cycloid});
    m.add(Gravity{});
    for (const std::string formulation : {"arkode-projection", "ida-ggl", "cvode-projection"}) {
      const Result run = simulate(m, {.until = 5.0 * period,
                                      .relative_tolerance = 1e-11,
                                      .formulation = formulation,
                                      .samples = 2});
      INFO(u << " " << formulation << " " << run.summary.reason);
      REQUIRE(run.summary.ok());
      // At the end of whole periods it is where it began, at rest.
      CHECK(std::abs(run["bead.x_m"](1) - start.x()) < 1e-8);
      CHECK(std::abs(run["bead.vx_m_per_s"](1)) < 1e-7);
    }
  }
}

TEST_CASE(
    "a point on a curve with clearance follows the ideal one; a flat end is a second contact") {
  const Curve wave =
      curve_of([](double u) { return Vec2(u, 0.02 * std::sin(20.0 * u)); }, -0.3, 0.3);
  const auto model = [&](std::optional<Clearance> clearance) {
    Model m;
    const BodyId bead =
        m.add({.name = "bead", .mass = 0.1, .inertia = 1e-5, .pose = {wave.at(0.1).point, 0.0}});
    m.add(PointOnCurve{.name = "wire",
                       .a = bead,
                       .at = wave.at(0.1).point,
                       .b = ground,
                       .curve = wave,
                       .clearance = clearance});
    m.add(Gravity{.acceleration = {0.5, -9.81}});
    return m;
  };
  const SimulationOptions options{.until = 0.6, .relative_tolerance = 1e-9, .samples = 61};
  const Result ideal = simulate(model({}), options);
  REQUIRE(ideal.summary.ok());
  const Result real =
      simulate(model(SlotClearance{.pin_radius = 4.0_mm, .radial = 0.02_mm, .law = law}), options);
  INFO(real.summary.reason);
  REQUIRE(real.summary.ok());
  CHECK((real["bead.x_m"] - ideal["bead.x_m"]).cwiseAbs().maxCoeff() < 2.0_mm);
  CHECK(real.summary.energy_balance < 1e-7 * real.summary.energy_exchanged);

  // A pin that slides along a level slot into its flat end, resting on the wall below.
  Model m;
  const Vec2 start(0.0, -0.1_mm - law.elastic.penetration_at(0.1 * 9.81));
  const BodyId pin = m.add({.name = "pin",
                            .mass = 0.1,
                            .inertia = 1e-5,
                            .pose = {start, 0.0},
                            .twist = {{0.5, 0.0}, 0.0}});
  m.add(PinInSlot{.name = "slot",
                  .pin = {pin, start, 4.0_mm},
                  .slot = {ground, curve_slot({.centreline = line_segment({-0.1, 0.0}, {0.1, 0.0}),
                                               .half_width = 4.1_mm,
                                               .start = SlotEnd::flat,
                                               .end = SlotEnd::flat})},
                  .law = law});
  m.add(Gravity{});
  const Result run = simulate(m, {.until = 0.6, .relative_tolerance = 1e-9, .samples = 601});
  REQUIRE(run.summary.ok());
  CHECK((run["slot.normal_force_N"].array() > 0.0).all());  // at rest on the wall, also meanwhile
  CHECK(std::ranges::any_of(run.events, [](const EventRecord& e) {
    return e.element == "slot end" && e.kind == "onset";
  }));
  CHECK(run["pin.x_m"].maxCoeff() < 0.1 + 0.1_mm + 0.1_mm);
  CHECK(run["pin.vx_m_per_s"](600) < 0.0);  // thrown back
  CHECK(run.summary.energy_balance < 1e-7 * 0.0125);
}

TEST_CASE("an absorber on the tautochrone has its order at every amplitude") {
  const double n = 2.0, R0 = 0.125, rho0 = R0 / (1.0 + n * n), omega = 30.0;
  const double period = 2.0 * pi / (n * omega);
  const double lambda = tautochronic_lambda(n), reach = 0.9 * rho0 / lambda;
  for (const double swing : {0.1, 0.5, 0.85}) {
    const Curve path =
        absorber_path({.distance = R0, .order = n, .lambda = lambda, .reach = reach});
    const Vec2 start = path.at(reach + swing * rho0 / lambda).point;
    Model m;
    const BodyId rotor =
        m.add({.name = "rotor", .mass = 5.0, .inertia = 0.05, .twist = {{0.0, 0.0}, omega}});
    const BodyId mass = m.add({.name = "mass",
                               .mass = 0.1,
                               .inertia = 1e-5,
                               .pose = {start, 0.0},
                               .twist = {omega * perp(start), omega}});
    m.add(Revolute{.name = "bearing", .a = ground, .b = rotor, .at = {0.0, 0.0}});
    m.add(AngleDriver{.name = "motor", .body = rotor, .angle = constant_speed(0.0, omega)});
    m.add(PointOnCurve{.name = "path", .a = mass, .at = start, .b = rotor, .curve = path});
    const Result run =
        simulate(m, {.until = 6.0 * period, .relative_tolerance = 1e-11, .samples = 2});
    REQUIRE(run.summary.ok());
    const double turned = run["rotor.angle_rad"](1);
    const Vec2 end = rotate(-turned, Vec2(run["mass.x_m"](1), run["mass.y_m"](1)));
    CHECK((end - start).norm() < 1e-8 * R0);
  }
}

TEST_CASE("clearances that cannot be are refused by the name of the joint") {
  Model m;
  const BodyId a = m.add({.name = "a", .mass = 1.0, .inertia = 1.0});
  CHECK(contains(message_of([&] {
                   m.add(Revolute{.name = "pin",
                                  .a = ground,
                                  .b = a,
                                  .clearance = BearingClearance{
                                      .journal_radius = 0.01, .radial = 0.0, .law = law}});
                 }),
                 "revolute 'pin', clearance: radial = 0 m must be finite and greater than 0 m"));
  CHECK(contains(
      message_of([&] {
        m.add(Prismatic{
            .name = "guide",
            .a = ground,
            .b = a,
            .clearance = GuideClearance{
                .length = 0.1, .width = 0.02, .gap = 1e-4, .law = law, .corner_radius = 0.02}});
      }),
      "prismatic 'guide', clearance: corner_radius = 0.02 m is outside"));
}
