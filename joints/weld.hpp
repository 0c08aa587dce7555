// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Two bodies fixed to each other in the relative pose of the start.
//
//   Phi = ( p_b - p_a [m], theta_b - theta_a - start difference [rad] ) = 0, rows x, y, rotation
//   G   = rows x and y: see point_pair.hpp;  rotation: [ 0 0 -1  0 0 1 ]
//   force on b = -(lambda_x, lambda_y) [N] at the point, torque on b = -lambda_rotation [N m]
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <yoke/core/model.hpp>

namespace yoke {

struct Weld {
  std::string name;
  BodyId a;  // either may be the ground
  BodyId b;
  /// [m] where the reaction is reported, global, in the start pose; default: the centre of b, or of
  /// a if b is the ground.
  std::optional<Vec2> at{};

  std::unique_ptr<Constraint> build(const Model& model) const;
};

}  // namespace yoke
