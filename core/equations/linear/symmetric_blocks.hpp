// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Symmetric positive definite matrices made of blocks of 2 x 2, and what factorises them: along the graph of
// the blocks (block_elimination.hpp), or KLU.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <yoke/core/equations/linear/sparse.hpp>

namespace yoke {

/// Which blocks below the diagonal there are, column by column.
struct BlockPattern {
  std::vector<int> start{0};  // [columns + 1] of each column in `row`
  std::vector<int> row;       // of the blocks below the diagonal, ascending
  int columns() const { return static_cast<int>(start.size()) - 1; }
  /// Place of a block below the diagonal, or of a diagonal one: those of a column follow its diagonal.
  int place(int below, int left) const;
};

/// What solves with such a matrix. The blocks are written at their places, by rows, then factorised.
class SymmetricFactors {
 public:
  virtual ~SymmetricFactors() = default;
  virtual const BlockPattern& pattern() const = 0;
  virtual double* values() = 0;  ///< [4 (columns + blocks below the diagonal)]
  /// False where a pivot falls below `least` of what its diagonal element was, or is not a number.
  virtual bool factorise(double least) = 0;
  /// Of the last factorise(): the smallest pivot in parts of its diagonal element.
  virtual double smallest_pivot() const = 0;
  virtual void solve(double* x) = 0;  ///< [2 columns] in place
  virtual void reset() {}             ///< equal inputs give equal bits from here
};

/// The same matrix for KLU, which chooses its own order of elimination. Its reciprocal condition stands for
/// the smallest pivot.
class BlockKlu final : public SymmetricFactors {
 public:
  BlockKlu(int columns, std::vector<std::pair<int, int>> pairs);
  const BlockPattern& pattern() const override { return pattern_; }
  double* values() override { return value_.data(); }
  bool factorise(double least) override;
  double smallest_pivot() const override { return lu_->reciprocal_condition(); }
  void solve(double* x) override { lu_->solve(x); }
  void reset() override { lu_->reset(); }

 private:
  BlockPattern pattern_;
  std::vector<double> value_;
  SparseMatrix matrix_;
  std::vector<int> slot_;  // of each element of values(): below the diagonal, then its mirror image
  std::unique_ptr<SparseLU> lu_;
};

/// The pattern of these pairs of different columns, without fill; a pair may be named twice.
BlockPattern pattern_of(int columns, std::vector<std::pair<int, int>> pairs);

}  // namespace yoke
