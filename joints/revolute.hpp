// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A pin joint: a point of b stays on a point of a; the bodies turn freely.
//
//   Phi = p_b - p_a = 0 [m], rows x and y;   G, gamma, H, K: see point_pair.hpp
//   force on b = -lambda [N], on a = +lambda, at the pin, in global axes
//
// With friction the pin, of radius r, slides in its bore at v_t = r (theta_b' - theta_a') under the load
// N = |lambda|; the moment of friction on b is -r T(N, v_t). See friction/joint_friction.hpp.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <yoke/core/clearance.hpp>
#include <yoke/core/friction_law.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

/// Friction of a pin in its bore without clearance.
struct PinFriction {
  FrictionLaw law;               // contact/laws/friction/
  double radius = 0.0;           // [m] > 0, of the pin
  double preload = 0.0;          // [N] >= 0, of a seal say: added to the reaction
  double reference_force = 1.0;  // [N] > 0, a light load of this joint
};

struct Revolute {
  std::string name;
  BodyId a;  // either may be the ground
  BodyId b;
  Vec2 at{0.0, 0.0};  // [m] the pin, global, in the start pose

  /// Contacts in place of the constraint: BearingClearance (contact/clearance.hpp), the bearing in a
  /// and the journal on b.
  std::optional<Clearance> clearance{};
  /// Friction of the ideal joint, the element "name.friction"; with clearance it is up to the contact law.
  std::optional<PinFriction> friction{};

  /// The constraint, whether or not there is clearance or friction.
  std::unique_ptr<Constraint> build(const Model& model) const;
  /// The constraint and its friction, or what takes its place. Throws ModelError.
  Elements elements(const Model& model) const;
};

}  // namespace yoke
