// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// How the saddle system of explicit evaluations and projections is solved, by name.
#pragma once

#include <string>
#include <string_view>

namespace yoke {

enum class LinearSolver {
  automatic,  ///< blocks where they cost less than the saddle matrix
  klu,        ///< KLU on the saddle matrix
  range_klu,  ///< KLU in the range space of the constraints
  blocks      ///< elimination there by blocks, along the graph of the joints
};

/// Throws ModelError for an unknown name.
LinearSolver linear_solver_named(std::string_view name);
std::string_view name_of(LinearSolver solver);

}  // namespace yoke
