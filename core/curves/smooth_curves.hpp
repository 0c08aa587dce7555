// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Smooth curves through points and of functions. Both become tables of polynomials, so that a run
// evaluates every curve at the same small cost and never calls a user's function.
#pragma once

#include <concepts>
#include <functional>
#include <type_traits>
#include <vector>

#include <yoke/core/curves/curve.hpp>

namespace yoke {

/// Of curve_through().
struct SplineOptions {
  bool closed = false;  // from the last point on to the first
  int degree = 5;       // 3: curvature is continuous; 5: its first two derivatives too
};

/// The interpolating spline through points [m], with not-a-knot ends (no condition that the points
/// do not have) and the length of the chords as parameter. At least 4 points (3 if closed), no two
/// neighbours equal; with less than 6 points the degree is 3. Throws ModelError.
Curve curve_through(const std::vector<Vec2>& points, const SplineOptions& options = {});

/// Of curve_of().
struct FunctionOptions {
  bool closed = false;  // the function has the same value, and goes on smoothly, at both ends
};

/// The curve of a smooth function for `from` <= u <= `to`, [m]:
///   curve_of([](double u) { return Vec2(0.1 * std::cos(u), 0.05 * std::sin(u)); }, 0.0, pi)
/// It is replaced by polynomials of degree 9 that agree with it to rounding, whose derivatives are
/// exact; the function is called here only. How fast it runs along the curve does not matter: where
/// that changes much, the length becomes the parameter. Throws ModelError if the function is not
/// finite, stands still (a cusp), has a corner, or is not smooth, and says where.
Curve curve_of(const std::function<Vec2(double)>& function, double from, double to,
               const FunctionOptions& options = {});

/// Refuses a function that returns an expression of Eigen instead of a Vec2: what it refers to would
/// be gone. Write `-> Vec2` or `return Vec2(...)`.
template <class F>
requires std::is_invocable_v<F, double> &&
    (!std::same_as<std::remove_cvref_t<std::invoke_result_t<F, double>>, Vec2>)  //
    Curve
    curve_of(F function, double from, double to, const FunctionOptions& options = {}) = delete;

}  // namespace yoke
