// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Basic values: points, bodies, identifiers. SI units throughout; axes x
// to the right, y up, angles positive counter-clockwise.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

namespace yoke {

using Vec2 = Eigen::Vector2d;  ///< point [m] or direction, global frame unless stated otherwise

/// Half a turn [rad].
inline constexpr double pi = 3.14159265358979323846;

/// z-axis cross vector: a turned by +90 degrees.
inline Vec2 perp(const Vec2& a) { return {-a.y(), a.x()}; }
/// z component of a x b.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
/// `a` rotated by `angle` [rad].
inline Vec2 rotate(double angle, const Vec2& a) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * a.x() - s * a.y(), s * a.x() + c * a.y()};
}

/// Identifies a body of one Model. Index 0 is the ground, which does not move.
struct BodyId {
  int index = 0;  // into Model::bodies()
  friend bool operator==(BodyId, BodyId) = default;
};
/// Body 0 of every model, fixed at the origin.
inline constexpr BodyId ground{0};

/// Position of a body's centre of mass and its angle, in the global frame.
struct Pose {
  Vec2 position{0.0, 0.0};  // [m]
  double angle = 0.0;       // [rad]
};

/// Velocity of a body's centre of mass and its angular velocity, in the global frame.
struct Twist {
  Vec2 velocity{0.0, 0.0};  // [m/s]
  double omega = 0.0;       // [rad/s]
};

/// A rigid body. Its frame is at the centre of mass.
///
/// Without mass (a massless rod), without inertia (a point mass) or with an inertia alone (a wheel
/// whose mass is neglected) it may be where joints and drivers let nothing massless move alone: the
/// matrix [M G^T; G 0] must be regular. Assembly throws ModelError where it is not, naming what is
/// free: "'rod': no mass and free to turn". The frame of a body without mass is where the user puts
/// it. Its motion may end at an impasse, see docs/start_and_redundancy.md.
struct Body {
  std::string name;      // unique in the model: columns and messages use it
  double mass = 0.0;     // [kg], >= 0
  double inertia = 0.0;  // [kg m^2] about the centre of mass, >= 0
  Pose pose{};           // at the start; assembly corrects it if the joints require it
  Twist twist{};         // velocity at the start; corrected in the same way
  /// [m] For pictures only: a closed polygon, global, in the start pose. Empty: made from what is
  /// attached to the body (core/drawing/drawing.hpp).
  std::vector<Vec2> outline{};
};

/// `body` with a point mass fixed to it at the global point `at` of its start pose: mass, centre of
/// mass and inertia of the compound (parallel axis theorem). The frame moves to the new centre.
Body with_point_mass(Body body, double mass, const Vec2& at);

}  // namespace yoke
