// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Laws that follow the radius of a wall: against the exact law at the local radius, the derivatives of
// the force, what is refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <yoke/contact/geometry/curve_slot.hpp>
#include <yoke/contact/laws/dissipative/exact_restitution.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/dissipative/kelvin_voigt.hpp>
#include <yoke/contact/laws/dissipative/lee_wang_2.hpp>
#include <yoke/contact/laws/elastic/hertz.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/wall_law.hpp>
#include <yoke/core/curves/smooth_curves.hpp>
#include <yoke/tests/messages.hpp>

#include <yoke/tests/contact/every_contact.hpp>
#include <yoke/tests/contact/laws/test_laws.hpp>
#include <yoke/tests/contact/scene.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

namespace {

constexpr double a = 0.12, b = 0.08, r = 0.02, h = 0.0205;  // [m] ellipse, disc, half-width

Vec2 ellipse_at(double t) { return {a * std::cos(t), b * std::sin(t)}; }

Curve ellipse() { return curve_of(ellipse_at, 0.0, 2.0 * pi, {.closed = true}); }

double curvature_at(double t) {
  return a * b / std::pow(std::pow(a * std::sin(t), 2) + std::pow(b * std::cos(t), 2), 1.5);
}

RoundPair pair_of(double curvature) {
  return {.pin_radius = r,
          .wall_radius = 1.0 / std::abs(curvature),
          .conformity = curvature > 0.0 ? Conformity::external : Conformity::internal};
}

/// Johnson's law with a damping factor.
ContactLaw johnson_at(const SlotWall& wall) {
  return {johnson(pair_of(wall.curvature), 0.01), HuntCrossley{0.3}};
}

/// Hertz' law, which is smooth where a wall is flat; 1/R = 1/r + curvature.
ElasticLaw hertz_at(double curvature) { return hertz(1.1e11, 1.0 / (1.0 / r + curvature)); }

template <class Description>
Scene scene_of(const Description& description, const Model& model) {
  Scene scene;
  scene.element = description.build(model);
  return scene;
}

Model two_bodies() {
  Model model;
  model.add({.name = "a", .mass = 0.09, .inertia = 3e-5});
  model.add({.name = "b", .mass = 2.3, .inertia = 3e-3});
  return model;
}

const BodyId body_a{1}, body_b{2};

PinInSlot pin_in_ellipse(SlotLaws law) {
  return {.name = "slot",
          .pin = {body_a, ellipse_at(0.0), r},
          .slot = {body_b, curve_slot({.centreline = ellipse(), .half_width = h})},
          .law = std::move(law)};
}

/// Disc a centred at p, body b turned by nothing; both may move.
void put(Scene& scene, const Vec2& p, const Row6& v, ContactPhase phase) {
  scene.memory = {};
  // The pose of a at the start had its centre at the origin, the disc at ellipse_at(0).
  const Vec2 q = p - rotate(0.3, ellipse_at(0.0));
  scene.set({q.x(), q.y(), 0.3, 0.0, 0.0, 0.0}, v);
  scene.initialise();
  scene.memory.phase = phase;
  scene.memory.approach_velocity = 0.4;
  scene.memory.effective_mass = 0.83;
}

/// Disc a at parameter t of the ellipse, at a depth in the left (inner) or right wall of the slot.
Vec2 in_wall(double t, double depth, bool left) {
  const Vec2 tangent = Vec2(-a * std::sin(t), b * std::cos(t)).normalized();
  return ellipse_at(t) + (left ? 1.0 : -1.0) * (h - r + depth) * perp(tangent);
}

Row6 some_velocity(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Row6 v{};
  for (double& x : v) x = uniform(random);
  v[2] *= 5.0, v[5] *= 5.0;
  return v;
}

double largest_of(const std::array<double, 36>& m) {
  double size = 0.0;
  for (const double x : m) size = std::max(size, std::abs(x));
  return size;
}

std::string refusal_of(const SlotLaws& law) {
  return message_of([&] { pin_in_ellipse(law).build(two_bodies()); });
}

}  // namespace

TEST_CASE("the force follows the exact law at the local radius of each wall") {
  const Model model = two_bodies();
  Scene scene = scene_of(pin_in_ellipse(SlotLaws(johnson_at)), model);
  for (const bool left : {true, false})
    for (double t = 0.05; t < 6.2; t += 0.29)
      for (const double depth : {1e-7, 4e-6, 3e-5, 2e-4}) {
        put(scene, in_wall(t, depth, left), {}, ContactPhase::compressing);
        const double k = curvature_at(t), s = left ? 1.0 : -1.0;
        const double wall = s * k / (1.0 - s * k * h);
        const auto values = scene.channel_values();
        CAPTURE(t);
        CHECK(std::abs(values[0] - depth) < 3e-16);
        CHECK(values[7] == Approx(wall).epsilon(1e-10));
        const ElasticResponse exact = johnson(pair_of(wall), 0.01)(values[0]);
        CHECK(values[2] == Approx(exact.force).epsilon(1e-10).scale(0.0));
        CHECK(scene.energy().stored == Approx(exact.energy).epsilon(1e-10).scale(0.0));
      }
}

TEST_CASE("Radii::mean takes one radius for the whole wall: what it turns by over its length") {
  Scene scene = scene_of(pin_in_ellipse(SlotLaws(johnson_at, Radii::mean)), two_bodies());
  const double length = ellipse().length() - 2.0 * pi * h;  // of the inner wall
  const Johnson exact = johnson(pair_of(2.0 * pi / length), 0.01);
  for (const double t : {0.1, 1.4, 3.0}) {
    put(scene, in_wall(t, 3e-5, true), {}, ContactPhase::compressing);
    CHECK(scene.channel_values()[2] == Approx(exact(3e-5).force).epsilon(1e-9));
  }
}

TEST_CASE("derivatives of a force that follows the radius are exact, with every kind of damping") {
  std::mt19937 random(31);
  const auto law_with = [](const DissipativeLaw& damping) {
    return SlotLaws([damping](const SlotWall& w) {
      return ContactLaw{johnson(pair_of(w.curvature), 0.01), damping};
    });
  };
  const DissipativeLaw damped[] = {{}, HuntCrossley{0.3}, ExactRestitution{0.6}, KelvinVoigt{0.7}};
  for (const DissipativeLaw& damping : damped) {
    Scene scene = scene_of(pin_in_ellipse(law_with(damping)), two_bodies());
    for (int i = 0; i < 200; ++i) {
      const bool left = i % 2 == 0;
      // Deep, so that what the changing curvature adds is not lost beside the rest.
      const double depth = i % 4 < 2 ? 3e-4 : 2e-5;
      const Vec2 p = in_wall(0.031 * i, depth, left);
      const Row6 v = some_velocity(random);
      put(scene, p, v, ContactPhase::compressing);
      const Row6 q = scene.q();
      std::array<double, 36> dQ_dq{}, dQ_dv{};
      scene.element->evaluate(scene.input(), {.dQ_dq = dQ_dq.data(), .dQ_dv = dQ_dv.data()});
      CAPTURE(damping.name());
      CAPTURE(i);
      for (std::size_t j = 0; j < 6; ++j) {
        const double step = 1e-3 * depth * (j % 3 == 2 ? 5.0 : 1.0);
        Row6 sum{};
        for (const auto& [shift, weight] :
             {std::pair{1.0, 8.0}, {-1.0, -8.0}, {2.0, -1.0}, {-2.0, 1.0}}) {
          Row6 moved = q;
          moved[j] += shift * step;
          scene.set(moved, v);
          const Row6 Q = scene.Q();
          for (std::size_t k = 0; k < 6; ++k) sum[k] += weight * Q[k] / (12.0 * step);
        }
        for (std::size_t k = 0; k < 6; ++k)
          CHECK(std::abs(dQ_dq[6 * k + j] - sum[k]) < 1e-8 * largest_of(dQ_dq));
      }
      scene.set(q, v);
    }
  }
}

TEST_CASE(
    "the force without damping is the gradient of the stored energy, so it has a symmetric slope") {
  Scene scene = scene_of(pin_in_ellipse(SlotLaws([](const SlotWall& w) {
                           return ContactLaw{johnson(pair_of(w.curvature), 0.01)};
                         })),
                         two_bodies());
  for (double t = 0.2; t < 6.2; t += 0.37) {
    const double depth = 5e-4;
    put(scene, in_wall(t, depth, t < 3.0), {}, ContactPhase::compressing);
    const Row6 q = scene.q(), Q = scene.Q();
    std::array<double, 36> slope{};
    scene.element->evaluate(scene.input(), {.dQ_dq = slope.data()});
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        CHECK(std::abs(slope[6 * i + j] - slope[6 * j + i]) < 1e-14 * largest_of(slope));
    double along = 0.0;
    for (std::size_t j = 0; j < 6; ++j) {
      const double step = 1e-2 * depth;
      double sum = 0.0;
      for (const auto& [shift, weight] :
           {std::pair{1.0, 8.0}, {-1.0, -8.0}, {2.0, -1.0}, {-2.0, 1.0}}) {
        Row6 moved = q;
        moved[j] += shift * step;
        scene.set(moved, {});
        sum += weight * scene.energy().stored / (12.0 * step);
      }
      scene.set(q, {});
      CHECK(std::abs(Q[j] + sum) < 1e-8 * std::hypot(Q[0], Q[1]));
    }
    // The part along the wall is there: F alone would not be that gradient.
    const Vec2 tangent = Vec2(-a * std::sin(t), b * std::cos(t)).normalized();
    along = tangent.dot(Vec2(Q[0], Q[1]));
    CAPTURE(t);
    CHECK(std::abs(along) > 1e-6 * std::hypot(Q[0], Q[1]));
  }
}

TEST_CASE("the power of the force is what is stored and what is dissipated, sliding and striking") {
  std::mt19937 random(33);
  Scene scene = scene_of(pin_in_ellipse(SlotLaws(johnson_at)), two_bodies());
  for (int i = 0; i < 60; ++i) {
    const Row6 v = some_velocity(random);
    put(scene, in_wall(0.1 * i, 1e-4, i % 2 == 0), v, ContactPhase::compressing);
    const Row6 q = scene.q(), Q = scene.Q();
    double power = 0.0;
    for (std::size_t j = 0; j < 6; ++j) power += Q[j] * v[j];
    const double dissipated = scene.energy().dissipated_power;
    double rate = 0.0;
    constexpr double step = 1e-7;
    for (const auto& [shift, weight] :
         {std::pair{1.0, 8.0}, {-1.0, -8.0}, {2.0, -1.0}, {-2.0, 1.0}}) {
      Row6 moved = q;
      for (std::size_t j = 0; j < 6; ++j) moved[j] += shift * step * v[j];
      scene.set(moved, v);
      rate += weight * scene.energy().stored / (12.0 * step);
    }
    CHECK(std::abs(power + rate + dissipated) < 1e-8 * std::abs(scene.channel_values()[2]));
  }
}

TEST_CASE("a law that is smooth where a wall is flat follows it through inflections") {
  const Curve wave =
      curve_of([](double u) { return Vec2(u, 0.01 * std::sin(30.0 * u)); }, 0.0, 0.3);
  const DiscOnCurve description{
      .name = "wave",
      .disc = {body_a, {0.1, 0.1}, r},
      .body = body_b,
      .curve = wave,
      .law = [](const SlotWall& w) {
        return ContactLaw{hertz_at(w.region == SlotRegion::edge ? 1.0 / r : w.curvature)};
      }};
  Scene scene = scene_of(description, two_bodies());
  for (const double u : {0.03, 0.08, 0.1047, 0.12, 0.21}) {
    const double slope = 0.3 * std::cos(30.0 * u), bend = -9.0 * std::sin(30.0 * u);
    const Vec2 n = perp(Vec2(1.0, slope).normalized());
    const double k = -bend / std::pow(1.0 + slope * slope, 1.5);  // convex where it bends away
    const double depth = 3e-5;
    const Vec2 p = Vec2(u, 0.01 * std::sin(30.0 * u)) + (r - depth) * n;
    scene.memory = {};
    scene.set({p.x() - 0.1, p.y() - 0.1, 0.0, 0.0, 0.0, 0.0}, {});
    scene.initialise();
    CHECK(scene.channel_values()[2] == Approx(hertz_at(k).response(depth).force).epsilon(1e-10));
  }
}

TEST_CASE("laws that cannot follow a wall are refused with what is wrong and what helps") {
  const auto with = [](const DissipativeLaw& damping) {
    return SlotLaws([damping](const SlotWall& w) {
      return ContactLaw{johnson(pair_of(w.curvature), 0.01), damping};
    });
  };
  CHECK(contains(
      refusal_of(with(PermanentSet{0.7})),
      "slot 'slot': wall 'left': the law 'lankarani-nikravesh-1994' cannot follow the curvature of "
      "the wall: it unloads on another path than it loads. Take Radii::mean, or a law for "
      "each wall"));
  CHECK(contains(refusal_of(with(LeeWang2{})),
                 "cannot follow the curvature of the wall: it has a kink"));
  const DissipativeLaw square([](const ContactInput& in, const ElasticLaw& elastic) {
    const ElasticResponse e = elastic.response(in.penetration);
    return ContactOutput{.force = e.force + 1e-4 * e.force * e.force * in.rate,
                         .stored_energy = e.energy};
  });
  CHECK(contains(refusal_of(with(square)), "is no sum of multiples of the elastic force"));
  CHECK(contains(refusal_of(SlotLaws([](const SlotWall& w) {
                   return ContactLaw{johnson(pair_of(w.curvature), 0.01),
                                     HuntCrossley{w.curvature > 20.0 ? 0.2 : 0.3}};
                 })),
                 "is another one at one end of the wall than at the other"));
  // A law of the difference of the radii has no value where a wall is flat.
  const Curve wave =
      curve_of([](double u) { return Vec2(u, 0.01 * std::sin(30.0 * u)); }, 0.0, 0.3);
  const auto on_wave = [&](Radii radii) {
    return message_of([&] {
      DiscOnCurve{
          .name = "wave",
          .disc = {body_a, {0.1, 0.1}, r},
          .body = body_b,
          .curve = wave,
          .law = {[](const SlotWall& w) {
                    return ContactLaw{johnson(
                        pair_of(w.region == SlotRegion::edge ? 1.0 / r : w.curvature), 0.01)};
                  },
                  radii}}
          .build(two_bodies());
    });
  };
  CHECK(contains(on_wave(Radii::local),
                 "contact 'wave': wall 'wall': the law 'johnson' cannot follow"));
}
