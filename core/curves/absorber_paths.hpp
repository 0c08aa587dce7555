// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Paths of centrifugal pendulum absorbers (Denman, Tautochronic bifilar pendulum torsion absorbers
// for reciprocating engines, J. Sound and Vibration 159 (1992) 251-277). With s the length of the
// path from its vertex, R0 the distance of the vertex from the rotor's axis, phi the turn of the
// tangent:
//   radius of curvature  rho(s)^2 = rho0^2 - lambda^2 s^2,   rho = rho0 cos(lambda phi)
//   order for small swings  n = sqrt((R0 - rho0)/rho0), so rho0 = R0/(1 + n^2)
// lambda = 0 is a circle, 1 a cycloid, n/sqrt(n^2 + 1) the epicycloid on which, at constant speed of
// the rotor, the order is n at every amplitude: s'' = -n^2 Omega^2 s.
#pragma once

#include <yoke/core/curves/curve.hpp>

namespace yoke {

/// Where the path is, and which of the family.
struct AbsorberPath {
  Vec2 center{0.0, 0.0};   // [m] the rotor's axis, global, in the start pose
  double direction = 0.0;  // [rad] from the axis to the vertex, from the x axis
  double distance = 0.0;   // [m] R0 > 0
  double order = 0.0;      // n > 0
  double lambda = 0.0;     // 0 <= lambda <= 1
  double reach = 0.0;      // [m] of the path to each side of its vertex, > 0
};

/// Counter-clockwise about its centres of curvature; the vertex is at half its length. A circle is an
/// exact arc. Throws ModelError, also for a reach that goes beyond a full circle, or to 98 % of the
/// cusp at rho0/lambda.
Curve absorber_path(const AbsorberPath& path);

/// lambda of the tautochrone, n/sqrt(n^2 + 1).
double tautochronic_lambda(double order);

}  // namespace yoke
