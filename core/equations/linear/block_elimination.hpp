// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// L D L^T of a symmetric positive definite matrix made of blocks of 2 x 2, in an order of elimination chosen
// once: in linear time along a tree (D. Baraff, Linear-time dynamics using Lagrange multipliers, SIGGRAPH
// 1996), with blocks of fill where loops close.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <yoke/core/equations/linear/symmetric_blocks.hpp>

namespace yoke {

/// x [2 columns] becomes L^-1 x, with inverses of the pivots applied: column by column, each the inverse of its pivot and
/// the blocks below it. What follows the last block of `D`.
const double* substitute_forward(const BlockPattern& pattern, const double* D, double* x);

class BlockElimination final : public SymmetricFactors {
 public:
  /// Columns are eliminated in their order.
  static std::unique_ptr<BlockElimination> make(int columns,
                                                std::vector<std::pair<int, int>> pairs);
  const BlockPattern& pattern() const override { return pattern_; }
  double* values() override { return value_.data(); }
  bool factorise(double least) override;
  double smallest_pivot() const override { return smallest_; }
  void solve(double* x) override;
  /// 4 x places of what the columns change, one after the other: for each of n blocks below the diagonal those of
  /// (0,0) (1,0) ... (n-1,n-1).
  std::span<const int> updates() const { return update_; }

 private:
  BlockElimination() = default;
  bool invert_pivot(int column, double* D, double least);

  BlockPattern pattern_;  // with the fill
  std::vector<int> update_;
  std::vector<double>
      value_;  // after factorise() the inverse of each pivot in the place of the diagonal
  std::vector<double> diagonal_;  // [2 columns] elements before elimination
  double smallest_ = 1.0;
};

}  // namespace yoke
