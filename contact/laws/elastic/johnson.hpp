// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Johnson's law of two parallel cylinders, a logarithmic law (logarithmic_law.hpp):
//   d = a F [ln(4 pi E* DR L/F) - 1] = a F ln(B/F),   a = 1/(pi E* L),   B = 4 pi E* DR L/e.
// E* [Pa] composite modulus, DR [m] difference of the radii (their sum in an external contact), L
// [m] length. It ends where dF/dd becomes infinite, at d = a B/e = 4 DR/e^2, F = B/e. Small-strain
// theory needs the half-width of contact, sqrt(4 F R/(pi E* L)), to be far below the radii and so
// ends much earlier. The three readings are one: it is dimensionally right as printed, and Tables
// 4, 5 and 11 were made with it. K. L. Johnson, Contact Mechanics, 1985; Machines 2022, 10, 966,
// Table 1.
#pragma once

#include <string>

#include <yoke/contact/laws/elastic/logarithmic_law.hpp>
#include <yoke/contact/laws/material.hpp>

namespace yoke {

struct Johnson {
  /// All > 0, in the units below. Throws ModelError.
  Johnson(double composite_modulus, double difference, double contact_length);

  ElasticResponse operator()(double penetration) const { return law(penetration); }
  double limit() const { return law.limit(); }  ///< [m] 4 DR/e^2 = 0.541 DR
  std::string name() const { return "johnson"; }

  const double modulus;            // [Pa] composite E*
  const double radius_difference;  // [m] DR: the sum of the radii in an external contact
  const double length;             // [m] of the line of contact
  const LogarithmicLaw law;        // with a and B of this pair
};

/// Johnson's law for a pin on a wall along `length` [m]. Throws ModelError.
Johnson johnson(const RoundPair& pair, double length);

}  // namespace yoke
