// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Threlfall, D.C. The inclusion of Coulomb friction in mechanisms programs with particular reference to
// DRAM. Mech. Mach. Theory 1978, 13, 475-483: T = mu N (1 - exp(-3 |v|/v_r)) sgn v up to v_r, constant
// above. The constant is the value reached, 0.9502 mu N; the law as it is often printed (0.95 mu N)
// jumps there by 2e-4.
#pragma once

#include <cmath>
#include <string>

#include <yoke/contact/laws/friction/sliding_curve.hpp>

namespace yoke {

struct Threlfall {
  double mu = 0.0;          // [1] >= 0
  double threshold = 1e-3;  // [m/s] v_r > 0

  static constexpr FrictionField<Threlfall> fields[] = {
      {"mu", "", &Threlfall::mu}, {"threshold", "m/s", &Threlfall::threshold}};

  FrictionOutput operator()(const FrictionInput& in) const {
    return friction_on_curve(in, odd_curve(in.sliding, [this](double v) -> FrictionCoefficient {
                               if (v >= threshold) return {mu * (1.0 - std::exp(-3.0)), 0.0};
                               const double rest = std::exp(-3.0 * v / threshold);
                               return {mu * (1.0 - rest), 3.0 * mu * rest / threshold};
                             }));
  }
  void check() const {
    const std::string owner = "friction '" + name() + "'";
    require_not_negative(owner, "mu", mu, "");
    require_positive(owner, "threshold", threshold, "m/s");
  }
  std::string name() const { return "threlfall"; }
};

}  // namespace yoke
