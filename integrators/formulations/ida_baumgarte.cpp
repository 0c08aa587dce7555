// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The stabilised index-1 equations by BDF; baumgarte_equations.hpp says what they are.
#include <yoke/integrators/formulations/equations/baumgarte_equations.hpp>
#include <yoke/integrators/formulations/ida.hpp>

namespace yoke {

std::unique_ptr<Formulation> make_ida_baumgarte(Dynamics& dynamics, const Tolerances& tolerances) {
  // BDF bears more than an explicit method, and drifts more.
  const double rate =
      tolerances.baumgarte_rate > 0.0 ? tolerances.baumgarte_rate : 4.0 * tolerances.natural_rate;
  return make_ida(dynamics, tolerances,
                  std::make_unique<BaumgarteEquations>(dynamics.system(),
                                                       Baumgarte{.alpha = rate, .beta = rate}),
                  ErrorNorm::bodies);
}

}  // namespace yoke
