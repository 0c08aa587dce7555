// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A smooth curve as a table of polynomials: cell i covers i <= u <= i + 1,
//   c(u) = sum_k coefficient[k] x^k,   x = 2 (u - i) - 1
// Neighbouring cells agree in position, tangent, curvature and what more their maker gave them;
// their parameters may run at different speeds.
#pragma once

#include <array>
#include <vector>

#include <yoke/core/curves/curve.hpp>

namespace yoke {

class PolynomialPiece final : public CurvePiece {
 public:
  static constexpr int max_degree = 9;
  struct Cell {
    Cell() { coefficient.fill(Vec2(0.0, 0.0)); }
    std::array<Vec2, max_degree + 1> coefficient;
  };

  /// At least one cell.
  PolynomialPiece(std::vector<Cell> cells, int degree, bool closed);

  double end() const override { return static_cast<double>(cells_.size()); }
  bool closed() const override { return closed_; }
  CurvePoint at(double u) const override;
  double foot(const Vec2& p) const override;
  CurveOffset offset(const Vec2& p) const override;
  std::optional<CurvatureChange> curvature_change(double u) const override;
  double length_to(double u) const override;
  double at_length(double s) const override;
  std::shared_ptr<const CurvePiece> moved(double angle, const Vec2& shift) const override;

 private:
  /// c and its first two derivatives by u.
  struct Jet {
    Vec2 c, c1, c2;
  };
  Jet jet(double u) const;
  struct Place {
    std::size_t cell;
    double x;       // in the cell
    double beyond;  // cells beyond where the polynomial goes on; straight on from there
  };
  Place place_of(double u) const;
  double cell_length(std::size_t cell, double from, double to) const;
  void make_samples();
  void make_grid();
  double seed(const Vec2& p) const;

  std::vector<Cell> cells_;
  int degree_;
  bool closed_;
  std::vector<double> lengths_;  // [m] up to each cell, and in all
  // Where to begin the search for a foot: for every square of a grid around the curve, the samples
  // of the curve that are the nearest one for some point of the square.
  std::vector<Vec2> samples_;
  Vec2 corner_{0.0, 0.0};  // [m] of the grid
  double side_ = 0.0;      // [m] of a square
  int columns_ = 0, rows_ = 0;
  std::vector<int> first_;       // of the squares in candidates_
  std::vector<int> candidates_;  // indices of samples
};

}  // namespace yoke
