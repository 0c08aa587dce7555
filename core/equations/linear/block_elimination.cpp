// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <suitesparse/amd.h>

#include <yoke/core/equations/linear/block_elimination.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

// Multiplications for a pivot, for a block below it, for one of the blocks these change.
constexpr double for_pivot = 8.0, for_block = 8.0, for_update = 8.0;

/// The columns of `pattern` with what elimination fills in: a column takes over what is below the ones
/// whose first block below the diagonal is in its row. False: more than `most` multiplications.
bool fill_in(const BlockPattern& pattern, double most, BlockPattern& filled) {
  const int columns = pattern.columns();
  // The children of a column, one after the other.
  std::vector<int> first_child(at(columns), -1), next_child(at(columns), -1);
  std::vector<int> column, seen(at(columns), -1);
  filled.start.reserve(at(columns) + 1);
  filled.row.reserve(pattern.row.size());
  double work = 0.0;
  for (int k = 0; k < columns; ++k) {
    column.clear();
    const auto take = [&](const int* begin, const int* end) {
      for (; begin != end; ++begin) {
        if (*begin == k || seen[at(*begin)] == k) continue;
        seen[at(*begin)] = k;
        column.push_back(*begin);
      }
    };
    take(pattern.row.data() + pattern.start[at(k)], pattern.row.data() + pattern.start[at(k) + 1]);
    for (int child = first_child[at(k)]; child >= 0; child = next_child[at(child)])
      take(filled.row.data() + filled.start[at(child)],
           filled.row.data() + filled.start[at(child) + 1]);
    std::ranges::sort(column);
    const auto count = static_cast<double>(column.size());
    work += for_pivot + for_block * count + 0.5 * for_update * count * (count + 1.0);
    if (work > most) return false;
    if (!column.empty()) next_child[at(k)] = std::exchange(first_child[at(column.front())], k);
    filled.row.insert(filled.row.end(), column.begin(), column.end());
    filled.start.push_back(static_cast<int>(filled.row.size()));
  }
  return true;
}

/// A -= B C^T of 2 x 2 blocks.
inline void subtract_product(double* A, const double* B, const double* C) {
  A[0] -= B[0] * C[0] + B[1] * C[1];
  A[1] -= B[0] * C[2] + B[1] * C[3];
  A[2] -= B[2] * C[0] + B[3] * C[1];
  A[3] -= B[2] * C[2] + B[3] * C[3];
}

}  // namespace

std::vector<int> elimination_order(int columns, const std::vector<std::pair<int, int>>& pairs) {
  PatternBuilder builder(columns);
  builder.reserve(2 * pairs.size());
  for (const auto& [i, j] : pairs) {
    builder.add(i, j);
    builder.add(j, i);
  }
  std::vector<int> slot, order(at(columns));
  const SparseMatrix graph = builder.compile(slot);
  std::iota(order.begin(), order.end(), 0);
  if (columns > 1)
    amd_order(columns, graph.column_start.data(), graph.row.data(), order.data(), nullptr, nullptr);
  return order;
}

std::unique_ptr<BlockElimination> BlockElimination::make(int columns,
                                                         std::vector<std::pair<int, int>> pairs,
                                                         double most) {
  std::unique_ptr<BlockElimination> made(new BlockElimination);
  BlockPattern& pattern = made->pattern_;
  if (!fill_in(pattern_of(columns, std::move(pairs)), most, pattern)) return nullptr;
  made->update_.reserve(pattern.row.size());
  for (int k = 0; k < columns; ++k)
    for (int a = pattern.start[at(k)]; a < pattern.start[at(k) + 1]; ++a)
      for (int b = pattern.start[at(k)]; b <= a; ++b)
        made->update_.push_back(4 * pattern.place(pattern.row[at(a)], pattern.row[at(b)]));
  made->value_.assign(4 * (at(columns) + pattern.row.size()), 0.0);
  made->diagonal_.assign(2 * at(columns), 0.0);
  return made;
}

/// Overwrites the pivot by its inverse.
bool BlockElimination::invert_pivot(int column, double* D, double least) {
  const double* before = diagonal_.data() + 2 * column;
  const double first = D[0], ratio = D[2] / first, second = D[3] - ratio * D[2];
  // Also false for what is not a number.
  if (!(first > least * before[0] && second > least * before[1])) return false;
  if (first < smallest_ * before[0]) smallest_ = first / before[0];
  if (second < smallest_ * before[1]) smallest_ = second / before[1];
  D[3] = 1.0 / second;
  D[1] = D[2] = -ratio * D[3];
  D[0] = 1.0 / first - ratio * D[1];
  return true;
}

bool BlockElimination::factorise(double least) {
  const int columns = pattern_.columns();
  smallest_ = 1.0;
  double* D = value_.data();
  for (int k = 0; k < columns; ++k) {
    diagonal_[at(2 * k)] = D[0];
    diagonal_[at(2 * k) + 1] = D[3];
    D += 4 * (1 + pattern_.start[at(k) + 1] - pattern_.start[at(k)]);
  }
  const int* update = update_.data();
  D = value_.data();
  for (int k = 0; k < columns; ++k) {
    if (!invert_pivot(k, D, least)) return false;
    const int count = pattern_.start[at(k) + 1] - pattern_.start[at(k)];
    double* below = D + 4;
    for (int a = 0; a < count; ++a) {
      const double* B = below + 4 * a;
      const double L[4] = {B[0] * D[0] + B[1] * D[2], B[0] * D[1] + B[1] * D[3],
                           B[2] * D[0] + B[3] * D[2], B[2] * D[1] + B[3] * D[3]};
      for (int b = 0; b <= a; ++b) subtract_product(value_.data() + *update++, L, below + 4 * b);
    }
    D = below + 4 * count;
  }
  return true;
}

const double* substitute_forward(const BlockPattern& pattern, const double* D, double* x) {
  const int columns = pattern.columns();
  const int* row = pattern.row.data();
  for (int k = 0; k < columns; ++k) {
    double* y = x + 2 * k;
    const double u = D[0] * y[0] + D[1] * y[1], v = D[2] * y[0] + D[3] * y[1];
    y[0] = u;
    y[1] = v;
    D += 4;
    for (int a = pattern.start[at(k)]; a < pattern.start[at(k) + 1]; ++a, D += 4) {
      double* z = x + 2 * row[a];
      z[0] -= D[0] * u + D[1] * v;
      z[1] -= D[2] * u + D[3] * v;
    }
  }
  return D;
}

void BlockElimination::solve(double* x) {
  const int columns = pattern_.columns();
  const int* row = pattern_.row.data();
  const double* D = substitute_forward(pattern_, value_.data(), x);
  for (int k = columns - 1; k >= 0; --k) {
    double u = 0.0, v = 0.0;
    for (int a = pattern_.start[at(k) + 1] - 1; a >= pattern_.start[at(k)]; --a) {
      D -= 4;
      const double* z = x + 2 * row[a];
      u += D[0] * z[0] + D[2] * z[1];
      v += D[1] * z[0] + D[3] * z[1];
    }
    D -= 4;
    double* y = x + 2 * k;
    y[0] -= D[0] * u + D[1] * v;
    y[1] -= D[2] * u + D[3] * v;
  }
}

}  // namespace yoke
