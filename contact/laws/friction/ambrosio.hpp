// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Ambrosio's modified Coulomb law: T = c_d mu N sgn v with c_d = 0 for |v| <= v_0, 1 for |v| >= v_1 and
// (|v| - v_0)/(v_1 - v_0) between (Ambrosio, J. Impact of rigid and flexible multibody systems:
// deformation description and contact models. Virtual Nonlinear Multibody Systems, 2003, 57-81).
// Without force below v_0, so what should stick drifts there freely.
#pragma once

#include <string>

#include <yoke/contact/laws/friction/sliding_curve.hpp>

namespace yoke {

struct Ambrosio {
  double mu = 0.0;          // [1] >= 0
  double dead = 1e-4;       // [m/s] v_0 >= 0
  double threshold = 1e-3;  // [m/s] v_1 > v_0

  static constexpr FrictionField<Ambrosio> fields[] = {{"mu", "", &Ambrosio::mu},
                                                       {"dead", "m/s", &Ambrosio::dead},
                                                       {"threshold", "m/s", &Ambrosio::threshold}};

  FrictionOutput operator()(const FrictionInput& in) const {
    return friction_on_curve(in, odd_curve(in.sliding, [this](double v) -> FrictionCoefficient {
                               if (v <= dead) return {};
                               if (v >= threshold) return {mu, 0.0};
                               const double slope = mu / (threshold - dead);
                               return {slope * (v - dead), slope};
                             }));
  }
  void check() const {
    const std::string owner = "friction '" + name() + "'";
    require_not_negative(owner, "mu", mu, "");
    require_not_negative(owner, "dead", dead, "m/s");
    require_positive(owner, "threshold", threshold, "m/s");
    if (!(threshold > dead))
      throw ModelError(fmt::format("{}: threshold = {:g} m/s must be greater than dead = {:g} m/s",
                                   owner, threshold, dead));
  }
  std::string name() const { return "ambrosio"; }
};

}  // namespace yoke
