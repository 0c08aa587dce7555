// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A massless rod: two points keep their distance L.
//
//   e   = p_b - p_a,  J = de/dq           see point_span.hpp
//   Phi = (e . e - L^2) / (2 L) = 0 [m], row length; smooth everywhere, and to first order the
//         change of length, since |e| - L = Phi + O(Phi^2)
//   G   = e^T J / L
//   gamma = -(e' . e' + e . (w_a^2 d_a - w_b^2 d_b)) / L
//   H   = (e'^T J + e^T dJ/dt) / L;  K = lambda (J^T J + d(J^T e)/dq at fixed e) / L
//   force on b = -lambda e / L [N] at p_b, the opposite on a: lambda is the tension
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <yoke/core/model.hpp>

namespace yoke {

struct Distance {
  std::string name;
  BodyId a;  // either may be the ground
  BodyId b;
  Vec2 at_a{0.0, 0.0};             // [m] the end on a, global, in the start pose
  Vec2 at_b{0.0, 0.0};             // [m] the end on b, global, in the start pose
  std::optional<double> length{};  // [m] > 0; default: from at_a to at_b in the start pose

  std::unique_ptr<Constraint> build(const Model& model) const;
};

}  // namespace yoke
