// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/core/error.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

namespace {

constexpr int inner = static_cast<int>(SlotRegion::inner);
constexpr int outer = static_cast<int>(SlotRegion::outer);
constexpr int cap_start = static_cast<int>(SlotRegion::cap_start);
constexpr int cap_end = static_cast<int>(SlotRegion::cap_end);

ArcSlot arc(double angle) {
  return {
      .center = {0.3, -0.2}, .radius = 60e-3, .direction = 0.7, .angle = angle, .half_width = 8e-3};
}

/// Distance of p from the centreline: the smallest to its chords, which are within 3e-10 m of it.
double brute_distance(const Vec2& p, double radius, double angle) {
  constexpr int count = 20000;
  const auto point = [&](int i) {
    const double phi = angle * (static_cast<double>(i) / count - 0.5);
    return Vec2(radius * std::cos(phi), radius * std::sin(phi));
  };
  double best = std::numeric_limits<double>::infinity();
  Vec2 from = point(0);
  for (int i = 1; i <= count; ++i) {
    const Vec2 to = point(i), chord = to - from;
    const double share = std::clamp((p - from).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (p - from - share * chord).norm());
    from = to;
  }
  return best;
}

Vec2 random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-0.08, 0.08);
  return {uniform(random), uniform(random)};
}

std::string refusal(ArcSlot a, double pin_radius) {
  return message_of([&] { arc_slot(a).check("slot 'yoke.slot'", pin_radius); });
}

}  // namespace

TEST_CASE("distance to an arc slot's centreline agrees with brute force in every region") {
  std::mt19937 random(42);
  int seen[4] = {0, 0, 0, 0};
  for (const double angle : {0.6, 2.0943951, 5.0}) {
    const Slot slot = arc_slot(arc(angle));
    for (int i = 0; i < 60; ++i) {
      const Vec2 p = random_point(random);
      const int region = slot.nearest(p);
      ++seen[region];
      CHECK(std::abs(slot.touch(region, p).distance - brute_distance(p, 60e-3, angle)) < 2e-9);
    }
  }
  for (const int count : seen) CHECK(count > 5);
}

TEST_CASE("normal and bend are the gradient and Hessian of the distance, in and beyond the range") {
  const Slot slot = arc_slot(arc(2.0943951));
  std::mt19937 random(7);
  for (int i = 0; i < 40; ++i) {
    const Vec2 p = random_point(random);
    if (p.norm() < 5e-3) continue;
    for (const int region : {inner, outer, cap_start, cap_end}) {
      const Touch at = slot.touch(region, p);
      CHECK(at.region == region);
      CHECK(at.normal.norm() == Approx(1.0));
      constexpr double h = 1e-7;
      Vec2 gradient;
      Eigen::Matrix2d hessian;
      for (int k = 0; k < 2; ++k) {
        const Vec2 e = h * Vec2::Unit(k);
        const Touch up = slot.touch(region, p + e), down = slot.touch(region, p - e);
        gradient[k] = (up.distance - down.distance) / (2.0 * h);
        hessian.col(k) = (up.normal - down.normal) / (2.0 * h);
      }
      const Vec2 t = perp(at.normal);
      CHECK((gradient - at.normal).norm() < 1e-7);
      CHECK((hessian - at.bend * t * t.transpose()).norm() < 1e-6 * std::abs(at.bend));
    }
  }
}

TEST_CASE("regions meet with the same distance and normal, and the boundary changes sign there") {
  const Slot slot = arc_slot(arc(2.0943951));
  for (const double rho : {51.9e-3, 68.1e-3}) {
    for (const int cap : {cap_start, cap_end}) {
      const int wall = rho > 60e-3 ? outer : inner;
      const double sign = cap == cap_end ? 1.0 : -1.0;
      const auto at = [&](double phi) {
        return Vec2(rho * std::cos(phi), sign * rho * std::sin(phi));
      };
      const Vec2 p = at(1.04719755);
      CHECK(slot.touch(wall, p).distance == Approx(slot.touch(cap, p).distance));
      CHECK((slot.touch(wall, p).normal - slot.touch(cap, p).normal).norm() < 1e-6);
      const Vec2 before = at(1.04), beyond = at(1.05);
      CHECK(slot.boundary(wall, before) < 0.0);
      CHECK(slot.boundary(wall, beyond) > 0.0);
      CHECK(slot.boundary(cap, before) > 0.0);
      CHECK(slot.boundary(cap, beyond) < 0.0);
      CHECK(slot.successor(wall, beyond) == cap);
      CHECK(slot.successor(cap, before) == wall);
      CHECK(slot.nearest(before) == wall);
      CHECK(slot.nearest(beyond) == cap);
    }
  }
}

TEST_CASE("wall curvature is positive on the inner wall and negative in a bore") {
  const Slot slot = arc_slot(arc(2.0943951));
  CHECK(slot.touch(inner, {0.052, 0.0}).wall_curvature == Approx(1.0 / 0.052));
  CHECK(slot.touch(outer, {0.068, 0.0}).wall_curvature == Approx(-1.0 / 0.068));
  CHECK(slot.touch(cap_end, {0.0, 0.06}).wall_curvature == Approx(-1.0 / 0.008));
}

TEST_CASE("a pin exactly at a centre has a finite answer") {
  const Slot slot = arc_slot(arc(2.0));
  const Vec2 end(60e-3 * std::cos(1.0), 60e-3 * std::sin(1.0));
  for (const int region : {inner, outer, cap_start, cap_end}) {
    for (const Vec2& p : {Vec2(0.0, 0.0), end}) {
      const Touch touch = slot.touch(region, p);
      CHECK(std::isfinite(touch.bend));
      CHECK(touch.normal.norm() == Approx(1.0));
    }
  }
}

TEST_CASE("wrong slots are refused by name and value") {
  CHECK(refusal(arc(2.0), 7.9e-3) == "no error");
  ArcSlot narrow = arc(2.0);
  narrow.half_width = 7.9e-3;
  CHECK(refusal(narrow, 8e-3) ==
        "slot 'yoke.slot': width 15.8 mm is smaller than the pin diameter 16.0 mm");
  CHECK(refusal(arc(2.0), 8e-3) ==
        "slot 'yoke.slot': width 16.0 mm equals the pin diameter 16.0 mm: there is no clearance");
  ArcSlot tight = arc(2.0);
  tight.radius = 8e-3;
  CHECK(refusal(tight, 7.9e-3) ==
        "slot 'yoke.slot': radius = 0.008 m must be greater than half_width = 0.008 m");
  ArcSlot flat = arc(2.0);
  flat.half_width = -8e-3;
  CHECK(contains(refusal(flat, 7.9e-3), "half_width = -0.008 m"));
  CHECK(contains(refusal(arc(0.0), 7.9e-3), "angle = 0 rad"));
  CHECK(contains(refusal(arc(7.0), 7.9e-3), "between 0 and 2 pi"));
  CHECK(contains(refusal(arc(6.1), 7.9e-3), "caps overlap"));
  CHECK(contains(refusal(arc(2.0), -7.9e-3), "pin radius = -0.0079 m"));
  ArcSlot lost = arc(2.0);
  lost.center.x() = std::numeric_limits<double>::quiet_NaN();
  CHECK(contains(refusal(lost, 7.9e-3), "origin x = nan"));
}
