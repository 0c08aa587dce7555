// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// evaluate() runs in the innermost loop: no element of the library may allocate there, whether its
// derivatives are written by hand or automatic.
#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include <yoke/core/authoring/auto_constraint.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/gear.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/joints/weld.hpp>
#include <yoke/tests/joints/fixture.hpp>

namespace {
std::atomic<long> allocations{0};
}

// Not inlined: GCC would take free() of what operator new gave for a mistake.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

using namespace yoke;
using namespace yoke::tests;

namespace {

class AutoDistance : public AutoConstraint<AutoDistance, 1, 2> {
 public:
  AutoDistance(BodyId a, BodyId b)
      : AutoConstraint("auto", {a, b}, {{"length", Measure::length}}) {}
  template <class T>
  T phi(const AutoPose<T>& a, const AutoPose<T>& b, const T& t) const {
    return (a.point(Vec2(0.1, 0.2)) - b.position()).norm() - 0.5 - atan2(t, a.x);
  }
};

}  // namespace

TEST_CASE("evaluating joints and forces allocates nothing") {
  Trio t;
  const TimeFunction f = time_function([](auto s) { return sin(2.0 * s) + atan2(s, 3.0); });
  const Vec2 p(0.1, 0.2), r(0.4, -0.3);
  t.model.add(Revolute{.name = "1", .a = t.a, .b = t.b, .at = p});
  t.model.add(Weld{.name = "2", .a = t.a, .b = t.b});
  t.model.add(Prismatic{.name = "3", .a = t.a, .b = t.b});
  t.model.add(Distance{.name = "4", .a = t.a, .b = t.b, .at_a = p, .at_b = r});
  t.model.add(PointOnLine{.name = "5", .a = t.a, .b = t.b});
  t.model.add(AngleDriver{.name = "6", .body = t.a, .angle = f});
  t.model.add(DisplacementDriver{.name = "7", .body = t.a, .displacement = f});
  t.model.add(Gear{.name = "8", .a = t.a, .b = t.b, .ratio = 2.0});
  t.model.add(AutoDistance(t.a, t.b));
  t.model.add(Gravity{.name = "9"});
  t.model.add(TranslationalSpring{.name = "10", .a = t.a, .b = t.b, .at_a = p, .at_b = r});
  t.model.add(TorsionalSpring{.name = "11", .a = t.a, .b = t.b});
  t.model.add(
      AppliedForce{.name = "12", .body = t.a, .force = [](double s) { return Vec2(s, 1); }});
  t.model.add(AppliedTorque{.name = "13", .body = t.a, .torque = [](double s) { return s; }});
  t.model.add(applied_force("14", t.a, p, [](auto, const auto& b) { return vec(b.vx, b.vy); }));
  t.model.add(applied_torque("15", t.a, [](auto, const auto& b) { return -b.omega; }));

  const HandMotion hand(t);
  const Motion motion = hand.at(0.3);
  double phi[3], G[27], phi_t[3], gamma[3], H[27], K[81] = {}, lambda[3] = {1, 2, 3};
  double Q[9] = {}, dQ_dq[81] = {}, dQ_dv[81] = {}, parameters[3] = {1, 2, 3};
  Energy energy;
  const long before = allocations;
  for (const auto& joint : t.model.constraints())
    joint->evaluate(motion, {phi, G, phi_t, gamma, H, K, lambda});
  for (const auto& force : t.model.forces())
    force->evaluate({.motion = motion, .parameters = parameters},
                    {.Q = Q, .dQ_dq = dQ_dq, .dQ_dv = dQ_dv, .energy = &energy});
  CHECK(allocations == before);
}
