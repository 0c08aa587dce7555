// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/curves/motion_curves.hpp>

#include <cmath>
#include <vector>

#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/curves/smooth_curves.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

/// One curve for each segment of a motion, from its argument there to that at its end.
template <class Piece>
Curve chain_of_segments(const MotionChain& motion, const Piece& piece) {
  const std::vector<double> ends = motion.junctions();
  std::vector<Curve> pieces;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    pieces.push_back(piece(i, ends[i], ends[i + 1]));
  return chain(pieces);
}

/// The pitch curve at an angle of the cam.
struct PitchPoint {
  Vec2 point, normal;      // [m]; to the left
  double curvature = 0.0;  // [1/m] < 0 where the cam is convex
};

PitchPoint pitch_point(const MotionValue& lift, double angle, const DiscCam& cam) {
  const double R = cam.base_radius + cam.roller_radius + lift.value;
  const Vec2 u = rotate(cam.direction - angle, {1.0, 0.0}), w = perp(u);
  const Vec2 first = lift.first * u - R * w;
  const Vec2 second = (lift.second - R) * u - 2.0 * lift.first * w;
  const double speed = first.norm();
  return {cam.center + R * u, perp(first) / speed, cross(first, second) / (speed * speed * speed)};
}

void check_cam(std::string_view owner, const MotionChain& lift, const DiscCam& cam,
               double profile_radius) {
  require_finite(owner, "center x", cam.center.x());
  require_finite(owner, "center y", cam.center.y());
  require_finite(owner, "direction", cam.direction);
  require_positive(owner, "base_radius", cam.base_radius, "m");
  require_not_negative(owner, "roller_radius", cam.roller_radius, "m");
  const double turn = lift.end() - lift.begin();
  const double first = lift.inside(0, lift.begin()).value,
               back = lift.inside(lift.junctions().size() - 2, lift.end()).value;
  if (!(std::abs(turn - 2.0 * pi) < 1e-9))
    throw ModelError(
        fmt::format("{}: the lift lasts {:.9g} rad; it must last a full turn, 2 pi", owner, turn));
  if (!(std::abs(back - first) < 1e-12 * cam.base_radius))
    throw ModelError(
        fmt::format("{}: the lift ends at {:g} m and begins at {:g} m; they must be the same",
                    owner, back, first));
  constexpr int parts = 500;  // of a segment
  const std::vector<double> ends = lift.junctions();
  for (std::size_t k = 0; k < parts * (ends.size() - 1); ++k) {
    const std::size_t i = k / parts;
    const double angle =
        ends[i] + (ends[i + 1] - ends[i]) * static_cast<double>(k % parts) / (parts - 1);
    const MotionValue at = lift.inside(i, angle);
    if (!(cam.base_radius + at.value > 0.0))
      throw ModelError(
          fmt::format("{}: at {:g} rad the lift of {:g} m reaches the axis; "
                      "base_radius = {:g} m must be greater",
                      owner, angle, at.value, cam.base_radius));
    const double bend = -pitch_point(at, angle, cam).curvature;
    if (!(bend * profile_radius < 1.0))
      throw ModelError(
          fmt::format("{}: at {:g} rad the path of the roller has a radius of {:g} m, not greater "
                      "than roller_radius = {:g} m: the profile would have a cusp",
                      owner, angle, 1.0 / bend, profile_radius));
  }
}

/// The curve at the distance `below` inside the pitch curve.
Curve cam_curve(const MotionChain& lift, const DiscCam& cam, double below) {
  return chain_of_segments(lift, [&](std::size_t i, double from, double to) {
    if (lift.dwells(i))
      return circular_arc(
          {.center = cam.center,
           .radius = cam.base_radius + cam.roller_radius + lift.inside(i, from).value - below,
           .start = cam.direction - from,
           .angle = from - to});
    return curve_of(
        [&](double angle) {
          const PitchPoint at = pitch_point(lift.inside(i, angle), angle, cam);
          return Vec2(at.point - below * at.normal);
        },
        from, to);
  });
}

}  // namespace

Curve developed_groove(const MotionChain& motion, const DevelopedGroove& groove) {
  constexpr std::string_view owner = "developed groove";
  require_finite(owner, "origin x", groove.origin.x());
  require_finite(owner, "origin y", groove.origin.y());
  require_positive(owner, "length of direction", groove.direction.norm(), "");
  require_positive(owner, "scale", groove.scale, "m");
  const Vec2 e = groove.direction.normalized();
  return chain_of_segments(motion, [&](std::size_t i, double from, double to) {
    const auto point = [&](double x) {
      return Vec2(groove.origin + groove.scale * (x - motion.begin()) * e +
                  motion.inside(i, x).value * perp(e));
    };
    return motion.dwells(i) ? line_segment(point(from), point(to)) : curve_of(point, from, to);
  });
}

Curve cam_profile(const MotionChain& lift, const DiscCam& cam) {
  check_cam("cam profile", lift, cam, cam.roller_radius);
  return cam_curve(lift, cam, cam.roller_radius);
}

Curve cam_pitch_curve(const MotionChain& lift, const DiscCam& cam) {
  check_cam("cam pitch curve", lift, cam, 0.0);
  return cam_curve(lift, cam, 0.0);
}

}  // namespace yoke
