// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Curves made from laws of motion (core/motion_laws.hpp): the groove of a drum, unrolled, and disc
// cams. One smooth piece for each segment of the motion; a dwell is an exact line or arc.
//
//   groove   c(x) = origin + scale (x - begin) e + f(x) perp(e)
//   pitch    P(x) = center + R(x) u(x),  R = base_radius + roller_radius + f(x),
//            u(x) turned by -x against `direction`: what the centre of the roller describes in the
//            cam while the cam turns by x, counter-clockwise
//   profile  P - roller_radius n,  n to the left of the pitch curve, that is outwards
#pragma once

#include <yoke/core/curves/curve.hpp>
#include <yoke/core/motion_laws.hpp>

namespace yoke {

/// Where the groove of a drum is when unrolled.
struct DevelopedGroove {
  Vec2 origin{0.0, 0.0};     // [m] where the motion begins with value 0; global, in the start pose
  Vec2 direction{1.0, 0.0};  // e, in which the argument grows; any length but 0
  double scale = 0.0;        // [m per unit of the argument] > 0: the radius of a drum
};

/// Throws ModelError.
Curve developed_groove(const MotionChain& motion, const DevelopedGroove& groove);

/// Where a disc cam is, and its roller.
struct DiscCam {
  Vec2 center{0.0, 0.0};       // [m] axis of the cam, global, in the start pose
  double direction = 0.0;      // [rad] from the axis to the roller
  double base_radius = 0.0;    // [m] > 0, of the profile where the lift is 0
  double roller_radius = 0.0;  // [m] >= 0; 0: a knife edge
};

/// Closed, clockwise: the roller is on its left. `lift` [m] over the angle [rad] lasts a full turn
/// and ends where it began. Throws ModelError, also if the roller is too large for the profile, or
/// the lift reaches the axis; names the angle.
Curve cam_profile(const MotionChain& lift, const DiscCam& cam);

/// The path of the roller's centre in the cam; the same errors, but for the size of the roller.
Curve cam_pitch_curve(const MotionChain& lift, const DiscCam& cam);

}  // namespace yoke
