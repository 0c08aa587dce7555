// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A pin joint: a point of b stays on a point of a; the bodies turn freely.
//
//   Phi = p_b - p_a = 0 [m], rows x and y;   G, gamma, H, K: see point_pair.hpp
//   force on b = -lambda [N], on a = +lambda, at the pin, in global axes
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <yoke/core/clearance.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

struct Revolute {
  std::string name;
  BodyId a;  // either may be the ground
  BodyId b;
  Vec2 at{0.0, 0.0};  // [m] the pin, global, in the start pose

  /// Contacts in place of the constraint: BearingClearance (contact/clearance.hpp), the bearing in a
  /// and the journal on b.
  std::optional<Clearance> clearance{};

  /// The constraint, whether or not there is clearance.
  std::unique_ptr<Constraint> build(const Model& model) const;
  /// The constraint, or what takes its place. Throws ModelError.
  Elements elements(const Model& model) const;
};

}  // namespace yoke
