// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The explicit Runge-Kutta methods there are: pairs of a solution and a less accurate one that judges it.
#pragma once

#include <span>

struct ARKodeButcherTableMem;  // of SUNDIALS

namespace yoke {

/// Order 5(4) of Dormand and Prince (J. Comput. Appl. Math. 6 (1980) 19), 7(6) of Verner, the "most
/// efficient" one of its kind (Numer. Algorithms 53 (2010) 383).
struct ExplicitPair {
  int order;                           ///< of the solution; that of its judge is one less
  const ARKodeButcherTableMem* table;  ///< coefficients
  int stages;                          ///< that the solution needs
  bool first_same_as_last;             ///< is the last stage the first of the next step?
  double stable;                       ///< what a step times a rate of decay may be
  /// Evaluations in a step behind which the solution is moved, by a projection, or not.
  int evaluations(bool moved) const;
};

/// From the lowest order to the highest.
std::span<const ExplicitPair> explicit_pairs();
/// The one of an order, which there must be.
const ExplicitPair& explicit_pair(int order);

}  // namespace yoke
