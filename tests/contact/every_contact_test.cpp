// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What holds for every contact, whatever its shape: exact derivatives, action and reaction, power.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/tests/messages.hpp>

#include <yoke/tests/contact/every_contact.hpp>
#include <yoke/tests/contact/laws/test_laws.hpp>
#include <yoke/tests/contact/scene.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

namespace {

/// The disc at rest in the wall in the start pose; then both bodies moved together anywhere, with any
/// velocities.
Scene scene_of(const AnyContact& contact, const Vec2& near, double depth, std::mt19937& random,
               const ContactLaw& law) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Model model;
  const Pose pose_a{{0.11, 0.13}, 0.37}, pose_b{{-0.17, 0.05}, -0.61};
  Scene scene;
  scene.a = model.add({.name = "a", .mass = 0.09, .inertia = 3e-5, .pose = pose_a});
  scene.b = model.add({.name = "b", .mass = 2.3, .inertia = 3e-3, .pose = pose_b});
  scene.element = contact.build(model, scene.a, scene.b, contact.touching(near, depth), law);
  const double turn = 3.0 * uniform(random);
  const Vec2 shift(uniform(random), uniform(random));
  const Vec2 a = rotate(turn, pose_a.position) + shift, b = rotate(turn, pose_b.position) + shift;
  const Row6 q{a.x(), a.y(), pose_a.angle + turn, b.x(), b.y(), pose_b.angle + turn};
  Row6 v{};
  for (double& x : v) x = uniform(random);
  v[2] *= 5.0, v[5] *= 5.0;
  scene.set(q, v);
  if (scene.channel_values()[1] < 0.0) {  // approaching, so that the force presses
    for (double& x : v) x = -x;
    scene.set(q, v);
  }
  scene.initialise();
  return scene;
}

double largest_of(const std::array<double, 36>& m) {
  double size = 0.0;
  for (const double x : m) size = std::max(size, std::abs(x));
  return size;
}

/// Column j of the derivative of Q by q or v.
Row6 slope(Scene& scene, std::size_t j, double step, bool of_velocity) {
  const Row6 q = scene.q(), v = scene.v();
  Row6 sum{};
  for (const double sign : {1.0, -1.0}) {
    Row6 q_moved = q, v_moved = v;
    (of_velocity ? v_moved : q_moved)[j] += sign * step;
    scene.set(q_moved, v_moved);
    const Row6 Q = scene.Q();
    for (std::size_t i = 0; i < 6; ++i) sum[i] += sign * Q[i] / (2.0 * step);
  }
  scene.set(q, v);
  return sum;
}

}  // namespace

TEST_CASE("every contact: derivatives are exact in every region, compressing and restituting") {
  std::mt19937 random(11);
  for (const AnyContact& contact : every_contact())
    for (const Vec2& near : contact.near)
      for (int i = 0; i < 20; ++i) {
        const ContactLaw law = i % 2 == 0 ? ContactLaw{per_mm(49140, 1.10), HuntCrossley{0.32}}
                                          : ContactLaw{per_mm(49140, 1.50), PermanentSet{0.71}};
        Scene scene = scene_of(contact, near, i % 4 < 2 ? 3e-5 : 4e-6, random, law);
        INFO(contact.name << " near " << near.x() << ", " << near.y());
        REQUIRE(scene.memory.phase != ContactPhase::apart);
        scene.memory.phase = ContactPhase::compressing;
        if (i % 2 == 1) {
          scene.memory.phase = ContactPhase::restituting;
          scene.memory.largest_penetration = 3.3e-5;
          scene.memory.permanent_set = 1.1e-6;
        }
        std::array<double, 36> dQ_dq{}, dQ_dv{};
        scene.element->evaluate(scene.input(), {.dQ_dq = dQ_dq.data(), .dQ_dv = dQ_dv.data()});
        CHECK(largest_of(dQ_dq) > 0.0);
        for (std::size_t j = 0; j < 6; ++j) {
          const Row6 by_q = slope(scene, j, 1e-9, false), by_v = slope(scene, j, 1e-5, true);
          for (std::size_t k = 0; k < 6; ++k) {
            CHECK(std::abs(dQ_dq[6 * k + j] - by_q[k]) < 5e-6 * largest_of(dQ_dq));
            CHECK(std::abs(dQ_dv[6 * k + j] - by_v[k]) <= 1e-7 * largest_of(dQ_dv));
          }
        }
      }
}

TEST_CASE("every contact: action and reaction, moments and power balance, the point on the wall") {
  std::mt19937 random(12);
  for (const AnyContact& contact : every_contact())
    for (const Vec2& near : contact.near) {
      INFO(contact.name << " near " << near.x() << ", " << near.y());
      const ContactLaw law{per_mm(49140, 1.10), HuntCrossley{0.32}};
      Scene scene = scene_of(contact, near, 2.7e-5, random, law);
      const Row6 q = scene.q(), v = scene.v(), Q = scene.Q();
      const auto values = scene.channel_values();
      const double F = values[2];
      CHECK(F > 0.0);
      CHECK(values[0] == Approx(2.7e-5).epsilon(1e-9));
      CHECK(Q[0] == -Q[3]);
      CHECK(Q[1] == -Q[4]);
      CHECK(std::hypot(Q[0], Q[1]) == Approx(F).epsilon(1e-12));
      const double moment = q[0] * Q[1] - q[1] * Q[0] + Q[2] + q[3] * Q[4] - q[4] * Q[3] + Q[5];
      CHECK(std::abs(moment) < 1e-12 * F);
      // The force acts at the point reported: no other moment about the centre of b.
      const Vec2 arm = Vec2(values[4], values[5]) - Vec2(q[3], q[4]);
      CHECK(Q[5] == Approx(cross(arm, Vec2(Q[3], Q[4]))).epsilon(1e-9).scale(1e-3 * F));
      double power = 0.0;
      for (std::size_t i = 0; i < 6; ++i) power += Q[i] * v[i];
      const double dissipated = scene.energy().dissipated_power;
      const auto stored_after = [&](double t) {
        Row6 at = q;
        for (std::size_t i = 0; i < 6; ++i) at[i] += t * v[i];
        scene.set(at, v);
        return scene.energy().stored;
      };
      constexpr double step = 1e-8;
      const double stored_rate = (stored_after(step) - stored_after(-step)) / (2.0 * step);
      CHECK(-power == Approx(stored_rate + dissipated).epsilon(1e-4));
    }
}

TEST_CASE("every contact: turned and shifted it is the same") {
  std::mt19937 random(13);
  const ContactLaw law{per_mm(49140, 1.10), HuntCrossley{0.32}};
  for (const AnyContact& contact : every_contact())
    for (const Vec2& near : contact.near) {
      Scene scene = scene_of(contact, near, 2.7e-5, random, law);
      const Row6 q = scene.q(), v = scene.v();
      const auto before = scene.channel_values();
      const Row6 Q = scene.Q();
      const double turn = 1.234;
      const auto turned = [&](double x, double y) { return rotate(turn, Vec2(x, y)); };
      const Vec2 a = turned(q[0], q[1]) + Vec2(3.0, -2.0), b = turned(q[3], q[4]) + Vec2(3.0, -2.0);
      const Vec2 va = turned(v[0], v[1]), vb = turned(v[3], v[4]);
      scene.set({a.x(), a.y(), q[2] + turn, b.x(), b.y(), q[5] + turn},
                {va.x(), va.y(), v[2], vb.x(), vb.y(), v[5]});
      const auto after = scene.channel_values();
      const Row6 Q_after = scene.Q();
      INFO(contact.name);
      for (const std::size_t i : {std::size_t{1}, std::size_t{6}})
        CHECK(after[i] == Approx(before[i]).epsilon(1e-11));
      CHECK(after[2] == Approx(before[2]).epsilon(1e-9));  // 1e-15 m of 27 um
      const Vec2 force = turned(Q[0], Q[1]);
      CHECK((Vec2(Q_after[0], Q_after[1]) - force).norm() < 1e-9 * force.norm());
      CHECK(Q_after[5] == Approx(Q[5]).epsilon(1e-9));
    }
}

TEST_CASE("discs and walls that cannot be are refused by name") {
  Model model;
  const BodyId ball = model.add({.name = "ball", .mass = 1.0, .inertia = 1e-3});
  const ContactLaw law{per_mm(49140, 1.10)};
  const auto refusal = [&](const auto& description) {
    return message_of([&] { model.add(description); });
  };
  const Curve floor = straight_line({0.0, 0.0}, {1.0, 0.0});
  CHECK(contains(refusal(DiscOnCurve{.name = "floor",
                                     .disc = {ball, {0.0, 0.1}, -1.0},
                                     .body = ground,
                                     .curve = floor,
                                     .law = law}),
                 "contact 'floor': radius of the disc = -1 m must be finite and at least 0 m"));
  CHECK(contains(refusal(DiscInHole{.name = "bearing",
                                    .disc = {ball, {0.0, 0.0}, 0.02},
                                    .hole = {ground, {0.0, 0.0}, 0.01},
                                    .law = law}),
                 "radius of the disc = 0.02 m must be less than the 0.01 m of the hole"));
  CHECK(contains(refusal(DiscOnCurve{.name = "box",
                                     .disc = {ball, {0.05, 0.05}, 0.01},
                                     .body = ground,
                                     .curve = polyline({{0.0, 0.0}, {0.1, 0.0}, {0.1, 0.1}}),
                                     .law = law}),
                 "contact 'box': into the corner behind piece 1"));
  const Curve valley =
      circular_arc({.center = {0.0, 0.0}, .radius = 0.05, .start = -0.5 * pi - 1.0, .angle = 2.0});
  CHECK(contains(refusal(DiscOnCurve{.name = "valley",
                                     .disc = {ball, {0.0, 0.0}, 0.06},
                                     .body = ground,
                                     .curve = valley,
                                     .law = law}),
                 "its radius is 0.05 m, not greater than the 0.06 m of the disc"));
}
