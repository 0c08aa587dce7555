// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Square sparse matrices with a fixed pattern and their LU factorisation by KLU. As in a circuit
// simulator, elements are handed positions ("slots") in one value array at set-up and only write
// numbers there afterwards.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace yoke {

/// Compressed sparse columns. `value` has one entry more than the pattern: what is written there
/// (rows or columns of the ground) is thrown away without a branch.
struct SparseMatrix {
  int size = 0;
  std::vector<int> column_start;  // [size + 1]
  std::vector<int> row;           // [nnz]
  std::vector<double> value;      // [nnz + 1]

  int nonzeros() const { return static_cast<int>(row.size()); }
  int discard_slot() const { return nonzeros(); }
};

/// Collects the entries elements will touch, then makes the pattern.
class PatternBuilder {
 public:
  explicit PatternBuilder(int size) : size_(size) {}
  void reserve(std::size_t requests) { requests_.reserve(requests); }
  /// Asks for an entry; requests for the same entry share a slot. Rows or columns outside the
  /// matrix get the discard slot. Returns the number of the request.
  int add(int row, int column);
  /// Builds the matrix (values zero) and the slot of every request.
  SparseMatrix compile(std::vector<int>& slot_of_request) const;

 private:
  int size_;
  std::vector<std::pair<int, int>> requests_;  // (column, row); column = size_: discard
};

/// What factorising cost.
struct FactorCounters {
  long refactorisations = 0;  // numeric only, same pivots, no allocation
  long fresh = 0;             // with a new choice of pivots (allocates)
};

/// LU of one SparseMatrix pattern. Symbolic analysis once; then klu_refactor, and a fresh factor
/// with new pivots only when the pivots have become poor: reciprocal condition estimate below a
/// thousandth of what it was at the last fresh factor, or not finite.
class SparseLU {
 public:
  enum class Scaling { by_rows, none };
  explicit SparseLU(const SparseMatrix& matrix, Scaling scaling = Scaling::by_rows);
  ~SparseLU();
  SparseLU(const SparseLU&) = delete;
  SparseLU& operator=(const SparseLU&) = delete;

  /// Factorises the present values. False if the matrix is singular to working precision or holds a
  /// number that is not finite.
  bool factorise(const SparseMatrix& matrix);
  /// Solves in place, `b` of matrix.size numbers. Call after a successful factorise().
  void solve(double* b);
  /// Forgets the pivots, so the next factorise() is fresh: equal inputs then give equal bits.
  void reset();

  double reciprocal_condition() const { return rcond_; }
  /// Of a factorisation without exchanges, as the analysis counts them.
  double multiplications() const;
  const FactorCounters& counters() const { return counters_; }

 private:
  bool fresh(const SparseMatrix& matrix);
  bool choose_pivots(const SparseMatrix& matrix);

  struct Klu;
  std::unique_ptr<Klu> klu_;
  double rcond_ = 0.0;
  double rcond_fresh_ = 0.0;
  FactorCounters counters_;
};

}  // namespace yoke
