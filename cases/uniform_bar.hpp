// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A link of a linkage: a thin uniform bar between two places, moving.
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include <yoke/core/model.hpp>

namespace yoke::cases {

struct UniformBar {
  std::string name;
  double mass = 0.0;     // [kg]
  Vec2 from, to;         // [m] its ends at the start
  Vec2 speed{0.0, 0.0};  // [m/s] of `from` at the start
  double turning = 0.0;  // [rad/s]
};

/// Its axes are along the bar, from the middle towards `to`.
inline Body uniform_bar(UniformBar bar) {
  const Vec2 way = bar.to - bar.from;
  const double length = way.norm();
  return {.name = std::move(bar.name),
          .mass = bar.mass,
          .inertia = bar.mass * length * length / 12.0,
          .pose = {0.5 * (bar.from + bar.to), std::atan2(way.y(), way.x())},
          .twist = {bar.speed + bar.turning * perp(0.5 * way), bar.turning}};
}

}  // namespace yoke::cases
