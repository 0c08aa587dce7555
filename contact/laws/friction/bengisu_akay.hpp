// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Bengisu, M.T.; Akay, A. Stability of friction-induced vibrations in multi-degree-of-freedom systems.
// J. Sound Vib. 1994, 171, 557-570:
//   |v| < v_0   T = mu_s N (1 - (|v|/v_0 - 1)^2) sgn v       rises to the static friction at v_0
//   |v| > v_0   T = N (mu + (mu_s - mu) exp(-xi (|v| - v_0))) sgn v
#pragma once

#include <cmath>
#include <string>

#include <yoke/contact/laws/friction/sliding_curve.hpp>

namespace yoke {

struct BengisuAkay {
  double mu = 0.0;          // [1] >= 0
  double mu_static = 0.0;   // [1] >= mu
  double threshold = 1e-3;  // [m/s] v_0 > 0
  double decay = 10.0;      // [s/m] xi > 0

  static constexpr FrictionField<BengisuAkay> fields[] = {
      {"mu", "", &BengisuAkay::mu},
      {"mu_static", "", &BengisuAkay::mu_static},
      {"threshold", "m/s", &BengisuAkay::threshold},
      {"decay", "s/m", &BengisuAkay::decay}};

  FrictionOutput operator()(const FrictionInput& in) const {
    return friction_on_curve(
        in, odd_curve(in.sliding, [this](double v) -> FrictionCoefficient {
          const double x = v / threshold - 1.0;
          if (x < 0.0) return {mu_static * (1.0 - x * x), -2.0 * mu_static * x / threshold};
          const double more = (mu_static - mu) * std::exp(-decay * (v - threshold));
          return {mu + more, -decay * more};
        }));
  }
  void check() const {
    const std::string owner = "friction '" + name() + "'";
    check_coefficients(owner, mu, mu_static);
    require_positive(owner, "threshold", threshold, "m/s");
    require_positive(owner, "decay", decay, "s/m");
  }
  std::string name() const { return "bengisu-akay"; }
};

}  // namespace yoke
