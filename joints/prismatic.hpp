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
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <yoke/core/clearance.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

struct Prismatic {
  std::string name;
  BodyId a;              // the guide; either may be the ground
  BodyId b;              // what slides
  Vec2 along{1.0, 0.0};  // global, in the start pose; any length but 0
  /// [m] the point of b at which the transverse force acts and about which the moment is reported,
  /// global, in the start pose; default: the centre of b, or of a if b is the ground. Which point
  /// is taken changes how the reaction is split, not the motion.
  std::optional<Vec2> at{};

  /// Contacts in place of the constraint: GuideClearance (contact/clearance.hpp), the guide in a and
  /// the block on b with its middle at `at`.
  std::optional<Clearance> clearance{};

  /// The constraint, whether or not there is clearance.
  std::unique_ptr<Constraint> build(const Model& model) const;
  /// The constraint, or what takes its place. Throws ModelError.
  Elements elements(const Model& model) const;
};

}  // namespace yoke
