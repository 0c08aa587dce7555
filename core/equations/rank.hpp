// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Which constraint equations depend on the others, and how. For set-up and reports; not a hot path.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include <yoke/core/equations/system.hpp>

namespace yoke {

/// Rank of G by a sparse rank-revealing QR of G^T, lengths in units of the length scale and every
/// equation normalised to one. An equation counts as dependent when less than 1e-8 of it is its
/// own.
struct RankAnalysis {
  int rank = 0;
  /// Rows to be left out so that the others are independent: those added later, unless what is then
  /// left were badly conditioned: an equation less than a tenth its own is left out first, if the
  /// rank allows, and instead of one that makes the others ten times as independent. Latest first.
  std::vector<int> dependent;
  /// Columns u [rows] with G^T u = 0, one for each dependent row, the largest entry (in the
  /// normalised equations) 1. A row with a zero in all of them has a unique multiplier.
  Eigen::SparseMatrix<double> null_space;
};

/// For the blocks of G computed last. Rows marked in `ignored` [rows] (or none) are left out of
/// account.
RankAnalysis analyse_rank(const System& system, const std::vector<char>& ignored = {});

/// Vectors w with A w = 0, one for each column that depends on earlier ones: less than `threshold`
/// of it is its own. [columns x vectors], by the same QR.
Eigen::MatrixXd null_vectors(const Eigen::SparseMatrix<double>& a, double threshold);

}  // namespace yoke
