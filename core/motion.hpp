// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What elements read: positions and velocities of all bodies at one instant.
#pragma once

#include <cassert>
#include <span>

#include <yoke/core/types.hpp>

namespace yoke {

/// Pose and velocity of one body with the cosine and sine of its angle, computed once per state.
struct BodyMotion {
  double x = 0, y = 0, angle = 0;    // [m, m, rad] centre of mass, global frame
  double c = 1, s = 0;               // cos(angle), sin(angle)
  double vx = 0, vy = 0, omega = 0;  // [m/s, m/s, rad/s]

  /// [m] Centre of mass, global.
  Vec2 position() const { return {x, y}; }
  /// [m/s] Its velocity.
  Vec2 velocity() const { return {vx, vy}; }
  /// A body-fixed vector in global axes.
  Vec2 to_global(const Vec2& local) const {
    return {c * local.x() - s * local.y(), s * local.x() + c * local.y()};
  }
  /// A global vector in body axes.
  Vec2 to_local(const Vec2& global) const {
    return {c * global.x() + s * global.y(), -s * global.x() + c * global.y()};
  }
  /// Global position of a body-fixed point [m].
  Vec2 point(const Vec2& local) const { return position() + to_global(local); }
  /// Global velocity of a body-fixed point [m/s].
  Vec2 point_velocity(const Vec2& local) const {
    return velocity() + omega * perp(to_global(local));
  }
};

/// All bodies at one instant. bodies[id.index]; entry 0 is the ground, at rest at the origin.
struct Motion {
  double t = 0.0;                      // [s]
  std::span<const BodyMotion> bodies;  // the ground first
  std::span<const Body> inertia;       // masses and names, same indices

  /// Of one body.
  const BodyMotion& operator[](BodyId id) const {
    return bodies[static_cast<std::size_t>(id.index)];
  }
};

}  // namespace yoke
