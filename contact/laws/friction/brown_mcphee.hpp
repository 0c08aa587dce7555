// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Brown, P.; McPhee, J. A continuous velocity-based friction model for dynamics and control with
// physically meaningful parameters. J. Comput. Nonlinear Dyn. 2016, 11, 054502. With x = v/v_t:
//   T = N (mu tanh 4x + (mu_s - mu) x/(x^2/4 + 3/4)^2) + c v
// Smooth; the second term is 1 at x = 1, its greatest value. So the force is all but mu_s N there
// (tanh 4 = 0.9993).
#pragma once

#include <cmath>
#include <string>

#include <yoke/contact/laws/friction/sliding_curve.hpp>

namespace yoke {

struct BrownMcPhee {
  double mu = 0.0;          // [1] >= 0
  double mu_static = 0.0;   // [1] >= mu
  double threshold = 1e-3;  // [m/s] v_t > 0, where the friction is greatest
  double viscous = 0.0;     // [N s/m] c >= 0

  static constexpr FrictionField<BrownMcPhee> fields[] = {
      {"mu", "", &BrownMcPhee::mu},
      {"mu_static", "", &BrownMcPhee::mu_static},
      {"threshold", "m/s", &BrownMcPhee::threshold},
      {"viscous", "N s/m", &BrownMcPhee::viscous}};

  FrictionOutput operator()(const FrictionInput& in) const {
    const double x = in.sliding / threshold, s = std::tanh(4.0 * x);
    const double w = 0.25 * x * x + 0.75, peak = x / (w * w);
    const double peak_slope = (w - x * x) / (w * w * w);
    return friction_on_curve(
        in,
        {mu * s + (mu_static - mu) * peak,
         (4.0 * mu * (1.0 - s * s) + (mu_static - mu) * peak_slope) / threshold},
        viscous);
  }
  void check() const {
    const std::string owner = "friction '" + name() + "'";
    check_coefficients(owner, mu, mu_static);
    require_positive(owner, "threshold", threshold, "m/s");
    require_not_negative(owner, "viscous", viscous, "N s/m");
  }
  std::string name() const { return "brown-mcphee"; }
};

}  // namespace yoke
