// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/andrews.hpp>

#include <fmt/format.h>

#include <cmath>

#include <yoke/cases/case.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

using namespace andrews_data;

AndrewsBodies add_andrews_bodies(Model& m) {
  const auto [beta, theta, gamma, phi, delta, omega, epsilon] = start;
  AndrewsBodies b;
  const auto place = [&](std::size_t i, double mass, double inertia, const Vec2& from, double angle,
                         const Vec2& centre) {
    b.k[i] = m.add(Body{.name = fmt::format("K{}", i),
                        .mass = mass,
                        .inertia = inertia,
                        .pose = {from + rotate(angle, centre), angle}});
  };
  b.F = rotate(beta, {rr, 0.0});
  b.E = b.F - rotate(beta + theta, {d, 0.0});
  b.G = A + rotate(delta, {zt, 0.0});
  b.H = A + rotate(epsilon, {0.0, -u});
  b.D = B + rotate(gamma, {sd, -sc});
  place(1, m1, I1, O, beta, {ra, 0.0});
  place(2, m2, I2, b.F, beta + theta, {-da, 0.0});
  place(3, m3, I3, B, gamma, {sb, -sa});
  place(4, m4, I4, b.G, phi + delta, {0.0, -(e - ea)});
  place(5, m5, I5, A, delta, {ta, tb});
  place(6, m6, I6, b.H, omega + epsilon, {zf - fa, 0.0});
  place(7, m7, I7, A, epsilon, {ub, -ua});
  return b;
}

void add_andrews_joints(Model& m, const AndrewsBodies& b) {
  m.add(Revolute{.name = "O", .a = ground, .b = b.k[1], .at = O});
  m.add(Revolute{.name = "F", .a = b.k[1], .b = b.k[2], .at = b.F});
  m.add(Revolute{.name = "B", .a = ground, .b = b.k[3], .at = B});
  m.add(Revolute{.name = "G", .a = b.k[5], .b = b.k[4], .at = b.G});
  m.add(Revolute{.name = "A5", .a = ground, .b = b.k[5], .at = A});
  m.add(Revolute{.name = "H", .a = b.k[7], .b = b.k[6], .at = b.H});
  m.add(Revolute{.name = "A7", .a = ground, .b = b.k[7], .at = A});
}

Model andrews() {
  Model m;
  const AndrewsBodies b = add_andrews_bodies(m);
  add_andrews_joints(m, b);
  for (const std::size_t i : {3u, 4u, 6u})
    m.add(Revolute{.name = fmt::format("E{}", i), .a = b.k[2], .b = b.k[i], .at = b.E});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = b.k[3],
                            .at_a = C,
                            .at_b = b.D,
                            .stiffness = c0,
                            .free_length = l0});
  m.add(AppliedTorque{.name = "motor", .body = b.k[1], .torque = [](double) { return mom; }});
  return m;
}

Case andrews_case() {
  return case_without_choices("benchmarks", "andrews",
                              "Andrews' squeezing mechanism: seven bodies, three closed loops",
                              andrews, "0.03");
}

}  // namespace yoke::cases
