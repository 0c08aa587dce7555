// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Dahl, P.R. A solid friction model. Aerospace Corporation, TOR-0158(3107-18)-1, 1968, with exponent 1:
//   z' = v - k |v| z/(mu N),  T = k z
// In presliding it is a spring that yields; its hysteresis does not depend on the speed.
#pragma once

#include <string>

#include <yoke/contact/laws/friction/bristles.hpp>

namespace yoke {

struct Dahl {
  double mu = 0.0;         // [1] > 0
  double stiffness = 1e5;  // [N/m] k > 0

  static constexpr FrictionField<Dahl> fields[] = {{"mu", "", &Dahl::mu},
                                                   {"stiffness", "N/m", &Dahl::stiffness}};

  FrictionOutput operator()(const FrictionInput& in) const {
    return friction_of_bristles(in, {.stiffness = stiffness}, {mu, 0.0}, mu);
  }
  double state_scale(double reference_force) const { return mu * reference_force / stiffness; }
  void check() const {
    const std::string owner = "friction '" + name() + "'";
    require_positive(owner, "mu", mu, "");
    require_positive(owner, "stiffness", stiffness, "N/m");
  }
  std::string name() const { return "dahl"; }
};

}  // namespace yoke
