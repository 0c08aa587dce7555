// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The way down to rest: steps along the joints that each let the forces do positive work, so that
// with conservative forces the potential energy falls at every step. Near rest they are Newton's,
// elsewhere a multiple of the masses is added to the stiffness until the step is downhill and as
// short as is allowed: a trust region in the metric of the masses (Levenberg, Marquardt), which
// follows directions of negative curvature too. Where the energy is bounded below and does not fall
// for ever along a valley, that ends at rest.
#pragma once

#include <functional>

#include <yoke/integrators/analyses/details/rest_equations.hpp>

namespace yoke {

enum class DescentEnd { at_rest, lost, stuck };

/// From x, which is moved. `settle` tries Newton's iteration from close to rest and says whether it
/// has found it nearby.
DescentEnd descend(Statics& statics, Eigen::VectorXd& x, long& iterations,
                   const std::function<bool(Eigen::VectorXd&)>& settle);

}  // namespace yoke
