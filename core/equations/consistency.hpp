// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Whether dependent equations agree, to what rounding lets one say. A residual is compared with the
// sizes of the terms it is the sum of, so that the answer does not depend on units, on where the
// mechanism is, or on how slowly it moves. For set-up and reports; not a hot path.
#pragma once

#include <optional>
#include <vector>

#include <yoke/core/equations/rank.hpp>
#include <yoke/core/equations/system.hpp>
#include <yoke/core/state.hpp>

namespace yoke {

/// The largest term of any equation Phi at q, in length scales or rad: coordinates and lever arms.
/// For the blocks of G computed last.
double largest_position_term(const System& system, const double* q);

/// The right-hand sides of G v = -Phi_t or G a = gamma, and the sizes of the terms of each equation
/// [rows].
struct EquationTerms {
  std::vector<double> value;
  std::vector<double> size;
  /// The part of the size that is products of velocities, and the share of the velocities of a joint
  /// that violates it: where they are no more than what rounding has left of others, that is large
  /// and the products mean nothing. Empty: there are none.
  std::vector<double> products, noise;
};
/// Phi_t; terms Phi_t and G v. At the motion set, with the blocks of G computed last.
EquationTerms rate_terms(System& system, const Eigen::VectorXd& v);
/// gamma; terms G a and the products of velocities that gamma consists of.
EquationTerms acceleration_terms(System& system, const State& state);

/// A dependent row that the others contradict, and what is left of it if they hold.
struct Disagreement {
  int row = 0;
  double residual = 0.0;
};
/// Equations with G^T u = 0 agree if u^T (right-hand side) = 0. Beyond rounding means more than
/// 1e-8 of the terms, since rows count as dependent up to that.
std::optional<Disagreement> find_disagreement(const RankAnalysis& analysis,
                                              const EquationTerms& terms);

}  // namespace yoke
