// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The stabilised index-2 equations by BDF; ggl_matrix.hpp says what they are.
#include <yoke/integrators/formulations/equations/ggl_equations.hpp>
#include <yoke/integrators/formulations/ida.hpp>

namespace yoke {

std::unique_ptr<Formulation> make_ida_ggl(Dynamics& dynamics, const Tolerances& tolerances) {
  return make_ida(dynamics, tolerances, std::make_unique<GglEquations>(dynamics.system()));
}

}  // namespace yoke
