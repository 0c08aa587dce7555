// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The angle of a body is a function of time.
//
//   Phi = theta - theta_R - f(t) = 0 [rad], row angle;   R = relative_to, theta_R = 0 on the ground
//   G = [ 0 0 -1  0 0 1 ] for (R, body);  Phi_t = -f';  gamma = f'';  H = 0;  K = 0
//   torque on the body = -lambda [N m], the opposite on R; the drive supplies -lambda f' [W]
//
// f is the angle of the body itself (Body::pose.angle), not what was turned since the start, and it
// counts turns: a body that starts at 31 deg is driven by constant_speed(31.0_deg, ...).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <yoke/core/model.hpp>
#include <yoke/core/time_function.hpp>

namespace yoke {

struct AngleDriver {
  std::string name;
  BodyId body;
  BodyId relative_to = ground;  // from whose angle it is counted
  TimeFunction angle{};         // f [rad]
  /// [rad/s] The speed of a motion that is added to f, or alone if there is none, then from the start pose
  /// on: the changeable parameters "name.speed" and "name.acceleration" (0 at first). Setting the speed
  /// is a blow, setting the acceleration is none; what is driven goes on from where it is.
  std::optional<double> speed{};

  std::unique_ptr<Constraint> build(const Model& model) const;
};

}  // namespace yoke
