// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A point of a body is moved along a direction fixed in another body as a function of time.
//
//   u = A(theta_L) along                  unit direction, fixed in L = relative_to
//   Phi = u . (p - from) - f(t) = 0 [m], row displacement;   p point of the body, `from` fixed in L
//   G, H, K: see projection.hpp;  Phi_t = -f';  gamma = that of projection.hpp + f''
//   force on the body = -lambda u [N] at p, the opposite on L; the drive supplies -lambda f' [W]
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <yoke/core/model.hpp>
#include <yoke/core/time_function.hpp>

namespace yoke {

struct DisplacementDriver {
  std::string name;
  BodyId body;
  Vec2 at{0.0, 0.0};            // [m] the driven point, global, in the start pose
  Vec2 along{1.0, 0.0};         // global, in the start pose; any length but 0
  BodyId relative_to = ground;  // in which the direction is fixed
  /// [m] where f = 0 is, global, in the start pose; default: at. So f counts from the start pose
  /// by default; with from = {0, 0} on the ground it is the coordinate itself.
  std::optional<Vec2> from{};
  TimeFunction displacement{};  // f [m]
  /// [m/s] The speed of a motion that is added to f, or alone if there is none, then from the start pose
  /// on: the changeable parameters "name.speed" and "name.acceleration" (0 at first). Setting the speed
  /// is a blow, setting the acceleration is none; what is driven goes on from where it is.
  std::optional<double> speed{};

  std::unique_ptr<Constraint> build(const Model& model) const;
};

}  // namespace yoke
