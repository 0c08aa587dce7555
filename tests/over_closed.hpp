// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// An over-closed mechanism that the random mechanisms found (20022), shrunk.
#pragma once

#include <yoke/core/model.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::tests {

/// A guide and a pin tie a light plate to a heavy wheel, which moves on a light link's short lever.
inline Model plate_on_heavy_wheel() {
  Model m;
  const BodyId wheel =
      m.add({.name = "wheel", .mass = 7.7e6, .inertia = 62000.0, .pose = {{0.067, -0.33}, 0.0}});
  const BodyId plate =
      m.add({.name = "plate", .mass = 3.9, .inertia = 0.12, .pose = {{0.22, -0.065}, 0.0}});
  const BodyId link =
      m.add({.name = "link", .mass = 7.4, .inertia = 0.041, .pose = {{0.24, -0.7}, 0.0}});
  m.add(Prismatic{.name = "guide", .a = wheel, .b = plate, .along = {-0.91, -0.42}});
  m.add(Revolute{.name = "hinge", .a = wheel, .b = link, .at = {0.18, -0.43}});
  m.add(PointOnLine{.name = "line",
                    .a = link,
                    .at = {0.29, -0.63},
                    .b = ground,
                    .through = {0.31, -0.52},
                    .along = {-0.21, -0.98}});
  m.add(
      Distance{.name = "rod", .a = link, .b = wheel, .at_a = {0.29, -0.77}, .at_b = {0.1, -0.37}});
  m.add(Revolute{.name = "pin", .a = wheel, .b = plate, .at = {0.16, -0.24}});
  return m;
}

}  // namespace yoke::tests
