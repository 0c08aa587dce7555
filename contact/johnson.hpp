// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Johnson's law of two parallel cylinders, evaluated exactly. It is given as penetration of force,
//   d = a F [ln(4 pi E* DR L / F) - 1] = a F ln(B/F),   a = 1/(pi E* L),   B = 4 pi E* DR L / e,
// and inverted by the lower branch W of Lambert's function, W = W_{-1}(-d/(a B)) <= -1:
//   F = -d/(a W),   dF/dd = -1/(a (1 + W)),   U = a F^2 (-W/2 - 1/4).
// It ends where dF/dd becomes infinite (W = -1): d = 4 DR/e^2, F = B/e. Small-strain theory needs
// the half-width of contact, sqrt(4 F R/(pi E* L)), to be far below the radii and so ends much
// earlier. K. L. Johnson, Contact Mechanics, 1985; Machines 2022, 10, 966, Table 1.
#pragma once

#include <string>

#include <yoke/contact/law.hpp>
#include <yoke/contact/material.hpp>

namespace yoke {

struct Johnson {
  double modulus = 0.0;            // [Pa] composite E*, > 0
  double radius_difference = 0.0;  // [m] DR, > 0: the sum of the radii in an external contact
  double length = 0.0;             // [m] of the line of contact, > 0

  ElasticResponse operator()(double penetration) const;
  double limit() const;  ///< [m] 4 DR/e^2 = 0.541 DR
  std::string name() const { return "johnson"; }
  void check() const;
};

/// Johnson's law for a pin on a wall along `length` [m]. Throws ModelError.
Johnson johnson(const RoundPair& pair, double length);

}  // namespace yoke
