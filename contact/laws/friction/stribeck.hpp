// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Stribeck's curve, rounded off at zero:
//   T = N (mu + (mu_s - mu) exp(-(|v|/v_s)^delta)) tanh(v/v_t) + c v
// after Bo, L.C.; Pavelescu, D. The friction-speed relation and its influence on the critical velocity
// of stick-slip motion. Wear 1982, 82, 277-289 (delta = 1/2 to 1; 2 is Gauss' curve of Armstrong). The
// tanh as in regularised_coulomb.hpp.
#pragma once

#include <cmath>
#include <string>

#include <yoke/contact/laws/friction/sliding_curve.hpp>

namespace yoke {

struct Stribeck {
  double mu = 0.0;                 // [1] >= 0
  double mu_static = 0.0;          // [1] >= mu
  double stribeck_velocity = 0.1;  // [m/s] v_s > 0
  double exponent = 2.0;           // [1] delta >= 1
  double threshold = 1e-3;         // [m/s] v_t > 0
  double viscous = 0.0;            // [N s/m] c >= 0

  static constexpr FrictionField<Stribeck> fields[] = {
      {"mu", "", &Stribeck::mu},
      {"mu_static", "", &Stribeck::mu_static},
      {"stribeck_velocity", "m/s", &Stribeck::stribeck_velocity},
      {"exponent", "", &Stribeck::exponent},
      {"threshold", "m/s", &Stribeck::threshold},
      {"viscous", "N s/m", &Stribeck::viscous}};

  FrictionOutput operator()(const FrictionInput& in) const {
    return friction_on_curve(
        in,
        odd_curve(in.sliding,
                  [this](double v) -> FrictionCoefficient {
                    const double x = v / stribeck_velocity, s = std::tanh(v / threshold);
                    const double p = std::pow(x, exponent - 1.0);
                    const double more = (mu_static - mu) * std::exp(-p * x);
                    const double curve = mu + more;
                    const double fall = -exponent * p * more / stribeck_velocity;
                    return {curve * s, fall * s + curve * (1.0 - s * s) / threshold};
                  }),
        viscous);
  }
  void check() const {
    const std::string owner = "friction '" + name() + "'";
    check_coefficients(owner, mu, mu_static);
    require_positive(owner, "stribeck_velocity", stribeck_velocity, "m/s");
    require_range(owner, "exponent", exponent, 1.0, 10.0, "");
    require_positive(owner, "threshold", threshold, "m/s");
    require_not_negative(owner, "viscous", viscous, "N s/m");
  }
  std::string name() const { return "stribeck"; }
};

}  // namespace yoke
