// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Every contact that ships is seen: its disc, and its walls where they are, material on the right.
#include <doctest/doctest.h>

#include <algorithm>

#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/core/drawing/drawing.hpp>
#include <yoke/tests/contact/every_contact.hpp>

using namespace yoke;
using namespace yoke::tests;

TEST_CASE("every contact draws its disc and its walls where a point would touch them") {
  for (const AnyContact& contact : every_contact()) {
    CAPTURE(contact.name);
    Model m;
    const BodyId disc =
        m.add({.name = "disc", .mass = 1.0, .inertia = 1.0, .pose = {contact.near[0], 0.0}});
    const BodyId shape =
        m.add({.name = "shape", .mass = 1.0, .inertia = 1.0, .pose = {{0.01, -0.02}, 0.6}});
    m.insert(contact.build(m, disc, shape, contact.near[0], ContactLaw{PowerLaw{1e6, 1.5}}));
    const Drawing drawing = draw(m);
    bool disc_seen = false;
    std::size_t walls = 0;
    for (const Shape& s : drawing.shapes()) {
      CHECK(s.element == "contact");
      if (s.kind == ShapeKind::disc) {
        disc_seen = true;
        CHECK(s.body == disc);
        CHECK(s.radius == doctest::Approx(contact.radius).epsilon(1e-9));
        CHECK(s.points[0].norm() < 1e-12);
        continue;
      }
      REQUIRE(s.body == shape);
      ++walls;
      const auto global = [&](const Vec2& p) -> Vec2 { return Vec2(0.01, -0.02) + rotate(0.6, p); };
      const auto distance = [&](const Vec2& p) {
        const Vec2 local = rotate(-contact.profile.angle(), p - contact.profile.origin());
        return contact.profile.touch(contact.profile.nearest(local), local).distance -
               contact.profile.half_width();
      };
      if (s.kind == ShapeKind::line) {
        CHECK(std::abs(distance(global(s.points[0]))) < 1e-9);
        const Vec2 left = perp(s.points[1]);
        CHECK(distance(global(s.points[0] + 1e-3 * left)) < 0.0);
        continue;
      }
      REQUIRE(s.kind == ShapeKind::wall);
      // A step into the free side: a wall is behind. Corners aside, where the wall turns.
      std::size_t seen = 0;
      for (std::size_t i = 0; i + 1 < s.points.size(); ++i) {
        const Vec2 along = s.points[i + 1] - s.points[i];
        if (along.norm() < 1e-9) continue;
        const Vec2 middle = 0.5 * (s.points[i] + s.points[i + 1]);
        const double step = 1e-4, d = distance(global(middle + step * perp(along.normalized())));
        if (std::abs(d + step) < 0.05 * step) ++seen;
      }
      CHECK(static_cast<double>(seen) > 0.9 * static_cast<double>(s.points.size() - 1));
    }
    CHECK(disc_seen);
    CHECK(walls >= 1);
  }
}
