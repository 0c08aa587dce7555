// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The LuGre law: Canudas de Wit, C.; Olsson, H.; Astrom, K.J.; Lischinsky, P. A new model for control of
// systems with friction. IEEE Trans. Autom. Control 1995, 40, 419-425:
//   z' = v - sigma_0 |v| z/(N g(v)),  T = sigma_0 z + sigma_1 z' + sigma_2 v
//   g(v) = mu + (mu_s - mu) exp(-(v/v_s)^2)
// bristles.hpp says where sigma_1 fades, and why. Presliding is elastic with sigma_0; while it slides
// steadily T = N g(v) + sigma_2 v.
#pragma once

#include <cmath>
#include <string>

#include <yoke/contact/laws/friction/bristles.hpp>

namespace yoke {

struct LuGre {
  double mu = 0.0;                  // [1] > 0
  double mu_static = 0.0;           // [1] >= mu
  double stribeck_velocity = 1e-2;  // [m/s] v_s > 0
  double stiffness = 1e5;           // [N/m] sigma_0 > 0
  double damping = 0.0;             // [N s/m] sigma_1 >= 0
  double viscous = 0.0;             // [N s/m] sigma_2 >= 0

  static constexpr FrictionField<LuGre> fields[] = {
      {"mu", "", &LuGre::mu},
      {"mu_static", "", &LuGre::mu_static},
      {"stribeck_velocity", "m/s", &LuGre::stribeck_velocity},
      {"stiffness", "N/m", &LuGre::stiffness},
      {"damping", "N s/m", &LuGre::damping},
      {"viscous", "N s/m", &LuGre::viscous}};

  FrictionOutput operator()(const FrictionInput& in) const {
    const double x = in.sliding / stribeck_velocity;
    const double more = (mu_static - mu) * std::exp(-x * x);
    return friction_of_bristles(in, {stiffness, damping, viscous},
                                {mu + more, -2.0 * x * more / stribeck_velocity}, mu);
  }
  double state_scale(double reference_force) const { return mu * reference_force / stiffness; }
  void check() const {
    const std::string owner = "friction '" + name() + "'";
    require_positive(owner, "mu", mu, "");
    check_coefficients(owner, mu, mu_static);
    require_positive(owner, "stribeck_velocity", stribeck_velocity, "m/s");
    require_positive(owner, "stiffness", stiffness, "N/m");
    require_not_negative(owner, "damping", damping, "N s/m");
    require_not_negative(owner, "viscous", viscous, "N s/m");
  }
  std::string name() const { return "lugre"; }
};

}  // namespace yoke
