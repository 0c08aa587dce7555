// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/pendulums.hpp>

#include <yoke/cases/case.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

const Vec2 origin{0.0, 0.0};

/// A uniform rod of 1 m and 1 kg along x.
Body rod(const char* name, double from) {
  return {.name = name, .mass = 1.0, .inertia = 1.0 / 12.0, .pose = {{from + 0.5, 0.0}, 0.0}};
}

}  // namespace

Model point_pendulum() {
  Model m;  // the mass does not turn; its inertia plays no part
  const BodyId mass =
      m.add(Body{.name = "mass", .mass = 1.0, .inertia = 1.0, .pose = {{1.0, 0.0}, 0.0}});
  m.add(Distance{.name = "rod", .a = ground, .b = mass, .at_a = origin, .at_b = {1.0, 0.0}});
  m.add(Gravity{});
  return m;
}

Model rod_pendulum() {
  Model m;
  const BodyId b = m.add(rod("rod", 0.0));
  m.add(Revolute{.name = "pivot", .a = ground, .b = b, .at = origin});
  m.add(Gravity{});
  return m;
}

Model double_pendulum() {
  Model m;
  const BodyId a = m.add(rod("a", 0.0)), b = m.add(rod("b", 1.0));
  m.add(Revolute{.name = "pivot", .a = ground, .b = a, .at = origin});
  m.add(Revolute{.name = "elbow", .a = a, .b = b, .at = {1.0, 0.0}});
  m.add(Gravity{});
  return m;
}

Case point_pendulum_case() {
  return case_without_choices("point_pendulum",
                              "IFToMM benchmark A01: a point mass on a massless rod",
                              point_pendulum, "10");
}

Case double_pendulum_case() {
  return case_without_choices("double_pendulum", "two uniform rods in a row, released horizontal",
                              double_pendulum, "10");
}

}  // namespace yoke::cases
