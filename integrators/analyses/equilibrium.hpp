// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Static equilibrium: Q(q, 0, z, t) - G^T lambda = 0, z' = 0, Phi(q, t) = 0. Newton's iteration
// with line search (KINSOL) with exact derivatives; contacts act where they penetrate. If that
// fails, the loads are applied gradually. If that fails too, or all that is found is unstable and
// away from the start, the mechanism follows its forces without inertia, downhill along its joints,
// until it comes to rest: where the potential energy is bounded below that ends at an equilibrium.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <yoke/core/model.hpp>
#include <yoke/core/result.hpp>

namespace yoke {

/// Which loads act, and how far they are followed.
struct EquilibriumOptions {
  double t = 0.0;  // [s] drivers and loads are frozen at this time
  /// The forces that are applied gradually; empty: gravity and applied loads, that is, all that
  /// supply work or do not depend on the motion.
  std::vector<std::string> loads{};
  double load_factor = 1.0;    // the loads act multiplied by it
  int load_steps = 200;        // at most
  bool allow_neutral = false;  // accept an equilibrium that leaves a motion free
};

/// How the equilibrium was found.
enum class EquilibriumRoute { direct, load_steps, relaxation };

struct Equilibrium {
  bool found = false;  // else see `reason`
  std::string reason;  // one sentence
  State state;         // at rest, with multipliers; a run can start from it
  Table row;           // one row under the names of simulate()'s samples, reactions included
  EquilibriumRoute route = EquilibriumRoute::direct;  // how it was found
  int load_steps = 0;                                 // that were made
  long iterations = 0;                                // of Newton
  double load = 0.0;                                  // share of the loads reached, 1 if found
  std::string worst;                  // the body or equation with the largest residual
  double residual = 0.0;              // its residual in `unit`
  std::string unit;                   // N, N m, m, rad, or 1/s of a state z
  std::vector<std::string> touching;  // contacts with a force
  /// Smallest eigenvalue of the constrained tangent stiffness in the metric of the masses [1/s^2]:
  /// > 0 stable, then the square of the lowest natural frequency if nothing else moves; none for a
  /// model that cannot move or one larger than largest_linearisation.
  std::optional<double> lowest_stiffness;
  /// No negative stiffness. An unstable equilibrium is the answer only if the start stands on it
  /// (within 0.05 length scales or rad), or if no other is found.
  bool stable = true;
  bool neutral = false;  // a motion without stiffness is left

  /// A number by its column: equilibrium["pivot.fx_N"]. Throws ModelError.
  double operator[](std::string_view column) const { return row.value(0, row.index(column)); }
};

/// From the start pose of the model, or from `start`. `found` and `reason` report a failure.
/// Throws ModelError for options out of range, a start that cannot be assembled, and, unless
/// allow_neutral, for a body that nothing holds, by its name.
Equilibrium equilibrium(const Model& model, const EquilibriumOptions& options = {});
Equilibrium equilibrium(const Model& model, const State& start,
                        const EquilibriumOptions& options = {});

}  // namespace yoke
