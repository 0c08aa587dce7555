// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// How an equilibrium moves while the loads, or one parameter, change slowly: snap-through, buckling.
// The path of (q, z, lambda, p) with Q(q, 0, z; p) - G^T lambda = 0, z' = 0, Phi(q) = 0 is followed
// by its arc length, so that it goes on where p turns back: a step along the tangent, then Newton's
// iteration in the plane across it (Riks; Keller, Lectures on Numerical Methods in Bifurcation
// Problems, 1987). The matrix of both, bordered by the tangent, is regular at limit points.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <yoke/core/model.hpp>
#include <yoke/core/result.hpp>

namespace yoke {

/// What is changed, from where to where, and in which steps.
struct EquilibriumPathOptions {
  /// "element.parameter": a changeable parameter; empty: the factor of the loads.
  std::string parameter{};
  double from = 0.0, to = 1.0;  // of the factor, or of the parameter in its unit
  double t = 0.0;               // [s] drivers and loads are frozen at this time
  /// The forces that the factor multiplies; empty: as EquilibriumOptions::loads.
  std::vector<std::string> loads{};
  /// Of a step, in rad, parts of to - from, and length scales of the model (or, if that is longer,
  /// the displacement from `from` to `to` at the rate of the start). (0, 1]
  double largest_step = 0.05;
  int points = 2000;           // at most
  bool allow_neutral = false;  // accept an equilibrium that leaves a motion free
};

/// What a point of the path is. At a limit point p turns back; at a branch point stability changes
/// though p goes on: other equilibria branch off, as where a perfect column buckles.
enum class PathPoint { regular, limit, branch };

/// A limit or branch point of a path.
struct CriticalPoint {
  PathPoint kind = PathPoint::limit;  // limit or branch
  double value = 0.0;                 // of the factor or parameter
  std::size_t row = 0;                // of EquilibriumPath::points
  State state;                        // at rest, with multipliers
};

struct EquilibriumPath {
  bool complete = false;  // `to` was reached
  std::string reason;     // one sentence
  /// One row a point: "load_factor" or the parameter, "point" and "stability" as text,
  /// "lowest_stiffness_per_s2" as Equilibrium::lowest_stiffness (nan: none), then the columns of
  /// simulate()'s samples: pose, reactions, contacts. Columns of energies leave out the work of the
  /// loads.
  Table points;
  std::vector<CriticalPoint> critical;  // limit and branch points in the order of the path
  State final;                          // at the last point
  long iterations = 0;                  // of Newton

  /// Column of the points: path["node.y_m"].
  Eigen::VectorXd operator[](std::string_view column) const { return points[column]; }
};

/// From the equilibrium at `from` that equilibrium() finds from the start pose of the model, or from
/// `start`. Limit points are located to rounding of the equations, branch points to 1e-9 of the
/// step; that needs the stiffness, which larger models than largest_linearisation are not asked for.
/// Where a contact begins or ends to press, the path has a corner, which is a point of its own. A
/// perfect path is followed through its branch points, not into a branch: for that add a
/// small imperfection. A path that does not get to `to` keeps its points and says why. Throws
/// ModelError for options out of range and as equilibrium().
EquilibriumPath equilibrium_path(const Model& model, const EquilibriumPathOptions& options = {});
EquilibriumPath equilibrium_path(const Model& model, const State& start,
                                 const EquilibriumPathOptions& options = {});

}  // namespace yoke
