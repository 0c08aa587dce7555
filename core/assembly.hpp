// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A consistent state from any rough pose: positions, velocities, accelerations and multipliers.
#pragma once

#include <string>
#include <vector>

#include <yoke/core/model.hpp>
#include <yoke/core/state.hpp>

namespace yoke {

enum class Coordinate { x, y, angle };  ///< of a body: its centre of mass [m] and angle [rad]

/// One coordinate of a body with a value, or its rate.
struct CoordinateValue {
  std::string body;                           // its name
  Coordinate coordinate = Coordinate::angle;  // which one
  double value = 0.0;                         // [m, rad] or [m/s, rad/s]
};

/// Selects one of several assemblies: that in which the coordinate lies within `within` of the
/// value. Angles are compared without whole turns.
struct Near {
  std::string body;                           // its name
  Coordinate coordinate = Coordinate::angle;  // which one
  double value = 0.0;                         // [m, rad]
  double within = 0.0;  // [m, rad] > 0; 0: a quarter turn, or half the length scale
};

/// What assemble() is to keep, choose and prescribe.
struct AssemblyOptions {
  std::vector<CoordinateValue> hold{};   // exactly
  std::vector<Near> near{};              // selects the branch
  std::vector<CoordinateValue> rates{};  // velocities given; the others change least
  /// Weight of each body in "least change" instead of its mass; by name, others keep their mass.
  std::vector<std::pair<std::string, double>> weights{};
  int starts = 60;  // poses tried beyond the first, if that does not lead to an assembly
};

/// The consistent state nearest to the start pose of the model, or to `rough`, by damped
/// Gauss-Newton iteration. If it does not converge, or ends on another branch, it restarts from
/// other angles (the same in every call). Throws ModelError naming the joint, the equation and the
/// residual with its unit if no pose satisfies joints and `hold`, if none is found on the requested
/// branch, if the rates are impossible, or if equations are in conflict.
State assemble(const Model& model, const AssemblyOptions& options = {});
State assemble(const Model& model, const State& rough, const AssemblyOptions& options);

}  // namespace yoke
