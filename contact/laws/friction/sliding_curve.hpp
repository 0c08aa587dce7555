// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the friction laws without a state share: T = N mu(v) + c v, with an odd curve mu(v) and a
// viscous part c. They creep: a load below the friction limit moves the surfaces on, however slowly.
// Only coulomb's law itself and the laws with bristles hold still.
#pragma once

#include <cmath>
#include <string>

#include <yoke/core/error.hpp>
#include <yoke/core/friction_law.hpp>

namespace yoke {

/// A parameter of a law, as `yoke run --friction` takes it.
template <class Law>
using FrictionField = LawField<Law>;

/// A coefficient of friction and its derivative by the sliding velocity.
struct FrictionCoefficient {
  double value = 0.0;  // [1]
  double slope = 0.0;  // [s/m]
};

/// T = N mu(v) + viscous v; all of its power is dissipated.
inline FrictionOutput friction_on_curve(const FrictionInput& in, const FrictionCoefficient& mu,
                                        double viscous = 0.0) {
  const double force = in.normal_force * mu.value + viscous * in.sliding;
  return {.force = force,
          .dforce_dnormal = mu.value,
          .dforce_dsliding = in.normal_force * mu.slope + viscous,
          .dissipated_power = force * in.sliding};
}

/// An odd curve from its half for v >= 0: `half(|v|)` gives value and slope there.
template <class Half>
FrictionCoefficient odd_curve(double sliding, const Half& half) {
  FrictionCoefficient mu = half(std::abs(sliding));
  if (sliding < 0.0) mu.value = -mu.value;
  return mu;
}

/// Checks 0 <= mu <= mu_static; `owner` is "friction 'stribeck'". Throws ModelError.
inline void check_coefficients(const std::string& owner, double mu, double mu_static) {
  require_not_negative(owner, "mu", mu, "");
  require_not_negative(owner, "mu_static", mu_static, "");
  if (mu_static < mu)
    throw ModelError(
        fmt::format("{}: mu_static = {:g} must be at least mu = {:g}", owner, mu_static, mu));
}

}  // namespace yoke
