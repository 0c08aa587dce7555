// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include <yoke/contact/contact_element.hpp>
#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/geometry/curve_slot.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/model.hpp>
#include <yoke/core/units.hpp>
#include <yoke/tests/messages.hpp>

#include <yoke/tests/contact/laws/test_laws.hpp>
#include <yoke/tests/contact/scene.hpp>

using namespace yoke;
using namespace yoke::tests;
using namespace yoke::literals;
using doctest::Approx;

namespace {

constexpr double clearance = 0.1e-3;

const SlotLaws three_laws{ContactLaw{per_mm(49140, 1.10), HuntCrossley{0.32}},
                          ContactLaw{Johnson{1.137e11, 60.1e-3, 10e-3}, PermanentSet{0.71}},
                          ContactLaw{per_mm(314700, 1.28), hunt_crossley_restitution(0.57)}};

struct Where {
  int region;
  double phi;   // [rad] of the pin's centre in the profile's frame
  double side;  // +1 outside the centreline, -1 inside
};
constexpr Where places[] = {{0, 0.31, -1.0}, {1, -0.43, 1.0}, {2, -1.13, -1.0}, {3, 1.11, 1.0}};

/// Poses and velocities such that the pin penetrates the given region by `depth`, approaching, and
/// nothing is zero or one. The slot's body may be the ground: it stays where it is.
Scene scene_at(const Where& where, double depth, bool slot_on_ground, bool pin_on_ground = false) {
  Model model;
  const BodyId crank = model.add(Body{.name = "crank",
                                      .mass = 0.09,
                                      .inertia = 3e-5,
                                      .pose = {.position = {0.11, 0.23}, .angle = 0.37}});
  const BodyId slider = model.add(Body{.name = "slider",
                                       .mass = 2.3,
                                       .inertia = 3e-3,
                                       .pose = {.position = {-0.17, 0.05}, .angle = -0.61}});
  const ArcSlot arc{.center = {0.07, 0.31},
                    .radius = 60.0_mm,
                    .direction = 0.83,
                    .angle = 120.0_deg,
                    .half_width = 8.0_mm};
  const Vec2 tip(0.131, 0.317);
  Scene scene;
  scene.a = pin_on_ground ? ground : crank;
  scene.b = slot_on_ground ? ground : slider;
  scene.element = PinInSlot{.name = "slot",
                            .pin = {scene.a, tip, 7.9_mm},
                            .slot = {scene.b, arc_slot(arc)},
                            .law = three_laws}
                      .build(model);

  // The pin's centre in the profile's frame, from the cap's centre or radially from the arc's.
  const double reach = clearance + depth, R = 60e-3;
  const double end = (where.phi > 0.0 ? 1.0 : -1.0) * pi / 3.0;
  Vec2 p = (R + where.side * reach) * Vec2(std::cos(where.phi), std::sin(where.phi));
  if (where.region >= 2) {
    const Vec2 e = R * Vec2(std::cos(end), std::sin(end));
    const double tilt = end + (where.phi > 0.0 ? 0.9 : -0.7);
    p = e + reach * Vec2(std::cos(tilt), std::sin(tilt));
  }

  // Move one body far from its start pose, then the other to where the pin meets the point.
  const Vec2 on_slot = arc.center + rotate(arc.direction, p);  // in the start pose
  const Vec2 local_p = model.to_local(scene.b, on_slot), local_tip = model.to_local(scene.a, tip);
  Row6 q{}, v{-1.3, 0.7, 5.1, 0.9, -0.41, -3.3};
  if (pin_on_ground) {
    const double angle = 1.27;
    const Vec2 r = local_tip - rotate(angle, local_p);
    q = {0.0, 0.0, 0.0, r.x(), r.y(), angle};
    v[0] = v[1] = v[2] = 0.0;
  } else {
    const Vec2 r_b = slot_on_ground ? Vec2(0.0, 0.0) : Vec2(0.43, -0.29);
    const double angle_b = slot_on_ground ? 0.0 : 2.11, angle_a = -0.77;
    const Vec2 r_a = r_b + rotate(angle_b, local_p) - rotate(angle_a, local_tip);
    q = {r_a.x(), r_a.y(), angle_a, r_b.x(), r_b.y(), angle_b};
    if (slot_on_ground) v[3] = v[4] = v[5] = 0.0;
  }
  scene.set(q, v);
  scene.memory = {.phase = ContactPhase::compressing,
                  .region = where.region,
                  .approach_velocity = 0.21,
                  .effective_mass = 0.83};
  if (scene.channel_values()[1] < 0.0) {  // approaching, unless the test says otherwise
    for (double& x : v) x = -x;
    scene.set(q, v);
  }
  return scene;
}

double true_penetration(const Scene& scene) { return scene.channel_values()[0]; }

}  // namespace

TEST_CASE("the contact point lies on the wall, whose curvature is that of the arc or the cap") {
  for (const Where& where : places) {
    Scene scene = scene_at(where, 2.7e-5, false);
    const auto values = scene.channel_values();
    const Vec2 point(values[4], values[5]);
    // In the slot's body the point is half a width from the centreline.
    const BodyMotion& slider = scene.bodies[2];
    const Vec2 local = slider.to_local(point - slider.position());
    const Vec2 in_start = Vec2(-0.17, 0.05) + rotate(-0.61, local);
    const Vec2 p = rotate(-0.83, in_start - Vec2(0.07, 0.31));
    const double R = 60e-3, end = (where.phi > 0.0 ? 1.0 : -1.0) * pi / 3.0;
    const double distance = where.region < 2 ? std::abs(p.norm() - R)
                                             : (p - R * Vec2(std::cos(end), std::sin(end))).norm();
    CHECK(distance == Approx(8e-3));
    CHECK(values[7] * (where.region == 0   ? 52e-3
                       : where.region == 1 ? -68e-3
                                           : -8e-3) ==
          Approx(1.0));
  }
}

TEST_CASE("a model moved by a kilometre gives the same penetration to rounding") {
  for (const double shift : {0.0, 1000.0}) {
    Scene scene = scene_at(places[1], 2.7e-5, false);
    Row6 q = scene.q();
    for (const std::size_t i : {0u, 1u, 3u, 4u}) q[i] += shift;
    q[2] += 200.0 * pi;
    scene.set(q, scene.v());
    CHECK(std::abs(true_penetration(scene) - 2.7e-5) < (shift > 0.0 ? 1e-12 : 1e-14));
  }
}

TEST_CASE("apart there is no force, whatever the penetration") {
  Scene scene = scene_at(places[0], 2.7e-5, false);
  scene.memory = {};
  for (const double Q : scene.Q()) CHECK(Q == 0.0);
  CHECK(scene.energy().stored == 0.0);
  const auto values = scene.channel_values();
  CHECK(values[0] == Approx(2.7e-5).epsilon(1e-6));
  CHECK(values[2] == 0.0);
  CHECK(scene.element->channels()[3].labels[static_cast<std::size_t>(values[3])] == "apart");
}

TEST_CASE("the region is written by name, both caps as cap") {
  for (const Where& where : places) {
    Scene scene = scene_at(where, 2.7e-5, false);
    scene.memory = {};
    scene.initialise();
    CHECK(scene.memory.phase == ContactPhase::compressing);
    CHECK(scene.memory.region == where.region);
    const auto index = static_cast<std::size_t>(scene.channel_values()[3]);
    const std::string name = scene.element->channels()[3].labels[index];
    CHECK(name == (where.region == 0 ? "inner" : where.region == 1 ? "outer" : "cap"));
    CHECK(scene.records.at(0).region == name);
  }
}

TEST_CASE("a pin sliding past the end of the arc passes into the cap and back, at the boundary") {
  Scene scene = scene_at({1, 1.04, 1.0}, 2.7e-5, true);
  const double end = pi / 3.0;
  // The pin's centre goes along the outer wall's arc, and on beyond its end.
  const auto place = [&](double phi) {
    const Scene there = scene_at({1, phi, 1.0}, 2.7e-5, true);
    scene.set(there.q(), there.v());
  };
  place(end - 1e-6);
  CHECK(scene.event_functions()[ContactElement::region_end] < 0.0);
  const double before = scene.channel_values()[2];
  place(end + 1e-6);
  CHECK(scene.event_functions()[ContactElement::region_end] > 0.0);
  scene.handle(ContactElement::region_end);
  CHECK(scene.memory.region == 3);
  CHECK(scene.memory.phase == ContactPhase::compressing);
  CHECK(scene.records.at(0).kind == "region");
  CHECK(scene.records.at(0).region == "cap");
  CHECK(before > 0.0);
  CHECK(scene.event_functions()[ContactElement::region_end] < 0.0);
  place(end - 1e-6);
  CHECK(scene.event_functions()[ContactElement::region_end] > 0.0);
  scene.handle(ContactElement::region_end);
  CHECK(scene.memory.region == 1);
}

TEST_CASE("penetration beyond a law's range stops the run with a reason") {
  Scene scene = scene_at(places[1], 0.0315, true);
  const double limit = Johnson{1.137e11, 60.1e-3, 10e-3}.limit();
  CHECK(limit < 0.0326);
  CHECK(scene.event_functions()[ContactElement::limit] < 0.0);
  scene = scene_at(places[1], 0.9901 * limit, true);
  CHECK(scene.event_functions()[ContactElement::limit] > 0.0);
  scene.handle(ContactElement::limit);
  CHECK(scene.failure.find("outer: at t = 0 s the penetration 0.03") == 0);
  CHECK(contains(scene.failure, "'johnson"));
  scene.failure.clear();
  scene.memory = {};
  scene.initialise();
  CHECK_FALSE(scene.failure.empty());
}

TEST_CASE("penetration scale is the least penetration under the reference force") {
  const Scene scene = scene_at(places[0], 1e-5, false);
  // The cap is the stiffest at 100 N: 314.7e3 N/mm^1.28.
  CHECK(scene.element->penetration_scale() ==
        Approx(1e-3 * std::pow(100.0 / 314700.0, 1.0 / 1.28)));
}

TEST_CASE("a pin in a slot with wrong data is refused by name") {
  Model model;
  const BodyId crank = model.add(Body{.name = "crank", .mass = 0.09, .inertia = 3e-5});
  const auto add = [&](const Pin& pin, double reference_force = 100.0) {
    model.add(PinInSlot{
        .name = "yoke.slot",
        .pin = pin,
        .slot = {ground, arc_slot({.radius = 60.0_mm, .angle = 2.0, .half_width = 7.9_mm})},
        .law = ContactLaw{per_mm(49070, 1.10)},
        .reference_force = reference_force});
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(add({crank, {0.06, 0.0}, 8.0_mm}),
                    "slot 'yoke.slot': width 15.8 mm is smaller than the pin diameter 16.0 mm");
  CHECK_THROWS_WITH(add({crank, {0.06, nan}, 7.8_mm}),
                    "slot 'yoke.slot': pin y = nan must be a finite number");
  CHECK_THROWS_WITH(
      add({crank, {0.06, 0.0}, 7.8_mm}, 0.0),
      "contact 'yoke.slot': reference_force = 0 N must be finite and greater than 0 N");
  CHECK_THROWS_AS(add({BodyId{7}, {0.06, 0.0}, 7.8_mm}), ModelError);
  CHECK_THROWS_AS(add({ground, {0.06, 0.0}, 7.8_mm}), ModelError);
  add({crank, {0.06, 0.0}, 7.8_mm});
  CHECK(model.forces().size() == 1);
}

TEST_CASE(
    "a pin that starts behind a wall of its slot is refused, in an open slot it may be outside") {
  Model model;
  const BodyId pin = model.add({.name = "pin", .mass = 1.0, .inertia = 1e-3});
  const CurveSlot closed{.centreline = line_segment({0.0, 0.0}, {0.1, 0.0}), .half_width = 8.0_mm};
  CurveSlot open = closed;
  open.end = SlotEnd::open;
  const auto add = [&](const Slot& slot, const Vec2& at) {
    return message_of([&] {
      PinInSlot{.name = "slot",
                .pin = {pin, at, 7.0_mm},
                .slot = {ground, slot},
                .law = ContactLaw{per_mm(49070, 1.10)}}
          .build(model);
    });
  };
  CHECK(add(curve_slot(closed), {0.05, 0.0}) == "no error");
  CHECK(add(curve_slot(closed), {0.05, 2.0_mm}) == "no error");  // within the wall
  CHECK(contains(add(curve_slot(closed), {0.05, 0.03}),
                 "slot 'slot': the pin's centre (0.05, 0.03) m is 0.022 m behind the wall 'left'"));
  CHECK(add(curve_slot(open), {0.05, 0.03}) == "no error");
}
