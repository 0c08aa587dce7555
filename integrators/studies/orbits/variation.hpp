// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The derivative of a run by its start, by the variational equations, through events. A motion beside
// the run, which the joints allow, is
//   dq = N a        dv = N b + N' a        dz        y = (a, b, dz), 2 f + nz numbers
// with N, N' the basis of allowed motions and its rate of modes.hpp: N^T M N = 1, N^T M N' = 0, so
//   a = N^T M dq    b = N^T M dv
// At an event motions beside the run arrive earlier or later, and what contacts remember of it differs;
// both are in the derivative (docs/orbits.md).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include <yoke/integrators/simulate.hpp>

namespace yoke {

/// How the end of a run depends on its start.
struct FlowDerivative {
  Result run;   // as simulate() gives it; where it failed, the derivative is that up to there
  State start;  // on the constraints, with accelerations: what the derivative is by
  /// y at the end by y at the start [2 f + nz square]; behind it rows and columns of `memory`.
  Eigen::MatrixXd matrix;
  Eigen::MatrixXd start_basis, start_basis_rate;  // N, N' [n x f] that y at the start belongs to
  Eigen::MatrixXd end_basis, end_basis_rate;      // and at the end
  /// The same in full at the end: dq, dv [n x columns], dz [nz x columns].
  Eigen::MatrixXd dq, dv, dz;
  /// What contacts that touch at the start remember there, if the run depends on it:
  /// "slot.approach_velocity"; in SI units.
  std::vector<std::string> memory;
  Eigen::VectorXd memory_at_start, memory_at_end;  // their values
  int degrees_of_freedom = 0;                      // f
  double growth_of_volume =
      0.0;               // integral of the trace of y' by y, between events: ln det if none
  long jumps = 0;        // events at which memories, parameters or velocities changed
  long evaluations = 0;  // of the linear equations
  std::vector<std::string> notes;  // what was assumed, a sentence each
};

/// Runs `model` from `start` and carries the derivative along; the error is below that of the run, but
/// for differences of what events do, about 1e-9. Throws ModelError as simulate(), for a mechanism
/// without a motion of its own and for more than largest_linearisation coordinates and states. Where the
/// linear equations end (friction that holds, controllers that sample, a contact that is grazed) the
/// run ends as failed, and its reason says so.
FlowDerivative flow_derivative(const Model& model, const State& start,
                               const SimulationOptions& options);

}  // namespace yoke
