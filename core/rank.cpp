// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <Eigen/SparseCore>
#include <Eigen/SparseQR>

#include <yoke/core/rank.hpp>

#include <algorithm>
#include <cmath>

namespace yoke {

namespace {

// G^T with lengths in units of the length scale, every equation normalised to one.
Eigen::SparseMatrix<double> scaled_transpose(const System& system) {
  const double length = system.scales().length;
  std::vector<Eigen::Triplet<double>> entries;
  for (const ConstraintSlot& c : system.constraints()) {
    for (int i = 0; i < c.rows; ++i) {
      const std::size_t first = entries.size();
      double square = 0.0;
      for (int j = 0; j < c.columns; ++j) {
        const int dof = system.dof()[static_cast<std::size_t>(c.dofs + j)];
        const double g = system.G()[c.block + i * c.columns + j];
        if (dof < 0 || g == 0.0) continue;
        const double value = dof % 3 == 2 ? g : g * length;
        entries.emplace_back(dof, c.row + i, value);
        square += value * value;
      }
      if (square == 0.0) continue;  // an equation no coordinate can satisfy: dependent
      const double norm = std::sqrt(square);
      for (std::size_t k = first; k < entries.size(); ++k)
        entries[k] = {entries[k].row(), entries[k].col(), entries[k].value() / norm};
    }
  }
  Eigen::SparseMatrix<double> transpose(system.dofs(), system.rows());
  transpose.setFromTriplets(entries.begin(), entries.end());
  return transpose;
}

}  // namespace

std::vector<int> find_dependent_rows(const System& system) {
  Eigen::SparseMatrix<double> transpose = scaled_transpose(system);
  transpose.makeCompressed();
  Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::NaturalOrdering<int>> qr;
  qr.setPivotThreshold(1e-10);
  qr.compute(transpose);
  std::vector<int> dependent;
  for (Eigen::Index i = qr.rank(); i < transpose.cols(); ++i)
    dependent.push_back(qr.colsPermutation().indices()(i));
  std::ranges::sort(dependent, std::greater<>());
  return dependent;
}

}  // namespace yoke
