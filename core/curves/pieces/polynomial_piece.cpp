// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/curves/pieces/polynomial_piece.hpp>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <utility>

namespace yoke {

namespace {

constexpr int samples_per_cell = 4;
constexpr int squares = 4096;       // of the grid, about
constexpr double border = 0.25;     // of the size of the curve, that the grid is larger
constexpr double look_ahead = 0.5;  // cells beyond an end for which the polynomial goes on
constexpr int most_iterations = 60;
constexpr double settled = 1e-8;  // cells; a Newton step that short leaves its square as error

}  // namespace

PolynomialPiece::PolynomialPiece(std::vector<Cell> cells, int degree, bool closed)
    : cells_(std::move(cells)), degree_(degree), closed_(closed) {
  lengths_.assign(1, 0.0);
  for (std::size_t i = 0; i < cells_.size(); ++i)
    lengths_.push_back(lengths_.back() + cell_length(i, -1.0, 1.0));
}

inline PolynomialPiece::Place PolynomialPiece::place_of(double u) const {
  const double last = end();
  if (closed_) u -= last * std::floor(u / last);
  const double inside = closed_ ? u : std::clamp(u, -look_ahead, last + look_ahead);
  const std::size_t cell =
      static_cast<std::size_t>(std::clamp(std::floor(inside), 0.0, last - 1.0));
  return {cell, 2.0 * (inside - static_cast<double>(cell)) - 1.0, u - inside};
}

PolynomialPiece::Jet PolynomialPiece::jet(double u) const {
  const auto [cell, x, beyond] = place_of(u);
  const auto& a = cells_[cell].coefficient;
  // Horner for the value and both derivatives at once.
  Vec2 c = a[static_cast<std::size_t>(degree_)], c1(0.0, 0.0), c2(0.0, 0.0);
  for (int k = degree_ - 1; k >= 0; --k) {
    c2 = x * c2 + c1;
    c1 = x * c1 + c;
    c = x * c + a[static_cast<std::size_t>(k)];
  }
  Jet j{c, 2.0 * c1, 8.0 * c2};
  if (beyond != 0.0) {  // far beyond an end: straight on
    j.c += beyond * j.c1;
    j.c2.setZero();
  }
  return j;
}

CurvePoint PolynomialPiece::at(double u) const {
  const Jet j = jet(u);
  const double speed = j.c1.norm();
  return {j.c, j.c1 / speed, cross(j.c1, j.c2) / (speed * speed * speed), speed};
}

CurveOffset PolynomialPiece::offset(const Vec2& p) const {
  const double u = foot(p);
  const CurvePoint foot_point = at(u);
  const Vec2 normal = perp(foot_point.tangent);
  return {normal.dot(p - foot_point.point), normal, foot_point.curvature, u};
}

/// With A = c1 x c2, B = c1 . c2 and v = |c1|: k = A/v^3, differentiated by u, and d/dl = (1/v) d/du.
std::optional<CurvatureChange> PolynomialPiece::curvature_change(double u) const {
  const auto [cell, x, beyond] = place_of(u);
  if (beyond != 0.0) return CurvatureChange{};
  const auto& a = cells_[cell].coefficient;
  std::array<Vec2, 5> c;  // c and its derivatives by x, each divided by the factorial of its order
  c.fill(Vec2(0.0, 0.0));
  for (int k = degree_; k >= 0; --k) {
    for (std::size_t i = c.size() - 1; i > 0; --i) c[i] = x * c[i] + c[i - 1];
    c[0] = x * c[0] + a[static_cast<std::size_t>(k)];
  }
  const Vec2 c1 = 2.0 * c[1], c2 = 8.0 * c[2], c3 = 48.0 * c[3], c4 = 384.0 * c[4];
  const double v2 = c1.squaredNorm(), v = std::sqrt(v2), v3 = v * v2;
  const double A = cross(c1, c2), A_u = cross(c1, c3), A_uu = cross(c2, c3) + cross(c1, c4);
  const double B = c1.dot(c2) / v2, B_u = (c2.squaredNorm() + c1.dot(c3)) / v2;
  const double k_u = (A_u - 3.0 * A * B) / v3;
  const double k_uu = (A_uu - 6.0 * A_u * B - 3.0 * A * B_u + 15.0 * A * B * B) / v3;
  return CurvatureChange{k_u / v, (k_uu - k_u * B) / v2};
}

/// Newton's method on (c - p) . c' = 0 from the nearest sample; where the distance is no minimum to
/// go for, half a cell downhill.
double PolynomialPiece::foot(const Vec2& p) const {
  double u = static_cast<double>(grid().nearest(p)) / samples_per_cell;
  for (int i = 0; i < most_iterations; ++i) {
    const Jet j = jet(u);
    const Vec2 from = j.c - p;
    const double slope = from.dot(j.c1), bend = j.c1.squaredNorm() + from.dot(j.c2);
    const bool convex = bend > 0.05 * j.c1.squaredNorm();
    const double step = convex ? -slope / bend : (slope > 0.0 ? -0.5 : 0.5);
    const bool outside = !closed_ && (u < 0.0 || u > end());  // straight on, so any step is right
    u += outside ? step : std::clamp(step, -1.0, 1.0);
    if (std::abs(step) < settled) break;
  }
  if (closed_) u -= end() * std::floor(u / end());
  return u;
}

// ---- where to begin ----

std::vector<Vec2> PolynomialPiece::make_samples() const {
  const int count = samples_per_cell * static_cast<int>(cells_.size()) + (closed_ ? 0 : 1);
  std::vector<Vec2> samples;
  samples.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    samples.push_back(jet(static_cast<double>(i) / samples_per_cell).c);
  return samples;
}

const SeedGrid& PolynomialPiece::make_grid() const {
  std::call_once(grid_made_, [this] {
    grid_ = std::make_unique<const SeedGrid>(make_samples());
    ready_grid_.store(grid_.get(), std::memory_order_release);
  });
  return *grid_;
}

SeedGrid::SeedGrid(std::vector<Vec2> samples) : samples_(std::move(samples)) {
  Vec2 low = samples_.front(), high = low;
  for (const Vec2& s : samples_) low = low.cwiseMin(s), high = high.cwiseMax(s);
  const double size = (high - low).maxCoeff();
  low -= Vec2::Constant(border * size);
  high += Vec2::Constant(border * size);
  const Vec2 extent = high - low;
  corner_ = low;
  side_ = std::sqrt(extent.x() * extent.y() / squares);
  columns_ = static_cast<int>(extent.x() / side_) + 1;
  rows_ = static_cast<int>(extent.y() / side_) + 1;
  const double diagonal = std::sqrt(2.0) * side_;
  std::vector<double> distances(samples_.size());
  first_.reserve(static_cast<std::size_t>(columns_ * rows_) + 1);
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const Vec2 middle = corner_ + side_ * Vec2(column + 0.5, row + 0.5);
      first_.push_back(static_cast<int>(candidates_.size()));
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < samples_.size(); ++i) {
        distances[i] = (samples_[i] - middle).norm();
        least = std::min(least, distances[i]);
      }
      for (std::size_t i = 0; i < samples_.size(); ++i)
        if (distances[i] <= least + diagonal) candidates_.push_back(static_cast<int>(i));
    }
  first_.push_back(static_cast<int>(candidates_.size()));
}

std::size_t SeedGrid::nearest(const Vec2& p) const {
  const Vec2 place = (p - corner_) / side_;
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](std::size_t sample) {
    const double distance = (samples_[sample] - p).squaredNorm();
    if (distance < least) least = distance, best = sample;
  };
  if (place.x() >= 0.0 && place.x() < columns_ && place.y() >= 0.0 && place.y() < rows_) {
    const std::size_t square = static_cast<std::size_t>(static_cast<int>(place.y()) * columns_ +
                                                        static_cast<int>(place.x()));
    for (int i = first_[square]; i < first_[square + 1]; ++i)
      consider(static_cast<std::size_t>(candidates_[static_cast<std::size_t>(i)]));
  } else {
    for (std::size_t i = 0; i < samples_.size(); ++i) consider(i);
  }
  return best;
}

// ---- lengths ----

/// [m] between two x of a cell.
double PolynomialPiece::cell_length(std::size_t cell, double from, double to) const {
  const auto& a = cells_[cell].coefficient;
  const auto speed = [&](double x) {
    Vec2 slope(0.0, 0.0);
    for (int k = degree_; k >= 1; --k) slope = x * slope + k * a[static_cast<std::size_t>(k)];
    return slope.norm();
  };
  return boost::math::quadrature::gauss<double, 30>::integrate(speed, from, to);
}

double PolynomialPiece::length_to(double u) const {
  const double last = end();
  if (u < 0.0) return u * jet(0.0).c1.norm();
  if (u > last) return lengths_.back() + (u - last) * jet(last).c1.norm();
  const std::size_t cell = std::min(static_cast<std::size_t>(u), cells_.size() - 1);
  return lengths_[cell] + cell_length(cell, -1.0, 2.0 * (u - static_cast<double>(cell)) - 1.0);
}

double PolynomialPiece::at_length(double s) const {
  s = std::clamp(s, 0.0, lengths_.back());
  const auto next = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, s);
  const std::size_t cell = static_cast<std::size_t>(next - lengths_.begin()) - 1;
  const double start = static_cast<double>(cell);
  double u = start + (s - lengths_[cell]) / (lengths_[cell + 1] - lengths_[cell]);
  for (int i = 0; i < most_iterations; ++i) {
    const double step = (length_to(u) - s) / jet(u).c1.norm();
    u = std::clamp(u - step, start, start + 1.0);
    if (std::abs(step) < settled) break;
  }
  return u;
}

std::shared_ptr<const CurvePiece> PolynomialPiece::moved(double angle, const Vec2& shift) const {
  std::vector<Cell> cells = cells_;
  for (Cell& cell : cells) {
    for (Vec2& c : cell.coefficient) c = rotate(angle, c);
    cell.coefficient[0] += shift;
  }
  return std::make_shared<PolynomialPiece>(std::move(cells), degree_, closed_);
}

}  // namespace yoke
