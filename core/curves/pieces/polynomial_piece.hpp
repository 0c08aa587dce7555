// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A smooth curve as a table of polynomials: cell i covers i <= u <= i + 1,
//   c(u) = sum_k coefficient[k] x^k,   x = 2 (u - i) - 1
// Neighbouring cells agree in position, tangent, curvature and what more their maker gave them;
// their parameters may run at different speeds.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include <yoke/core/curves/curve.hpp>

namespace yoke {

/// Where to begin the search for a foot: for every square of a grid around the curve, the samples of
/// the curve that are the nearest one for some point of the square.
class SeedGrid {
 public:
  explicit SeedGrid(std::vector<Vec2> samples);
  std::size_t nearest(const Vec2& p) const;  ///< index of the sample nearest to p

 private:
  std::vector<Vec2> samples_;
  Vec2 corner_{0.0, 0.0};  // [m] of the grid
  double side_ = 0.0;      // [m] of a square
  int columns_ = 0, rows_ = 0;
  std::vector<int> first_;       // of the squares in candidates_
  std::vector<int> candidates_;  // indices of samples
};

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
  std::vector<Vec2> make_samples() const;
  const SeedGrid& grid() const {
    const SeedGrid* ready = ready_grid_.load(std::memory_order_acquire);
    return ready != nullptr ? *ready : make_grid();
  }
  const SeedGrid& make_grid() const;

  std::vector<Cell> cells_;
  int degree_;
  bool closed_;
  std::vector<double> lengths_;  // [m] up to each cell, and in all
  // Made when the first foot is asked for, as curves are often only made into others.
  mutable std::once_flag grid_made_;
  mutable std::unique_ptr<const SeedGrid> grid_;
  mutable std::atomic<const SeedGrid*> ready_grid_{nullptr};
};

}  // namespace yoke
