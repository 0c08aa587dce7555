// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A torsion spring and a rotational damper in parallel between a and b.
//
//   phi = theta_b - theta_a [rad], counting turns
//   T   = k (phi - phi_0) + c phi' [N m];   torque on b = -T, on a = +T
//   V   = k (phi - phi_0)^2 / 2 [J];        dissipated power = c phi'^2 [W]
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <yoke/core/model.hpp>

namespace yoke {

struct TorsionalSpring {
  std::string name;
  BodyId a;  // either may be the ground
  BodyId b;
  // Changeable parameters, "name.stiffness" and so on:
  double stiffness = 0.0;              // [N m/rad] k >= 0
  double damping = 0.0;                // [N m s/rad] c >= 0
  std::optional<double> free_angle{};  // [rad] phi_0; default: relaxed in the start pose

  std::unique_ptr<ForceElement> build(const Model& model) const;
};

}  // namespace yoke
