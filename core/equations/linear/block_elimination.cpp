// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/linear/block_elimination.hpp>

#include <limits>
#include <utility>

#include <yoke/core/equations/linear/elimination_order.hpp>
#include <yoke/core/equations/linear/index.hpp>
#include <yoke/core/equations/linear/pair.hpp>

namespace yoke {

std::unique_ptr<BlockElimination> BlockElimination::make(int columns,
                                                         std::vector<std::pair<int, int>> pairs) {
  std::unique_ptr<BlockElimination> made(new BlockElimination);
  BlockPattern& pattern = made->pattern_;
  fill_in(pattern_of(columns, std::move(pairs)), std::numeric_limits<double>::infinity(), pattern);
  made->update_.reserve(pattern.row.size());
  for (int k = 0; k < columns; ++k)
    for (int a = pattern.start[at(k)]; a < pattern.start[at(k) + 1]; ++a)
      for (int b = pattern.start[at(k)]; b <= a; ++b)
        made->update_.push_back(4 * pattern.place(pattern.row[at(a)], pattern.row[at(b)]));
  made->value_.assign(4 * (at(columns) + pattern.row.size()), 0.0);
  made->diagonal_.assign(2 * at(columns), 0.0);
  return made;
}

/// Overwrites the pivot by its inverse, by one division: the next pivot waits for it.
bool BlockElimination::invert_pivot(int column, double* D, double least) {
  const double* before = diagonal_.data() + 2 * column;
  const double first = D[0], last = D[3], beside = D[2];
  const double determinant = first * last - beside * beside;
  // The second pivot times the first.
  const double whole = first * before[1];
  // Also false for what is not a number.
  if (!(first > least * before[0] && determinant > least * whole)) return false;
  if (first < smallest_ * before[0]) smallest_ = first / before[0];
  if (determinant < smallest_ * whole) smallest_ = determinant / whole;
  const double inverse = 1.0 / determinant;
  D[0] = last * inverse;
  D[1] = D[2] = -beside * inverse;
  D[3] = first * inverse;
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
      const Pair upper = B[0] * pair_at(D) + B[1] * pair_at(D + 2);
      const Pair lower = B[2] * pair_at(D) + B[3] * pair_at(D + 2);
      for (int b = 0; b <= a; ++b) {
        double* A = value_.data() + *update++;  // less B D C^T
        const double* C = below + 4 * b;
        const Pair left(C[0], C[2]), right(C[1], C[3]);
        put(A, pair_at(A) - (upper[0] * left + upper[1] * right));
        put(A + 2, pair_at(A + 2) - (lower[0] * left + lower[1] * right));
      }
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
    const Pair u = Pair(D[0], D[2]) * y[0] + Pair(D[1], D[3]) * y[1];
    put(y, u);
    D += 4;
    for (int a = pattern.start[at(k)]; a < pattern.start[at(k) + 1]; ++a, D += 4) {
      double* z = x + 2 * row[a];
      put(z, pair_at(z) - (Pair(D[0], D[2]) * u[0] + Pair(D[1], D[3]) * u[1]));
    }
  }
  return D;
}

void BlockElimination::solve(double* x) {
  const int columns = pattern_.columns();
  const int* row = pattern_.row.data();
  const double* D = substitute_forward(pattern_, value_.data(), x);
  for (int k = columns - 1; k >= 0; --k) {
    Pair u(0.0, 0.0);
    for (int a = pattern_.start[at(k) + 1] - 1; a >= pattern_.start[at(k)]; --a) {
      D -= 4;
      const double* z = x + 2 * row[a];
      u += pair_at(D) * z[0] + pair_at(D + 2) * z[1];
    }
    D -= 4;
    double* y = x + 2 * k;
    put(y, pair_at(y) - (Pair(D[0], D[2]) * u[0] + Pair(D[1], D[3]) * u[1]));
  }
}

}  // namespace yoke
