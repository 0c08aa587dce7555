// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// BDF of variable order and step (SUNDIALS IDAS) for any DaeEquations.
#pragma once

#include <memory>

#include <yoke/integrators/formulations/equations/dae_equations.hpp>
#include <yoke/integrators/formulations/formulation.hpp>

namespace yoke {

/// Whose error a step is judged by: the worst body, or the worst of the assemblies of bodies that
/// joints tie together, each by the root mean square of its bodies.
enum class ErrorNorm { bodies, assemblies };

/// The formulation that integrates them by BDF.
std::unique_ptr<Formulation> make_ida(Dynamics& dynamics, const Tolerances& tolerances,
                                      std::unique_ptr<DaeEquations> equations, ErrorNorm norm);

}  // namespace yoke
