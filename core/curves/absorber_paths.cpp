// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/curves/absorber_paths.hpp>

#include <boost/math/special_functions/sinc.hpp>
#include <cmath>

#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/curves/smooth_curves.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

constexpr double share_of_cusp = 0.98;

/// Integral of sin(w x) from 0 to phi: (1 - cos(w phi))/w, also for w = 0.
double integral_of_sine(double w, double phi) {
  const double half = 0.5 * w * phi;
  return std::sin(half) * phi * boost::math::sinc_pi(half);
}

/// Integral of cos(w x) from 0 to phi.
double integral_of_cosine(double w, double phi) { return phi * boost::math::sinc_pi(w * phi); }

}  // namespace

double tautochronic_lambda(double order) { return order / std::hypot(order, 1.0); }

Curve absorber_path(const AbsorberPath& path) {
  constexpr std::string_view owner = "absorber path";
  require_finite(owner, "center x", path.center.x());
  require_finite(owner, "center y", path.center.y());
  require_finite(owner, "direction", path.direction);
  require_positive(owner, "distance", path.distance, "m");
  require_positive(owner, "order", path.order, "");
  require_range(owner, "lambda", path.lambda, 0.0, 1.0);
  require_positive(owner, "reach", path.reach, "m");
  const double rho0 = path.distance / (1.0 + path.order * path.order), lambda = path.lambda;
  const Vec2 vertex(path.distance, 0.0);
  const auto placed = [&](const Curve& curve) { return curve.moved(path.direction, path.center); };
  if (lambda == 0.0) {
    const double angle = path.reach / rho0;
    require_range(owner, "reach", path.reach, 0.0, pi * rho0, "m");
    return placed(circular_arc({.center = vertex - Vec2(rho0, 0.0),
                                .radius = rho0,
                                .start = -angle,
                                .angle = 2.0 * angle}));
  }
  require_range(owner, "reach", path.reach, 0.0, share_of_cusp * rho0 / lambda, "m");
  const double end = std::asin(lambda * path.reach / rho0) / lambda;
  return placed(curve_of(
      [&](double phi) {
        const double x = integral_of_sine(1.0 + lambda, phi) + integral_of_sine(1.0 - lambda, phi);
        const double y =
            integral_of_cosine(1.0 + lambda, phi) + integral_of_cosine(1.0 - lambda, phi);
        return Vec2(vertex + 0.5 * rho0 * Vec2(-x, y));
      },
      -end, end));
}

}  // namespace yoke
