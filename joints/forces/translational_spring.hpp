// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A spring and a damper in parallel between a point of a and a point of b.
//
//   e = p_b - p_a,  J = de/dq             see point_span.hpp
//   l = sqrt(e . e + eps^2),  n = e / l   length and direction; l' = n . e'
//   F = k (l - l_0) + c l'                [N] > 0 pulls the points together
//   Q = -F J^T n                          force on b = -F n at p_b, on a = +F n at p_a
//   V = k (l - l_0)^2 / 2 [J];   dissipated power = c l'^2 [W]
//   dQ/dq = -J^T n (dF/dq)^T - F (J^T P J + d(J^T n)/dq at fixed n),  P = (I - n n^T) / l
//   dF/dq = k J^T n + c (J^T P e' + dJ/dt^T n),   dF/dv = c J^T n
//
// eps is 1e-9 of the distance in the start pose: below rounding while the points are apart, it
// keeps force and Jacobian finite if they meet. There the direction is undefined: a spring with l_0
// > 0 turns its full force round within eps, one with l_0 = 0 passes smoothly.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <yoke/core/model.hpp>

namespace yoke {

struct TranslationalSpring {
  std::string name;
  BodyId a;  // either may be the ground
  BodyId b;
  Vec2 at_a{0.0, 0.0};  // [m] the end on a, global, in the start pose
  Vec2 at_b{0.0, 0.0};  // [m] the end on b, global, in the start pose; not the same point
  // Changeable parameters, "name.stiffness" and so on:
  double stiffness = 0.0;               // [N/m] k >= 0
  double damping = 0.0;                 // [N s/m] c >= 0
  std::optional<double> free_length{};  // [m] l_0 >= 0; default: relaxed in the start pose

  std::unique_ptr<ForceElement> build(const Model& model) const;
};

}  // namespace yoke
