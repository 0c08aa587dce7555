// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A frictionless pin in a curved slot without clearance: a point of a stays on a curve of b.
// Turning is free.
//
//   Phi = D(p) = 0 [m], row transverse;   D the distance of the point from the curve, > 0 on its left
//   G = dD/dq, gamma = -v^T H v with H = d2D/dq2, blocks H = (H v)^T and K = lambda H: see
//   core/curves/relative_point.hpp
//   force on a = -lambda n [N] at p, n the left normal; the opposite on b
//
// A curve with ends goes on smoothly beyond them: a point that runs off goes on along the tangent.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <yoke/core/clearance.hpp>
#include <yoke/core/curves/curve.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

struct PointOnCurve {
  std::string name;
  BodyId a;           // carries the point; either may be the ground
  Vec2 at{0.0, 0.0};  // [m] the point, global, in the start pose
  BodyId b;           // carries the curve
  Curve curve;        // global, in the start pose; without corners, not crossing itself

  /// Contacts in place of the constraint: SlotClearance (contact/clearance.hpp).
  std::optional<Clearance> clearance{};

  /// The constraint, whether or not there is clearance.
  std::unique_ptr<Constraint> build(const Model& model) const;
  /// The constraint, or what takes its place. Throws ModelError.
  Elements elements(const Model& model) const;
};

}  // namespace yoke
