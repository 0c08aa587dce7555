// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Motion along walls whose radius changes, under laws that follow it.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/geometry/curve_slot.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/curves/smooth_curves.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/forces/gravity.hpp>

using namespace yoke;
using doctest::Approx;

namespace {

constexpr double a = 0.12, b = 0.06, r = 0.01, clearance = 2e-4;  // [m]

/// Steel on steel over 1 mm, soft enough that the radius counts.
SlotLaws by_radius(double damping, Radii radii = Radii::local) {
  return {[damping](const SlotWall& wall) {
            const RoundPair pair{
                .pin_radius = r,
                .wall_radius = 1.0 / std::abs(wall.curvature),
                .conformity = wall.curvature > 0.0 ? Conformity::external : Conformity::internal};
            return ContactLaw{johnson(pair, 1e-3), HuntCrossley{damping}};
          },
          radii};
}

/// A pin thrown along an elliptic slot in a block that is free to move.
Model pin_in_ellipse(const SlotLaws& law) {
  Model m;
  const BodyId block = m.add({.name = "block", .mass = 0.8, .inertia = 3e-3});
  const BodyId pin = m.add({.name = "pin",
                            .mass = 0.1,
                            .inertia = 1e-5,
                            .pose = {{a, 0.0}, 0.0},
                            .twist = {{0.7, 2.0}, 0.0}});
  const Curve ellipse = curve_of([](double t) { return Vec2(a * std::cos(t), b * std::sin(t)); },
                                 0.0, 2.0 * pi, {.closed = true});
  m.add(PinInSlot{.name = "slot",
                  .pin = {pin, {a, 0.0}, r},
                  .slot = {block, curve_slot({.centreline = ellipse, .half_width = r + clearance})},
                  .law = law});
  return m;
}

}  // namespace

TEST_CASE(
    "a pin along an elliptic slot: the ledger closes to 1e-10 of the energy, nothing is dissipated by the changing radius") {
  for (const double damping : {0.0, 0.4}) {
    CAPTURE(damping);
    const Result run = simulate(pin_in_ellipse(by_radius(damping)),
                                {.until = 0.18, .relative_tolerance = 1e-12, .samples = 1801});
    INFO(run.summary.reason);
    REQUIRE(run.summary.ok());
    CHECK(run.events.size() > 20);
    const double energy = run["kinetic_J"](0);
    CHECK(run["balance_J"].cwiseAbs().maxCoeff() < 1e-10 * energy);
    const double dissipated = run["dissipated_J"].tail(1)[0];
    if (damping == 0.0)
      CHECK(dissipated == 0.0);
    else
      CHECK(dissipated > 0.05 * energy);
    // The pin went all along it: the radius of each wall varies more than sixfold.
    const auto curvature = run["slot.wall_curvature_1_per_m"];
    CHECK(curvature.maxCoeff() > 50.0);
    CHECK(curvature.minCoeff() < -24.8);
  }
}

TEST_CASE("a law that follows the radius moves the pin alike in every formulation") {
  const Model model = pin_in_ellipse(by_radius(0.4));
  const SimulationOptions options{.until = 0.04, .relative_tolerance = 1e-9, .samples = 41};
  const Result reference =
      simulate(model, {.until = 0.04, .relative_tolerance = 1e-12, .samples = 41});
  REQUIRE(reference.summary.ok());
  CHECK(reference.events.size() > 4);
  for (const FormulationNote& note : formulations()) {
    SimulationOptions own = options;
    own.formulation = note.name;
    const Result run = simulate(model, own);
    CAPTURE(note.name);
    INFO(run.summary.reason);
    REQUIRE(run.summary.ok());
    CHECK(run.events.size() == reference.events.size());
    for (const char* column : {"pin.x_m", "pin.y_m", "block.x_m", "block.angle_rad"})
      CHECK((run[column] - reference[column]).cwiseAbs().maxCoeff() < 1e-6);
  }
}

TEST_CASE("one radius for each wall is another law, close to the local one") {
  const SimulationOptions options{.until = 0.05, .relative_tolerance = 1e-9, .samples = 101};
  const Result local = simulate(pin_in_ellipse(by_radius(0.4)), options);
  const Result mean = simulate(pin_in_ellipse(by_radius(0.4, Radii::mean)), options);
  REQUIRE(local.summary.ok());
  REQUIRE(mean.summary.ok());
  CHECK(mean.summary.energy_balance < 1e-7);
  const double peak = local["slot.normal_force_N"].maxCoeff();
  CHECK(std::abs(mean["slot.normal_force_N"].maxCoeff() / peak - 1.0) < 0.3);
  CHECK((local["pin.x_m"] - mean["pin.x_m"]).cwiseAbs().maxCoeff() > 1e-8);
}

TEST_CASE(
    "an arc that is told as a spline moves the pin as the arc does, its law following the radius") {
  constexpr double radius = 0.06, sweep = 2.0, half_width = r + clearance;
  const auto yoke_with = [&](const Slot& slot) {
    Model m;
    const BodyId block = m.add({.name = "block", .mass = 0.8, .inertia = 3e-3});
    const BodyId pin = m.add({.name = "pin",
                              .mass = 0.1,
                              .inertia = 1e-5,
                              .pose = {{radius, 0.0}, 0.0},
                              .twist = {{0.5, 1.0}, 0.0}});
    m.add(PinInSlot{.name = "slot",
                    .pin = {pin, {radius, 0.0}, r},
                    .slot = {block, slot},
                    .law = by_radius(0.3)});
    return simulate(m, {.until = 0.05, .relative_tolerance = 1e-10, .samples = 51});
  };
  std::vector<Vec2> points;
  for (int i = 0; i <= 60; ++i)
    points.push_back(radius *
                     Vec2(std::cos(sweep * (i / 60.0 - 0.5)), std::sin(sweep * (i / 60.0 - 0.5))));
  const Slot spline = curve_slot({.centreline = curve_through(points), .half_width = half_width});
  // The radius of the spline varies enough for its law to follow it.
  const CurvatureRange range = spline.curvatures().front();
  CHECK(range.high - range.low > 1e-8 * range.high);
  const Result as_spline = yoke_with(spline);
  const Result as_arc =
      yoke_with(arc_slot({.radius = radius, .angle = sweep, .half_width = half_width}));
  REQUIRE(as_spline.summary.ok());
  REQUIRE(as_arc.summary.ok());
  CHECK(as_arc.events.size() > 4);
  CHECK(as_spline.events.size() == as_arc.events.size());
  for (const char* column : {"pin.x_m", "pin.y_m", "block.x_m", "block.angle_rad"})
    CHECK((as_spline[column] - as_arc[column]).cwiseAbs().maxCoeff() < 2e-9);
}
