// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/curves/smooth_curves.hpp>

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unsupported/Eigen/Splines>
#include <utility>

#include <yoke/core/curves/pieces/polynomial_piece.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

using Cell = PolynomialPiece::Cell;

// ---- splines ----

constexpr int overlap = 48;  // points repeated beyond both ends of a closed curve: what happens at
                             // an end of a spline fades by more than half from point to point

using Spline2 = Eigen::Spline<double, 2, Eigen::Dynamic>;

/// Interpolates at increasing parameters t; the knots are the inner t, but for those next to the
/// ends (not-a-knot). `degree` is odd and less than the number of points.
Spline2 interpolate(const std::vector<Vec2>& points, const std::vector<double>& t, int degree) {
  const Eigen::Index n = static_cast<Eigen::Index>(points.size());
  const Eigen::Index skipped = (degree + 1) / 2;
  Spline2::KnotVectorType knots(n + degree + 1);
  for (Eigen::Index i = 0; i <= degree; ++i) knots[i] = t.front(), knots[n + i] = t.back();
  for (Eigen::Index i = degree + 1; i < n; ++i)
    knots[i] = t[static_cast<std::size_t>(i - degree - 1 + skipped)];
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d values(n, 2);
  for (Eigen::Index row = 0; row < n; ++row) {
    const std::size_t i = static_cast<std::size_t>(row);
    const Eigen::Index span = Spline2::Span(t[i], degree, knots);
    const auto basis = Spline2::BasisFunctions(t[i], degree, knots);
    for (Eigen::Index k = 0; k <= degree; ++k)
      entries.emplace_back(row, span - degree + k, basis[k]);
    values.row(row) = points[i].transpose();
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(matrix);
  const Eigen::MatrixX2d controls = factors.solve(values);
  return Spline2(knots, controls.transpose());
}

/// Its polynomials between the knots from t0 to t1.
std::vector<Cell> cells_of(const Spline2& spline, int degree, double t0, double t1) {
  std::vector<Cell> cells;
  const auto& knots = spline.knots();
  for (Eigen::Index i = 0; i + 1 < knots.size(); ++i) {
    const double low = knots[i], high = knots[i + 1], half = 0.5 * (high - low);
    if (!(high > low) || low < t0 || high > t1) continue;
    const auto derivatives = spline.derivatives(0.5 * (low + high), degree);
    Cell cell;
    double factor = 1.0;
    for (int k = 0; k <= degree; ++k) {
      cell.coefficient[static_cast<std::size_t>(k)] = factor * derivatives.col(k).matrix();
      factor *= half / (k + 1);
    }
    cells.push_back(cell);
  }
  return cells;
}

// ---- functions ----

constexpr int fitted_degree = PolynomialPiece::max_degree;
constexpr int nodes = fitted_degree + 1;
constexpr int most_cells = 4096;
constexpr double rounding =
    64 * std::numeric_limits<double>::epsilon();  // of the size of the curve
constexpr double slowest = 1e-9;                  // of the mean speed: slower is standing still
constexpr double uneven = 3.0;            // fastest over slowest: the length becomes the parameter
constexpr double smallest_corner = 1e-6;  // [rad] between cells
constexpr double smallest_jump = 1e-3;    // of the curvature between cells, of 1/cell or itself

/// The polynomial through the values at Chebyshev's points, in powers of x. By way of Chebyshev's
/// polynomials: those that matter are few and small numbers stay small.
class ChebyshevFit {
 public:
  ChebyshevFit() {
    for (int i = 0; i < nodes; ++i)
      for (int k = 0; k < nodes; ++k)
        to_chebyshev_(k, i) = (k == 0 ? 1.0 : 2.0) / nodes * std::cos(k * angle(i));
    // T_k+1 = 2 x T_k - T_k-1
    to_powers_.setZero();
    to_powers_(0, 0) = to_powers_(1, 1) = 1.0;
    for (int k = 1; k + 1 < nodes; ++k)
      for (int power = 0; power <= k + 1; ++power)
        to_powers_(power, k + 1) =
            (power > 0 ? 2.0 * to_powers_(power - 1, k) : 0.0) - to_powers_(power, k - 1);
  }

  Cell fit(const std::function<Vec2(double)>& function, double low, double high) const {
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    Eigen::Matrix<double, nodes, 2> values;
    for (int i = 0; i < nodes; ++i)
      values.row(i) = function(middle + half * std::cos(angle(i))).transpose();
    Eigen::Matrix<double, nodes, 2> series = to_chebyshev_ * values;
    // What is rounding of the values at the end of the series would be large in the derivatives.
    const double noise =
        4.0 * std::numeric_limits<double>::epsilon() * values.cwiseAbs().maxCoeff();
    for (int k = nodes - 1; k > 0 && series.row(k).cwiseAbs().maxCoeff() < noise; --k)
      series.row(k).setZero();
    const Eigen::Matrix<double, nodes, 2> powers = to_powers_ * series;
    Cell cell;
    for (int k = 0; k < nodes; ++k)
      cell.coefficient[static_cast<std::size_t>(k)] = powers.row(k).transpose();
    return cell;
  }

 private:
  static double angle(int node) { return pi * (node + 0.5) / nodes; }

  Eigen::Matrix<double, nodes, nodes> to_chebyshev_, to_powers_;
};

Vec2 value_of(const Cell& cell, double x) {
  Vec2 c(0.0, 0.0);
  for (int k = fitted_degree; k >= 0; --k)
    c = x * c + cell.coefficient[static_cast<std::size_t>(k)];
  return c;
}

Vec2 slope_of(const Cell& cell, double x) {
  Vec2 c(0.0, 0.0);
  for (int k = fitted_degree; k >= 1; --k)
    c = x * c + k * cell.coefficient[static_cast<std::size_t>(k)];
  return c;
}

Vec2 bend_of(const Cell& cell, double x) {
  Vec2 c(0.0, 0.0);
  for (int k = fitted_degree; k >= 2; --k)
    c = x * c + k * (k - 1) * cell.coefficient[static_cast<std::size_t>(k)];
  return c;
}

/// A function and the polynomials that take its place: cell i from `from` + i `width` on.
struct Fitted {
  std::function<Vec2(double)> function;
  double from = 0.0, width = 0.0;
  std::vector<Cell> cells{};

  double at(std::size_t cell, double x) const {
    return from + width * (static_cast<double>(cell) + 0.5 * (x + 1.0));
  }
};

/// How far the polynomials of all cells are from the function [m], and where most.
std::pair<double, double> misfit(const Fitted& fitted) {
  std::pair<double, double> worst{0.0, fitted.from};
  for (std::size_t i = 0; i < fitted.cells.size(); ++i)
    for (const double x : {-1.0, -0.93, -0.51, 0.07, 0.62, 0.95, 1.0}) {
      const double u = fitted.at(i, x);
      const double error = (value_of(fitted.cells[i], x) - fitted.function(u)).norm();
      if (!(error <= worst.first)) worst = {error, u};
    }
  return worst;
}

/// As many cells as it takes for a misfit of `allowed` [m], and then twice as many: what is left of
/// its derivatives is rounding too. None if it does not fit; then `where` is the worst place.
std::optional<Fitted> fit(const std::function<Vec2(double)>& function, double from, double to,
                          double allowed, double& where) {
  static const ChebyshevFit chebyshev;
  bool fits = false;
  for (int count = 4; fits || count <= most_cells; count *= 2) {
    Fitted fitted{.function = function, .from = from, .width = (to - from) / count};
    for (int i = 0; i < count; ++i)
      fitted.cells.push_back(
          chebyshev.fit(function, from + fitted.width * i, from + fitted.width * (i + 1)));
    const auto [error, worst] = misfit(fitted);
    where = worst;
    const bool fitted_before = std::exchange(fits, error <= allowed);
    if (fits && fitted_before) return fitted;
  }
  return std::nullopt;
}

/// Slowest and fastest [m per cell] and where it is slowest.
struct Speeds {
  double least = std::numeric_limits<double>::infinity(), most = 0.0, mean = 0.0;
  double slowest_at = 0.0;
};

/// The place of the least speed within a cell, between two places beside it.
double slowest_between(const Cell& cell, double low, double high) {
  constexpr double golden = 0.381966011250105;
  while (high - low > 1e-12) {
    const double left = low + golden * (high - low), right = high - golden * (high - low);
    (slope_of(cell, left).squaredNorm() < slope_of(cell, right).squaredNorm() ? high : low) =
        slope_of(cell, left).squaredNorm() < slope_of(cell, right).squaredNorm() ? right : left;
  }
  return 0.5 * (low + high);
}

Speeds speeds_of(const Fitted& fitted) {
  constexpr int parts = 8;
  Speeds speeds;
  const auto consider = [&](std::size_t i, double x) {
    const double speed = 2.0 * slope_of(fitted.cells[i], x).norm();
    speeds.most = std::max(speeds.most, speed);
    if (speed < speeds.least) speeds.least = speed, speeds.slowest_at = fitted.at(i, x);
  };
  for (std::size_t i = 0; i < fitted.cells.size(); ++i) {
    const Cell& cell = fitted.cells[i];
    speeds.mean += (value_of(cell, 1.0) - value_of(cell, -1.0)).norm() /
                   static_cast<double>(fitted.cells.size());
    for (int k = 0; k <= parts; ++k) consider(i, -1.0 + 2.0 * k / parts);
    for (int k = 0; k < parts; ++k)
      consider(i, slowest_between(cell, -1.0 + 2.0 * k / parts, -1.0 + 2.0 * (k + 1) / parts));
  }
  return speeds;
}

/// Polynomials on both sides of a corner fit, if it is where two cells meet.
void require_no_corners(const Fitted& fitted, bool closed,
                        const std::function<double(double)>& name_of) {
  const std::size_t count = fitted.cells.size();
  for (std::size_t i = 0; i < (closed ? count : count - 1); ++i) {
    const Cell &before = fitted.cells[i], &behind = fitted.cells[(i + 1) % count];
    const Vec2 in = slope_of(before, 1.0), out = slope_of(behind, -1.0);
    const double turn = std::atan2(cross(in, out), in.dot(out));
    const double u = name_of(fitted.at(i, 1.0));
    if (std::abs(turn) > smallest_corner)
      throw ModelError(fmt::format(
          "curve of a function: it turns by {:g} rad at u = {:g}; make it of two curves "
          "with chain()",
          turn, u));
    const double bend_in = cross(in, bend_of(before, 1.0)) / in.squaredNorm(),
                 bend_out = cross(out, bend_of(behind, -1.0)) / out.squaredNorm();
    if (std::abs(bend_out / out.norm() - bend_in / in.norm()) * in.norm() >
        smallest_jump * (1.0 + std::abs(bend_in)))
      throw ModelError(fmt::format(
          "curve of a function: it is not smooth at u = {:g}, where its curvature jumps from {:g} "
          "to {:g} 1/m; make it of two curves with chain()",
          u, bend_in / in.norm(), bend_out / out.norm()));
  }
}

}  // namespace

Curve curve_through(const std::vector<Vec2>& points, const SplineOptions& options) {
  constexpr std::string_view owner = "curve through points";
  const std::size_t n = points.size(), least = options.closed ? 3 : 4;
  if (n < least)
    throw ModelError(fmt::format("{}: {} points are too few; at least {}", owner, n, least));
  if (options.degree != 3 && options.degree != 5)
    throw ModelError(fmt::format("{}: degree = {} must be 3 or 5", owner, options.degree));
  const int degree = options.closed || n >= 6 ? options.degree : 3;
  const auto chord = [&](std::size_t i) { return (points[(i + 1) % n] - points[i % n]).norm(); };
  for (std::size_t i = 0; i < n; ++i) {
    require_finite(owner, fmt::format("point {} x", i + 1), points[i].x());
    require_finite(owner, fmt::format("point {} y", i + 1), points[i].y());
  }
  for (std::size_t i = 0; i < n; ++i)
    if ((options.closed || i + 1 < n) && !(chord(i) > 0.0))
      throw ModelError(
          fmt::format("{}: points {} and {} are the same", owner, i + 1, (i + 1) % n + 1));
  const Vec2 origin = points.front();
  // A closed curve is cut out of one that goes round more than once.
  const std::size_t extra = options.closed ? overlap : 0;
  const std::size_t count = options.closed ? n + 2 * overlap + 1 : n;
  std::size_t point = options.closed ? n * overlap - overlap : 0;  // i % n where i may not be < 0
  std::vector<Vec2> passed;
  std::vector<double> t;
  double length = 0.0;
  for (std::size_t i = 0; i < count; ++i, ++point) {
    passed.push_back(points[point % n] - origin);
    t.push_back(length);
    length += chord(point);
  }
  const double whole = t.back();
  for (double& value : t) value /= whole;
  const double slack = 1e-9 / static_cast<double>(count);
  const Spline2 spline = interpolate(passed, t, degree);
  std::vector<Cell> cells =
      cells_of(spline, degree, t[extra] - slack, t[count - 1 - extra] + slack);
  return Curve(std::make_shared<PolynomialPiece>(std::move(cells), degree, options.closed), origin);
}

Curve curve_of(const std::function<Vec2(double)>& function, double from, double to,
               const FunctionOptions& options) {
  constexpr std::string_view owner = "curve of a function";
  require_finite(owner, "from", from);
  require_finite(owner, "to", to);
  if (!(to > from))
    throw ModelError(
        fmt::format("{}: to = {:g} must be greater than from = {:g}", owner, to, from));
  if (!function) throw ModelError(fmt::format("{}: no function is given", owner));
  const Vec2 origin = function(from);
  double size = 0.0, farthest = 0.0, farthest_step = 0.0;
  Vec2 last = origin;
  constexpr int probes = 257;
  for (int i = 0; i < probes; ++i) {
    const double u = from + (to - from) * i / (probes - 1);
    const Vec2 p = function(u);
    if (!p.allFinite()) throw ModelError(fmt::format("{}: it is not finite at u = {:g}", owner, u));
    size = std::max(size, (p - origin).norm());
    farthest = std::max(farthest, p.norm());
    farthest_step = std::max(farthest_step, (p - last).norm());
    last = p;
  }
  require_positive(owner, "size", size, "m");
  if (options.closed && (function(to) - origin).norm() > 1e-9 * size)
    throw ModelError(fmt::format("{}: closed, but its ends are {:g} m apart", owner,
                                 (function(to) - origin).norm()));
  const std::function<Vec2(double)> local = [&](double u) { return Vec2(function(u) - origin); };
  // Rounding of the parameter displaces a point along the curve.
  const double fastest = farthest_step * (probes - 1) / (to - from);
  const double allowed =
      rounding * (size + farthest) + 4.0 * std::numeric_limits<double>::epsilon() * fastest *
                                         std::max(std::abs(from), std::abs(to));
  double where = from;
  std::optional<Fitted> fitted = fit(local, from, to, allowed, where);
  if (!fitted) throw ModelError(fmt::format("{}: it is not smooth near u = {:g}", owner, where));
  const Speeds speeds = speeds_of(*fitted);
  if (!(speeds.least > slowest * speeds.mean))
    throw ModelError(
        fmt::format("{}: it stands still at u = {:g}, where it has no direction", owner,
                    std::abs(speeds.slowest_at) < 1e-7 * (to - from) ? 0.0 : speeds.slowest_at));
  std::function<double(double)> name_of = [](double u) { return u; };
  if (speeds.most > uneven * speeds.least) {
    // Where it is slow its cells are so short that rounding of the values would be large in their
    // curvature. As a function of its length it runs evenly, and fits unless it bends very sharply.
    const auto table = std::make_shared<PolynomialPiece>(fitted->cells, fitted_degree, false);
    const std::function<double(double)> by_length = [table, from, width = fitted->width](double s) {
      return from + width * table->at_length(s);
    };
    std::optional<Fitted> even = fit([&](double s) { return local(by_length(s)); }, 0.0,
                                     table->length_to(table->end()), allowed, where);
    if (even) fitted = std::move(even), name_of = by_length;
  }
  require_no_corners(*fitted, options.closed, name_of);
  return Curve(
      std::make_shared<PolynomialPiece>(std::move(fitted->cells), fitted_degree, options.closed),
      origin);
}

}  // namespace yoke
