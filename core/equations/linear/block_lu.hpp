// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// L U of a matrix made of blocks of 2 x 2 that has the pattern of a symmetric one and other values on either side
// of the diagonal: the linearised equations of forces that depend on reactions. Eliminated in the order and
// with the fill of its symmetric twin (block_elimination.hpp), which must outlive it.
#pragma once

#include <vector>

#include <yoke/core/equations/linear/block_elimination.hpp>

namespace yoke {

class BlockLu {
 public:
  explicit BlockLu(const BlockElimination& twin);
  /// Blocks on and below the diagonal at the places of the twin, by rows.
  double* lower() { return lower_.data(); }
  /// Blocks above the diagonal at the places of their mirror images, by rows of their own.
  double* upper() { return upper_.data(); }
  /// False where a pivot falls below `least` of what its diagonal element was, changes its sign, or is not a
  /// number: then rows would have to be exchanged.
  bool factorise(double least);
  void solve(double* x) const;  ///< [2 columns] in place

 private:
  const BlockElimination& twin_;
  std::vector<double> lower_, upper_;  // after factorise() the inverse of each pivot in its place
  std::vector<double> diagonal_;       // [2 columns] elements before elimination
  std::vector<double> factor_;         // of the column that is eliminated
};

}  // namespace yoke
