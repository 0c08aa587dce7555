// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Laws that take radii, along a wall whose radius changes. From a function that gives the exact law
// for each curvature k of the wall, one law F(d, k), U(d, k) is made that follows k smoothly:
// Chebyshev interpolation between exact laws at n curvatures k_j, at the same penetration d or, for laws
// that end at L_j, at the same share x of it:
//   ln L = sum_j w_j(k) ln L_j,   x = d/L   (L = L_j = 1 for laws without end)
//   F = sum_j w_j(k) F_j(x L_j),   U = L sum_j w_j(k) U_j(x L_j)/L_j,
// so that F = dU/dd holds exactly, whatever the error of the interpolation, and the derivatives by k
// follow from those of the w_j. It is done in k, in the logarithm of the relative curvature 1/r + k, or in
// that of the difference of the radii |1/k| +- r, whichever needs fewest laws.
#pragma once

#include <functional>

#include <yoke/contact/laws/law.hpp>

namespace yoke {

/// What a graded law must cover.
struct GradedRange {
  double low = 0.0, high = 0.0;    // [1/m] curvatures of the wall, low < high, > 0 convex
  double disc_radius = 0.0;        // [m] r >= 0 of what touches it
  double reference_force = 100.0;  // [N] forces from 1e-4 to 1e4 of it are checked
};

/// Beyond the range it is that of the nearest end; steps of an integrator look there. Its limit is the
/// smallest of any curvature's. Throws ModelError, whose message begins with the owner, where at most
/// 32 laws do not reach a relative error of 1e-11 of force and energy: where the function is not
/// smooth in the curvature.
ElasticLaw graded_law(const std::string& owner,
                      const std::function<ElasticLaw(double curvature)>& law_at,
                      const GradedRange& range);

}  // namespace yoke
