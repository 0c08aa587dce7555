// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Coulomb friction with its jump rounded off: T = mu N tanh(v/v_t). 76 % of the full force at the
// threshold v_t, all but 1e-4 at 5 v_t. Widely used; the tanh as in Andersson, S.; Soderberg, A.;
// Bjorklund, S. Tribol. Int. 2007, 40, 580-587.
#pragma once

#include <cmath>
#include <string>

#include <yoke/contact/laws/friction/sliding_curve.hpp>

namespace yoke {

struct RegularisedCoulomb {
  double mu = 0.0;          // [1] >= 0
  double threshold = 1e-3;  // [m/s] v_t > 0

  static constexpr FrictionField<RegularisedCoulomb> fields[] = {
      {"mu", "", &RegularisedCoulomb::mu}, {"threshold", "m/s", &RegularisedCoulomb::threshold}};

  FrictionOutput operator()(const FrictionInput& in) const {
    const double s = std::tanh(in.sliding / threshold);
    return friction_on_curve(in, {mu * s, mu * (1.0 - s * s) / threshold});
  }
  void check() const {
    const std::string owner = "friction '" + name() + "'";
    require_not_negative(owner, "mu", mu, "");
    require_positive(owner, "threshold", threshold, "m/s");
  }
  std::string name() const { return "regularised-coulomb"; }
};

}  // namespace yoke
