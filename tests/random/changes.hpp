// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The same mechanism described in another way. Its motion must be the same.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <yoke/tests/random/description.hpp>

namespace yoke::tests::random {

enum class Change {
  turn,       ///< about the origin, by any angle
  shift,      ///< by a hundred times its size
  mirror,     ///< at the x axis
  reorder,    ///< bodies, joints and forces, and which body of a joint is called a
  units,      ///< written in other units of length, mass and time, up to a thousand times as large
  bystanders  ///< beside 20 bodies that have nothing to do with it
};
const std::vector<Change>& all_changes();
std::string name_of(Change change);

/// A changed description, and the way back to the coordinates of the original.
struct Changed {
  Description d;
  bool mirrored = false;
  double angle = 0.0;                             // [rad] turned by
  Vec2 offset{0.0, 0.0};                          // [m] shifted by
  std::shared_ptr<const Description> original{};  // null: it is the original

  Vec2 point_back(const Vec2& p) const { return vector_back(p - offset); }
  Vec2 vector_back(const Vec2& v) const {
    const Vec2 turned_back = rotate(-angle, v);
    return mirrored ? Vec2(turned_back.x(), -turned_back.y()) : turned_back;
  }
  double angle_back(double a) const { return rate_back(a - angle); }
  double rate_back(double w) const { return mirrored ? -w : w; }
};

/// The details (angle, order, units) follow from the seed of the description.
Changed changed(const Description& d, Change change);

/// As it is.
inline Changed unchanged(const Description& d) { return {.d = d}; }

}  // namespace yoke::tests::random
