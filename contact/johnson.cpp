// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/johnson.hpp>

#include <algorithm>
#include <boost/math/special_functions/lambert_w.hpp>
#include <cmath>

#include <yoke/core/error.hpp>
#include <yoke/core/types.hpp>

namespace yoke {

namespace {
constexpr double euler = 2.71828182845904523536;

/// W_{-1}(-x) for 0 < x <= 1/e. Never throws: it runs inside an integrator's step.
double lower_branch(double x) {
  namespace policies = boost::math::policies;
  using Quiet = policies::policy<policies::domain_error<policies::ignore_error>,
                                 policies::overflow_error<policies::ignore_error>,
                                 policies::evaluation_error<policies::ignore_error>>;
  // Boost has no answer for denormal arguments, where W = -690 hardly changes and F is 1e-295 N.
  return boost::math::lambert_wm1(-std::clamp(x, 1e-300, 1.0 / euler), Quiet());
}
}  // namespace

ElasticResponse Johnson::operator()(double penetration) const {
  const double a = 1.0 / (pi * modulus * length);
  const double W = lower_branch(penetration / limit() / euler);  // d/(a B) = d/(e limit)
  const double force = -penetration / (a * W);
  return {force, -1.0 / (a * (1.0 + W)), a * force * force * (-0.5 * W - 0.25)};
}

double Johnson::limit() const { return 4.0 * radius_difference / (euler * euler); }

void Johnson::check() const {
  require_positive("law 'johnson'", "modulus", modulus, "Pa");
  require_positive("law 'johnson'", "radius_difference", radius_difference, "m");
  require_positive("law 'johnson'", "length", length, "m");
}

Johnson johnson(const RoundPair& pair, double length) {
  pair.check("johnson");
  const Johnson law{pair.modulus(), pair.radius_difference(), length};
  law.check();
  return law;
}

}  // namespace yoke
