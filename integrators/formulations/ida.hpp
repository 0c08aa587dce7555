// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// BDF of variable order and step (SUNDIALS IDAS) for any DaeEquations.
#pragma once

#include <memory>

#include <yoke/integrators/formulations/equations/dae_equations.hpp>
#include <yoke/integrators/formulations/formulation.hpp>

namespace yoke {

/// The formulation that integrates them by BDF.
std::unique_ptr<Formulation> make_ida(Dynamics& dynamics, const Tolerances& tolerances,
                                      std::unique_ptr<DaeEquations> equations);

}  // namespace yoke
