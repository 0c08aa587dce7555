// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Curves from laws of motion: grooves pass through the law, cams lift by it.
#include <doctest/doctest.h>

#include <cmath>

#include <yoke/core/curves/motion_curves.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/units.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::literals;
using yoke::tests::contains;
using yoke::tests::message_of;

namespace {

MotionChain lift() {
  return motion({{dwell, 100.0_deg},
                 {cycloidal, 90.0_deg, 8.0_mm},
                 {dwell, 50.0_deg},
                 {polynomial_345, 120.0_deg, 0.0_mm}},
                {.repeat = Repeat::periodic});
}

}  // namespace

TEST_CASE("a developed groove passes through its law of motion") {
  const MotionChain law = motion({{dwell, 0.5}, {modified_sine, 1.2, 0.03}, {dwell, 0.4}},
                                 {.start = 0.01, .begin = 0.2});
  const Vec2 e = rotate(0.3, {1.0, 0.0}), origin(0.4, -0.1);
  const Curve groove =
      developed_groove(law, {.origin = origin, .direction = 7.0 * e, .scale = 0.05});
  CHECK(groove.pieces() == 3);
  CHECK(corners_of(groove).empty());
  for (int i = 1; i < 210; ++i) {
    const double x = 0.2 + 0.01 * i;
    const Vec2 p = origin + 0.05 * (x - 0.2) * e + law(x).value * perp(e);
    CHECK(std::abs(groove.offset(p).distance) < 1e-14);
  }
}

TEST_CASE("a disc cam lifts its roller by the law, turned to any angle") {
  const DiscCam cam{
      .center = {0.1, 0.2}, .direction = 1.1, .base_radius = 25.0_mm, .roller_radius = 6.0_mm};
  const Curve profile = cam_profile(lift(), cam), pitch = cam_pitch_curve(lift(), cam);
  CHECK(profile.closed());
  CHECK(profile.pieces() == 4);
  CHECK(corners_of(profile).empty());
  for (int i = 0; i < 360; ++i) {
    const double angle = 2.0 * pi * (i + 0.3) / 360.0;
    // The roller's centre in the cam.
    const Vec2 p = cam.center + rotate(1.1 - angle, {31.0_mm + lift()(angle).value, 0.0});
    CHECK(std::abs(pitch.offset(p).distance) < 1e-14);
    CHECK(std::abs(profile.offset(p).distance - 6.0_mm) < 1e-13);  // on its left
  }
  // The base circle is exact.
  CHECK(std::abs((profile.at(1.0_mm).point - cam.center).norm() - 25.0_mm) < 1e-16);
}

TEST_CASE("cams that cannot be made are refused, with the angle") {
  const auto refused = [](const MotionChain& law, const DiscCam& cam) {
    return message_of([&] { cam_profile(law, cam); });
  };
  CHECK(contains(refused(lift(), {.base_radius = 3.0_mm, .roller_radius = 20.0_mm}),
                 "not greater than roller_radius = 0.02 m"));
  CHECK(contains(refused(lift(), {.base_radius = 0.0}), "base_radius = 0 m"));
  CHECK(contains(refused(motion({{dwell, 1.0}}), {.base_radius = 0.02}), "a full turn, 2 pi"));
  CHECK(contains(refused(motion({{dwell, pi}, {cycloidal, pi, 0.01}}), {.base_radius = 0.02}),
                 "ends at 0.01 m and begins at 0 m"));
  CHECK(contains(refused(motion({{cycloidal, pi, -0.03}, {cycloidal, pi, 0.0}}),
                         {.base_radius = 0.02, .roller_radius = 0.02}),
                 "reaches the axis"));
}
