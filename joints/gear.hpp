// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A gear pair: the rotations of a and b, seen from the carrier c, are proportional.
//
//   Phi = (theta_b - theta_c) - ratio (theta_a - theta_c) - start value = 0 [rad], row mesh
//   G   = a: -ratio,  b: 1,  c: ratio - 1  in the columns of the angles;  gamma = 0, H = 0, K = 0
//   torque on b = -lambda [N m], on a = ratio lambda, on c = (1 - ratio) lambda
//
// ratio = (omega_b - omega_c) / (omega_a - omega_c). With pitch radii r_a, r_b it is -r_a / r_b for
// external gears, which counter-rotate, and +r_a / r_b for a pinion in a ring or a belt. The joint
// holds rotations only; the bearings of the wheels are joints of their own, and the tooth force
// that presses on them is not modelled.
#pragma once

#include <memory>
#include <string>

#include <yoke/core/model.hpp>

namespace yoke {

struct Gear {
  std::string name;
  BodyId a;
  BodyId b;
  BodyId carrier = ground;  // any one of the three may be the ground
  double ratio = 0.0;       // must be given, not 0

  std::unique_ptr<Constraint> build(const Model& model) const;
};

}  // namespace yoke
