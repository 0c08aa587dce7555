// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The stabilised index-2 equations by BDF; ggl_matrix.hpp says what they are.
#include <yoke/integrators/formulations/equations/ggl_equations.hpp>
#include <yoke/integrators/formulations/ida.hpp>

namespace yoke {

std::unique_ptr<Formulation> make_ida_ggl(Dynamics& dynamics, const Tolerances& tolerances) {
  // What a step of order 1 leaves across the constraints, in a few bodies of a large mechanism, would
  // keep the order from rising again if those few were looked at alone (N-four-bar of 40 loops).
  return make_ida(dynamics, tolerances, std::make_unique<GglEquations>(dynamics.system()),
                  ErrorNorm::assemblies);
}

}  // namespace yoke
