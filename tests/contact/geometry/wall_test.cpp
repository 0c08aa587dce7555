// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Walls along curves: the region nearest to a disc, by brute force.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include <yoke/contact/geometry/wall.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>

using namespace yoke;

TEST_CASE("the nearest region of a wall is the nearest, also of walls that turn far") {
  const Curve arc =
      circular_arc({.center = {0.01, -0.02}, .radius = 0.05, .start = 0.8, .angle = 4.7});
  const Curve box = polyline({{0.0, 0.0}, {0.1, 0.0}, {0.1, 0.05}, {0.0, 0.05}, {0.0, 0.02}});
  for (const Curve& curve : {arc, box}) {
    // Outside: to the right of both.
    const Slot wall = wall_profile(
        {.curve = curve, .disc_on_left = false, .disc_radius = 0.0, .thickness = 1e-3});
    const std::vector<Vec2> points = curve.sample(1e-5);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-0.12, 0.18);
    std::set<int> seen;
    int outside = 0;
    for (int i = 0; i < 400; ++i) {
      const Vec2 p(uniform(random), uniform(random));
      double nearest = 1.0;
      for (const Vec2& on : points) nearest = std::min(nearest, (p - on).norm());
      const CurvePlace foot = curve.nearest(p);
      const CurvePoint at = curve.at(curve.length_to(foot));
      if (cross(at.tangent, p - at.point) > 0.0) continue;  // in the material
      ++outside;
      const Vec2 local = p - wall.origin();
      const int region = wall.nearest(local);
      seen.insert(region);
      CHECK(std::abs(-wall.touch(region, local).distance - nearest) <
            1e-6 * (1.0 + 1e-4 / nearest));
    }
    CHECK(outside > 200);
    CHECK(seen.size() >= 3);
  }
}
