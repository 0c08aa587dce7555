// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// How far from a body's centre its joints act: what an angle counts for beside lengths.
#include <doctest/doctest.h>

#include <yoke/core/equations/scaled_saddle.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/revolute.hpp>

using namespace yoke;
using doctest::Approx;

namespace {

/// [m^2] what the angle of a body weighs that holds a pin in a line of the ground;
/// along the line its lever is 0.1 m, across it `lever`.
double weight_of_angle(double lever) {
  Model m;
  const BodyId body =
      m.add({.name = "body", .mass = 1.0, .inertia = 1e-2, .pose = {{0.3, 0.2}, 0.1}});
  const BodyId far =
      m.add({.name = "far", .mass = 1.0, .inertia = 1e-2, .pose = {{1.3, 0.2}, 0.0}});
  const Vec2 pin = Vec2(0.3, 0.2) + Vec2(lever, 0.1);
  m.add(PointOnLine{
      .name = "slot", .a = body, .at = pin, .b = ground, .through = pin, .along = {1.0, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = far, .at = {1.0, 0.2}});
  System system(m);
  return metric_of_lengths(system)[2];
}

}  // namespace

TEST_CASE("a lever that is short in the start pose only does not make turning cheap") {
  for (const double lever : {0.0, 1e-17, 1e-12, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3}) {
    CAPTURE(lever);
    CHECK(weight_of_angle(lever) > 0.25 * 0.01);
    CHECK(weight_of_angle(lever) < 1.1 * 0.01);
  }
  CHECK(weight_of_angle(0.05) == Approx(0.0025).epsilon(1e-12));
}

TEST_CASE("a lever that is short in every pose is as short as it is") {
  Model m;
  const BodyId body = m.add({.name = "body", .mass = 1.0, .inertia = 1e-2});
  const BodyId far =
      m.add({.name = "far", .mass = 1.0, .inertia = 1e-2, .pose = {{1.0, 0.0}, 0.0}});
  m.add(Revolute{.name = "short", .a = ground, .b = body, .at = {1e-4, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = far, .at = {0.5, 0.0}});
  System system(m);
  // The square of the lever is shared by the two equations of the joint.
  CHECK(metric_of_lengths(system)[2] == Approx(0.5e-8).epsilon(1e-9));
}
