// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The power law K d^n nearest to a law over a range of loads, as Machines 2022, 10, 966 fits its
// Tables 2 to 9: unweighted least squares of the force,
//   min over K, n of  sum_i (K d(F_i)^n - F_i)^2
//   F_i = min_load + i (max_load - min_load)/(samples - 1),  i = 0, 1, ... samples - 1
// Least squares of the force do not bound the relative error: it grows without bound (to 100 %) as
// the load goes to zero, because no power law has the logarithm in it.
#pragma once

#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/law.hpp>

namespace yoke {

struct PowerFit {
  double K = 0.0, n = 1.0;           // K in N/m^n
  double max_error = 0.0;            // |K d^n/F - 1|, largest over the samples (without F = 0)
  double rms_error = 0.0;            // root of the mean square of the same
  double error_at_small_load = 0.0;  // signed K d^n/F - 1 at a thousandth of the largest load
  double max_load = 0.0;             // [N]
  double min_load = 0.0;             // [N]
  int samples = 0;                   // how many forces were fitted

  /// The fit as an elastic law.
  PowerLaw law() const { return {K, n, "power-law"}; }
};

/// `max_load` [N] must be one the law reaches, 0 <= `min_load` < `max_load`, `samples` at least 3.
/// Throws ModelError.
PowerFit fit_power_law(const ElasticLaw& law, double max_load, int samples = 10001,
                       double min_load = 0.0);

}  // namespace yoke
