// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/linear/block_lu.hpp>

#include <algorithm>

#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

/// A -= B C of 2 x 2 blocks.
inline void take_product(double* A, const double* B, const double* C) {
  A[0] -= B[0] * C[0] + B[1] * C[2];
  A[1] -= B[0] * C[1] + B[1] * C[3];
  A[2] -= B[2] * C[0] + B[3] * C[2];
  A[3] -= B[2] * C[1] + B[3] * C[3];
}

/// D becomes its inverse. False: a pivot is less than `least` of what was on the diagonal before.
bool invert(double* D, const double* before, double least) {
  const double first = D[0], down = D[2] / first, second = D[3] - down * D[1];
  // Also false for what is not a number.
  if (!(first > least * before[0] && second > least * before[1])) return false;
  const double right = D[1] / first;
  D[3] = 1.0 / second;
  D[2] = -down * D[3];
  D[1] = -right * D[3];
  D[0] = 1.0 / first - right * D[2];
  return true;
}

}  // namespace

BlockLu::BlockLu(const BlockElimination& twin) : twin_(twin) {
  const BlockPattern& pattern = twin.pattern();
  lower_.assign(4 * (at(pattern.columns()) + pattern.row.size()), 0.0);
  upper_ = lower_;
  diagonal_.assign(2 * at(pattern.columns()), 0.0);
  int most = 0;
  for (int k = 0; k < pattern.columns(); ++k)
    most = std::max(most, pattern.start[at(k) + 1] - pattern.start[at(k)]);
  factor_.assign(4 * at(most), 0.0);
}

bool BlockLu::factorise(double least) {
  const BlockPattern& pattern = twin_.pattern();
  const int columns = pattern.columns();
  const double* D = lower_.data();
  for (int k = 0; k < columns; ++k) {
    diagonal_[at(2 * k)] = D[0];
    diagonal_[at(2 * k) + 1] = D[3];
    D += 4 * (1 + pattern.start[at(k) + 1] - pattern.start[at(k)]);
  }
  const int* update = twin_.updates().data();
  double* pivot = lower_.data();
  const double* right = upper_.data();
  for (int k = 0; k < columns; ++k) {
    if (!invert(pivot, diagonal_.data() + 2 * k, least)) return false;
    const int count = pattern.start[at(k) + 1] - pattern.start[at(k)];
    const double* below = pivot + 4;
    right += 4;
    for (int a = 0; a < count; ++a) {
      const double* B = below + 4 * a;
      double* L = factor_.data() + 4 * a;
      L[0] = B[0] * pivot[0] + B[1] * pivot[2];
      L[1] = B[0] * pivot[1] + B[1] * pivot[3];
      L[2] = B[2] * pivot[0] + B[3] * pivot[2];
      L[3] = B[2] * pivot[1] + B[3] * pivot[3];
      for (int b = 0; b <= a; ++b) {
        const int place = *update++;
        take_product(lower_.data() + place, L, right + 4 * b);
        if (b < a) take_product(upper_.data() + place, factor_.data() + 4 * b, right + 4 * a);
      }
    }
    pivot += 4 * (1 + count);
    right += 4 * count;
  }
  return true;
}

void BlockLu::solve(double* x) const {
  const BlockPattern& pattern = twin_.pattern();
  const int columns = pattern.columns();
  const int* row = pattern.row.data();
  const double* D = substitute_forward(pattern, lower_.data(), x);
  const double* U = upper_.data() + (D - lower_.data());
  for (int k = columns - 1; k >= 0; --k) {
    double u = 0.0, v = 0.0;
    for (int a = pattern.start[at(k) + 1] - 1; a >= pattern.start[at(k)]; --a) {
      U -= 4;
      const double* z = x + 2 * row[a];
      u += U[0] * z[0] + U[1] * z[1];
      v += U[2] * z[0] + U[3] * z[1];
    }
    U -= 4;
    D = lower_.data() + (U - upper_.data());
    double* y = x + 2 * k;
    y[0] -= D[0] * u + D[1] * v;
    y[1] -= D[2] * u + D[3] * v;
  }
}

}  // namespace yoke
