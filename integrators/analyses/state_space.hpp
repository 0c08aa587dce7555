// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A mechanism as a control engineer wants it: about any state, at rest or in motion,
//   x' = A x + B u      x = (p, p', dz), see modes.hpp: a neighbouring motion is q + N p
//   y  = C x + D u
// with changes u of changeable parameters and changes y of columns of the samples.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include <yoke/integrators/analyses/modes.hpp>

namespace yoke {

struct StateSpace {
  Eigen::MatrixXd A;    // [s x s], s = 2 f + nz
  Eigen::MatrixXd B;    // [s x inputs]
  Eigen::MatrixXd C;    // [outputs x s]
  Eigen::MatrixXd D;    // [outputs x inputs]
  Linearisation about;  // with the basis N that p belongs to
};

/// About `state`, which is assembled first, contacts as they are. `inputs` are changeable parameters
/// ("motor.torque"), `outputs` columns of the samples ("slider.x_m", "hinge.fx_N"). A is exact; B, C
/// and D are central differences of forces and of outputs on the constraints, exact where these are
/// linear, else to about 1e-9 of their size. Throws ModelError for an unknown name, and as
/// linearise().
StateSpace state_space(const Model& model, const State& state,
                       const std::vector<std::string>& inputs,
                       const std::vector<std::string>& outputs);

}  // namespace yoke
