// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A frictionless pin in a straight slot: a point of a stays on a line of b. Turning is free.
//
//   n = A(theta_b) perp(along)            unit normal of the line, fixed in b
//   Phi = n . (p_a - through) = 0 [m], row transverse;   p_a point of a, `through` carried by b
//   G, gamma, H, K: see projection.hpp
//   force on a = -lambda n [N] at p_a, the opposite on b
#pragma once

#include <memory>
#include <string>

#include <yoke/core/model.hpp>

namespace yoke {

struct PointOnLine {
  std::string name;
  BodyId a;                // carries the point; either may be the ground
  Vec2 at{0.0, 0.0};       // [m] the point, global, in the start pose
  BodyId b;                // carries the line
  Vec2 through{0.0, 0.0};  // [m] any point of the line, global, in the start pose
  Vec2 along{1.0, 0.0};    // its direction, global, in the start pose; any length but 0

  std::unique_ptr<Constraint> build(const Model& model) const;
};

}  // namespace yoke
