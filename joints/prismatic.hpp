// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A straight guide: b slides along a direction fixed in a and does not turn against it.
//
//   n = A(theta_a) perp(along)            unit normal of the guide, fixed in a
//   Phi = ( theta_b - theta_a - start difference [rad], n . (p_b - p_a) [m] ) = 0,
//         rows rotation and transverse;   p_b point of b, p_a where it started, fixed in a
//   G   = rotation: [ 0 0 -1  0 0 1 ];  transverse, gamma, H, K: see projection.hpp
//   force on b = -lambda_transverse n [N] at p_b, torque on b = -lambda_rotation [N m]
//
// With friction the block, of length L with its middle at p_b, presses on the guide with its two ends:
//   N = |F/2 + M/L| + |F/2 - M/L| = max(|F|, 2 |M|/L),  F = lambda_transverse, M = lambda_rotation
// It slides at v_t = d/dt (t . (p_b - p_a)), t the direction of the guide; friction acts on b with -T t
// at p_b. See friction/joint_friction.hpp.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <yoke/core/clearance.hpp>
#include <yoke/core/friction_law.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

/// Friction of a block in its guide without clearance.
struct GuideFriction {
  FrictionLaw law;               // contact/laws/friction/
  double length = 0.0;           // [m] > 0, of the block; infinite: its moment presses nothing
  double preload = 0.0;          // [N] >= 0, of a seal say: added to the normal forces
  double reference_force = 1.0;  // [N] > 0, a light load of this joint
};

struct Prismatic {
  std::string name;
  BodyId a;              // the guide; either may be the ground
  BodyId b;              // what slides
  Vec2 along{1.0, 0.0};  // global, in the start pose; any length but 0
  /// [m] the point of b at which the transverse force acts and about which the moment is reported,
  /// global, in the start pose; default: the centre of b, or of a if b is the ground. Which point
  /// is taken changes how the reaction is split, not the motion, unless there is friction.
  std::optional<Vec2> at{};

  /// Contacts in place of the constraint: GuideClearance (contact/clearance.hpp), the guide in a and
  /// the block on b with its middle at `at`.
  std::optional<Clearance> clearance{};
  /// Friction of the ideal joint, the element "name.friction"; with clearance it is up to the contact law.
  std::optional<GuideFriction> friction{};

  /// The constraint, whether or not there is clearance or friction.
  std::unique_ptr<Constraint> build(const Model& model) const;
  /// The constraint and its friction, or what takes its place. Throws ModelError.
  Elements elements(const Model& model) const;
};

}  // namespace yoke
