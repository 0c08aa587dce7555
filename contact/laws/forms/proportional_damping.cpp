// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/forms/proportional_damping.hpp>

#include <cmath>

namespace yoke {

namespace {

/// [ln((1 + X)/(1 - e X)) - X (1 + e)]/X^2, which grows with e and, where it vanishes, with X. For
/// small X by its series, sum over k >= 2 of -(-X)^(k-2) (1 - (-e)^k)/k, for the logarithms cancel.
double excess(double X, double e) {
  if (X > 0.25) return (std::log1p(X) - std::log1p(-e * X) - X * (1.0 + e)) / (X * X);
  double sum = -0.5 * (1.0 - e) * (1.0 + e), power = 1.0, e_power = e * e;
  for (int k = 3; k < 32; ++k) {
    power *= -X;
    e_power *= -e;
    sum -= power * (1.0 - e_power) / k;
  }
  return sum;
}

/// Where `positive` begins to hold between low and high, to the last bit.
template <class Condition>
double bisect(double low, double high, Condition positive) {
  while (true) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) return middle;
    (positive(middle) ? high : low) = middle;
  }
}

}  // namespace

double restitution_of_damping(double X) {
  require_not_negative("proportional damping", "X", X, "");
  if (X == 0.0) return 1.0;
  return bisect(0.0, X > 1.0 ? 1.0 / X : 1.0,
                [X](double e) { return e * X >= 1.0 || excess(X, e) > 0.0; });
}

double damping_for_restitution(double e) {
  require_range("proportional damping", "e", e, least_restitution, 1.0);
  if (e == 1.0) return 0.0;
  return bisect(0.0, 1.0 / e, [e](double X) { return e * X >= 1.0 || excess(X, e) > 0.0; });
}

}  // namespace yoke
