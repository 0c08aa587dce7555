// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/car_axis.hpp>

#include <yoke/cases/case.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

Model car_axis() {
  const Vec2 origin(0.0, 0.0);
  const double L = 1.0, L0 = 0.5, mass = 10.0 * 1e-2 * 1e-2 / 2.0;
  const Vec2 left_start(0.0, L0), right_start(L, L0);
  Model m;
  const BodyId road =
      m.add(Body{.name = "road", .mass = mass, .inertia = mass, .twist = {{0.0, 0.0}, 1.0}});
  const auto wheel = [&](const char* name, const Vec2& at) {
    return m.add(Body{.name = name,
                      .mass = mass,
                      .inertia = mass,
                      .pose = {at, 0.0},
                      .twist = {{-L0 / L, 0.0}, 0.0}});
  };
  const BodyId left = wheel("left", left_start), right = wheel("right", right_start);
  m.add(Revolute{.name = "foot", .a = ground, .b = road, .at = origin});
  // The right end of the axle is lifted by y_b = 0.1 sin(10 t), its left one stays: sin(angle) =
  // y_b
  m.add(AngleDriver{.name = "bump", .body = road, .angle = time_function([](auto t) {
                                                    return asin(0.1 * sin(10.0 * t));
                                                  })});
  const auto spring = [&](const char* name, BodyId body, const Vec2& from, const Vec2& to) {
    m.add(TranslationalSpring{.name = name,
                              .a = road,
                              .b = body,
                              .at_a = from,
                              .at_b = to,
                              .stiffness = 1.0,
                              .free_length = L0});
  };
  spring("left spring", left, origin, left_start);
  spring("right spring", right, {L, 0.0}, right_start);
  // The left mass is held square to the axle, the right one only by the rod.
  m.add(PointOnLine{.name = "guide",
                    .a = left,
                    .at = left_start,
                    .b = road,
                    .through = origin,
                    .along = {0.0, 1.0}});
  m.add(Distance{.name = "rod", .a = left, .b = right, .at_a = left_start, .at_b = right_start});
  m.add(Gravity{.acceleration = {0.0, -1.0}});
  return m;
}

Case car_axis_case() {
  return case_without_choices("benchmarks", "car_axis",
                              "car axis of the test set for IVP solvers: stiff springs, a rod",
                              car_axis, "3");
}

}  // namespace yoke::cases
