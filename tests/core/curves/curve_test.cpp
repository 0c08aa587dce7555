// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Curves against closed forms: places, feet, distances, lengths; and what is refused.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <yoke/core/curves/absorber_paths.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/curves/smooth_curves.hpp>
#include <yoke/core/error.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;

namespace {

double distance(const Vec2& a, const Vec2& b) { return (a - b).norm(); }

/// Tangent, normal and curvature of `curve` against differences of its points, and the offsets of
/// points beside it.
void check_geometry(const Curve& curve, double tolerance) {
  const double length = curve.length();
  for (const double share : {0.07, 0.31, 0.52, 0.77, 0.94}) {
    const double s = share * length, h = 1e-5 * length;
    const CurvePoint at = curve.at(s);
    const Vec2 before = curve.at(s - h).point, after = curve.at(s + h).point;
    CHECK(distance((after - before) / (2.0 * h), at.tangent) < 1e-7);
    const Vec2 bend = (after - 2.0 * at.point + before) / (h * h);
    CHECK(at.curvature * length ==
          doctest::Approx(cross(at.tangent, bend) * length).epsilon(1e-3).scale(1.0));
    for (const double side : {-0.02, 0.013}) {
      const double d = side * length;
      const Vec2 p = at.point + d * perp(at.tangent);
      const CurveOffset offset = curve.offset(p);
      CHECK(std::abs(offset.distance - d) < tolerance * length);
      CHECK(distance(offset.normal, perp(at.tangent)) < 100.0 * tolerance);
      CHECK(std::abs(curve.length_to(curve.nearest(p)) - s) < 100.0 * tolerance * length);
    }
  }
}

}  // namespace

TEST_CASE("lines, arcs and paths of them have the geometry of their formulas") {
  check_geometry(line_segment({1.0, 2.0}, {1.3, 1.7}), 1e-14);
  check_geometry(circular_arc({.center = {0.3, -0.2}, .radius = 0.5, .start = 2.9, .angle = 1.4}),
                 1e-14);
  check_geometry(circular_arc({.center = {0.3, -0.2}, .radius = 0.5, .start = 2.9, .angle = -4.4}),
                 1e-14);
  check_geometry(circle({5.0, 1.0}, 0.3), 1e-14);
  const Curve path =
      polyline({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}, {.fillet = 0.25, .closed = true});
  CHECK(path.closed());
  CHECK(path.pieces() == 8);
  CHECK(path.length() == doctest::Approx(4.0 - 8.0 * 0.25 + 0.5 * pi).epsilon(1e-14));
  CHECK(corners_of(path).empty());
  check_geometry(path, 1e-14);
}

TEST_CASE("the curve of a function is that function to rounding, however it is described") {
  const auto ellipse = [](double u) { return Vec2(0.3 * std::cos(u), 0.2 * std::sin(u)); };
  const Curve half = curve_of(ellipse, 0.2, 3.0);
  for (const double u : {0.2, 0.77, 1.9, 3.0}) {
    const Vec2 normal = Vec2(-std::cos(u) / 0.3, -std::sin(u) / 0.2).normalized();
    const double bend = 0.3 * 0.2 / std::pow(std::hypot(0.3 * std::sin(u), 0.2 * std::cos(u)), 3);
    const CurveOffset offset = half.offset(ellipse(u) + 0.05 * normal);
    CHECK(std::abs(offset.distance - 0.05) < 1e-15);
    CHECK(distance(offset.normal, normal) < 1e-12);
    CHECK(offset.curvature == doctest::Approx(bend).epsilon(1e-9));
  }
  check_geometry(half, 1e-13);
  const Curve whole = curve_of(ellipse, 0.0, 2.0 * pi, {.closed = true});
  CHECK(whole.closed());
  CHECK(whole.length() == doctest::Approx(1.5865439589290586).epsilon(1e-14));  // 4 a E(e)
  check_geometry(whole, 1e-13);
}

TEST_CASE("how the curvature of an ellipse changes along it is known exactly") {
  constexpr double a = 0.3, b = 0.2;
  const Curve ellipse = curve_of([](double t) { return Vec2(a * std::cos(t), b * std::sin(t)); },
                                 0.0, 2.0 * pi, {.closed = true});
  for (const double t : {0.0, 0.4, 1.3, 2.2, 4.0, 5.9}) {
    const CurvePlace place = ellipse.nearest(Vec2(a * std::cos(t), b * std::sin(t)));
    const auto change = ellipse.piece(place.piece).curvature_change(place.u);
    REQUIRE(change);
    // With w the square of the speed, k = a b w^(-3/2).
    const double w = a * a * std::sin(t) * std::sin(t) + b * b * std::cos(t) * std::cos(t);
    const double w1 = (a * a - b * b) * std::sin(2.0 * t),
                 w2 = 2.0 * (a * a - b * b) * std::cos(2.0 * t);
    const double first = -1.5 * a * b * w1 / std::pow(w, 3.0);
    const double second = -1.5 * a * b * (w2 - 3.0 * w1 * w1 / w) / std::pow(w, 3.5);
    // The curve is the ellipse to rounding; each derivative makes more of it.
    CHECK(change->first == doctest::Approx(first).epsilon(1e-8).scale(10.0));
    CHECK(change->second == doctest::Approx(second).epsilon(1e-6).scale(100.0));
  }
  for (const Curve& even : {line_segment({0.0, 0.0}, {1.0, 2.0}), circle({0.0, 0.0}, 0.3)}) {
    const auto change = even.piece(0).curvature_change(0.1);
    REQUIRE(change);
    // The curve is the ellipse to rounding; each derivative makes more of it.
    CHECK(change->first == 0.0);
    CHECK(change->second == 0.0);
  }
}

TEST_CASE("a spline converges to the curve its points come from at the order of its degree") {
  const auto wave = [](double u) { return Vec2(u, 0.1 * std::sin(3.0 * u)); };
  for (const int degree : {3, 5}) {
    double before = 0.0;
    for (const int n : {21, 41, 81}) {
      std::vector<Vec2> points;
      for (int i = 0; i < n; ++i) points.push_back(wave(2.0 * i / (n - 1)));
      const Curve spline = curve_through(points, {.degree = degree});
      double worst = 0.0;
      for (int i = 0; i < 500; ++i)
        worst = std::max(worst, std::abs(spline.offset(wave(0.004 * i)).distance));
      if (before > 0.0) CHECK(std::log2(before / worst) > degree + 0.5);
      before = worst;
    }
    CHECK(before < (degree == 3 ? 1e-7 : 1e-9));
  }
}

TEST_CASE("a closed spline has no seam and passes through its points") {
  std::vector<Vec2> points;
  for (int i = 0; i < 40; ++i) {
    const double a = 2.0 * pi * i / 40.0, r = 0.2 + 0.03 * std::cos(3.0 * a);
    points.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  const Curve spline = curve_through(points, {.closed = true});
  CHECK(spline.closed());
  for (const Vec2& p : points) CHECK(std::abs(spline.offset(p).distance) < 1e-15);
  const CurvePoint first = spline.at(0.0), last = spline.at(spline.length());
  CHECK(distance(first.point, last.point) < 1e-14);
  CHECK(distance(first.tangent, last.tangent) < 1e-12);
  CHECK(first.curvature == doctest::Approx(last.curvature).epsilon(1e-9));
  check_geometry(spline, 1e-13);
  // The same points begun elsewhere: the same curve.
  std::rotate(points.begin(), points.begin() + 13, points.end());
  const Curve turned = curve_through(points, {.closed = true});
  for (int i = 0; i < 300; ++i)
    CHECK(std::abs(turned.offset(spline.at(spline.length() * i / 300.0).point).distance) < 1e-14);
}

TEST_CASE("three points make a closed spline and four an open one; a line stays a line") {
  const Curve triangle = curve_through({{0.0, 0.0}, {1.0, 0.0}, {0.5, 0.8}}, {.closed = true});
  CHECK(std::abs(triangle.offset({1.0, 0.0}).distance) < 1e-14);
  const Curve line = curve_through({{0.0, 0.0}, {0.1, 0.05}, {0.3, 0.15}, {1.0, 0.5}});
  CHECK(line.length() == doctest::Approx(std::hypot(1.0, 0.5)).epsilon(1e-14));
  CHECK(std::abs(line.at(0.5).curvature) < 1e-12);
}

TEST_CASE("the nearest point is on the nearest branch, not on a far one") {
  // A spiral whose turns are 0.02 m apart.
  const auto spiral = [](double u) {
    return Vec2((0.05 + 0.02 * u / (2.0 * pi)) * Vec2(std::cos(u), std::sin(u)));
  };
  const Curve curve = curve_of(spiral, 0.0, 8.0 * pi);
  for (int i = 0; i < 2000; ++i) {
    const double s = curve.length() * (i + 0.5) / 2000.0;
    const CurvePoint at = curve.at(s);
    for (const double d : {-0.0095, 0.0095}) {
      const Vec2 p = at.point + d * perp(at.tangent);
      CHECK(std::abs(curve.offset(p).distance) < 0.0095 * (1.0 + 1e-12));
      CHECK(std::abs(curve.length_to(curve.nearest(p)) - s) < 1e-9);
    }
  }
}

TEST_CASE("curves are moved without loss, however far") {
  const auto wave = [](double u) { return Vec2(u, 0.1 * std::sin(3.0 * u)); };
  const Curve curve = curve_of(wave, 0.0, 2.0), far = curve.moved(0.0, {1024.0, 2048.0});
  const Vec2 p(0.625, 0.125);
  CHECK(far.offset(p + Vec2(1024.0, 2048.0)).distance == curve.offset(p).distance);
  const Curve turned = curve.moved(0.7, {0.3, 0.1});
  CHECK(std::abs(turned.offset(rotate(0.7, p) + Vec2(0.3, 0.1)).distance -
                 curve.offset(p).distance) < 1e-15);
}

TEST_CASE("what is no curve is refused with what is wrong") {
  using tests::message_of;
  CHECK(message_of([] {
          line_segment({1.0, 1.0}, {1.0, 1.0});
        }).find("length = 0 m") != std::string::npos);
  CHECK(message_of([] {
          curve_through({{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}, {2.0, 1.0}});
        }) == "curve through points: points 2 and 3 are the same");
  CHECK(message_of([] {
          curve_through({{0.0, 0.0}, {1.0, 0.0}, {2.0, 1.0}});
        }) == "curve through points: 3 points are too few; at least 4");
  CHECK(message_of([] {
          curve_of([](double u) { return Vec2(u, std::abs(u - 0.3)); }, 0.0, 1.0);
        }).find("it is not smooth near u = 0.3") != std::string::npos);
  CHECK(message_of([] {
          curve_of([](double u) { return Vec2(u - std::sin(u), 1.0 - std::cos(u)); }, 0.0, 3.0);
        }).find("it stands still at u = 0") != std::string::npos);
  CHECK(message_of([] {
          polyline({{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.1}, {2.0, 0.1}}, {.fillet = 0.08});
        }).find("side 2 of 0.1 m is too short") != std::string::npos);
  CHECK(message_of([] {
          chain({line_segment({0.0, 0.0}, {1.0, 0.0}), line_segment({1.1, 0.0}, {2.0, 0.0})});
        }).find("piece 2 begins 0.1 m from the end of piece 1") != std::string::npos);
  const Curve eight = curve_of([](double u) { return Vec2(std::sin(u), std::sin(2.0 * u)); }, 0.1,
                               0.1 + 2.0 * pi, {.closed = true});
  CHECK(message_of([&] {
          require_simple("track", eight);
        }).find("track: the curve crosses itself") == 0);
}

TEST_CASE("a function that has a corner or a jump of curvature is refused, wherever it is") {
  using tests::message_of;
  for (const double at : {0.0, 0.25, 0.3123}) {  // the first two are where polynomials meet
    CAPTURE(at);
    CHECK(message_of([&] {
            curve_of([&](double u) { return Vec2(u, std::abs(u - at)); }, -1.0, 1.0);
          }) != "no error");
    CHECK(message_of([&] {
            curve_of([&](double u) { return Vec2(u, u < at ? 0.0 : (u - at) * (u - at)); }, -1.0,
                     1.0);
          }) != "no error");
    // A cusp, between any points at which the function is looked at.
    CHECK(message_of([&] {
            curve_of([&](double u) { return Vec2(std::pow(u - at, 2), std::pow(u - at, 3)); }, -1.0,
                     1.0);
          }).find("it stands still at u = ") != std::string::npos);
  }
  CHECK(message_of([] {  // a drop: its ends meet at an angle
          curve_of([](double u) { return Vec2(0.2 * std::sin(0.5 * u), 0.05 * std::sin(u)); }, 0.0,
                   2.0 * pi, {.closed = true});
        })
            .find("it turns by -2.2143 rad at u = 6.28319") != std::string::npos);
  CHECK(message_of([] { curve_of({}, 0.0, 1.0); }) == "curve of a function: no function is given");
  CHECK(message_of([] {
          curve_through({{0.0, 0.0}, {0.1, std::nan("")}, {0.2, 0.0}, {0.3, 0.1}});
        }) == "curve through points: point 2 y = nan must be a finite number");
}

TEST_CASE("how fast a function runs along its curve does not matter") {
  // A circle of radius 1 passed 1e5 times as fast at the end as at the start.
  const Curve arc = curve_of(
      [](double u) {
        const double a = std::pow(u, 5);
        return Vec2(std::cos(a), std::sin(a));
      },
      0.05, 1.0);
  CHECK(arc.length() == doctest::Approx(1.0 - std::pow(0.05, 5)).epsilon(1e-14));
  for (int i = 0; i <= 100; ++i) {
    const CurvePoint at = arc.at(arc.length() * i / 100.0);
    CHECK(at.curvature == doctest::Approx(1.0).epsilon(1e-9));
    CHECK(at.point.norm() == doctest::Approx(1.0).epsilon(1e-14));
  }
  // Where it bends too sharply for that it stays as it is.
  const Curve sharp = curve_of(
      [](double u) { return Vec2(u - 0.99 * std::sin(u), -0.99 * std::cos(u)); }, -1.0, 1.0);
  const CurvePoint vertex = sharp.at(0.5 * sharp.length());
  CHECK(vertex.curvature == doctest::Approx(0.99 / (0.01 * 0.01)).epsilon(1e-6));
}

TEST_CASE("a parameter that is large is not taken for roughness; tight turns do not cross") {
  const auto f = [](double u) { return Vec2(0.001 * u * Vec2(std::cos(u), std::sin(u))); };
  const auto length = [](double u) {
    return 0.0005 * (u * std::sqrt(1.0 + u * u) + std::asinh(u));
  };
  const Curve spiral = curve_of(f, 5.0, 200.0);
  CHECK(spiral.length() == doctest::Approx(length(200.0) - length(5.0)).epsilon(1e-12));
  CHECK(tests::message_of([&] { require_simple("track", spiral); }) == "no error");
  // A loop a thousandth as long as the track.
  const Curve looped = chain({line_segment({-1.0, 0.0}, {0.0, 0.0}),
                              circular_arc({{0.0, 2e-4}, 2e-4, -pi / 2.0, 1.5 * pi}),
                              line_segment({-2e-4, 2e-4}, {-2e-4, -1.0})});
  CHECK(tests::message_of([&] {
          require_simple("track", looped);
        }).find("track: the curve crosses itself") == 0);
}

TEST_CASE("a straight line does not cross itself, whatever its direction") {
  for (int i = 0; i < 720; ++i) {
    const Vec2 along = rotate(i * pi / 360.0, {1.0, 0.0});
    CHECK(yoke::tests::message_of([&] {
            require_simple("track", line_segment(0.08 * along, 0.32 * along));
          }) == "no error");
  }
  const Vec2 up(std::cos(0.5 * pi), std::sin(0.5 * pi));  // not quite upright
  CHECK(yoke::tests::message_of(
            [&] { require_simple("track", line_segment(0.08 * up, 0.32 * up)); }) == "no error");
}

TEST_CASE("a long straight side does not cross itself, whatever its direction") {
  for (int i = 0; i < 360; ++i) {
    CAPTURE(i);
    std::vector<Vec2> points;
    for (const Vec2& p : {Vec2(0.0, 0.0), Vec2(3.0, 0.0), Vec2(3.0, 1.0), Vec2(0.0, 1.0)})
      points.push_back(rotate(i * pi / 180.0, p));
    CHECK_NOTHROW(require_simple("track", polyline(points, {.fillet = 0.1, .closed = true})));
    // The same with a side that goes back over another.
    std::swap(points[2], points[3]);
    CHECK_THROWS_AS(require_simple("track", polyline(points, {.closed = true})), ModelError);
  }
}

TEST_CASE("absorber paths have Denman's radius of curvature, the tautochrone its distance") {
  for (const double n : {1.0, 2.0, 3.5})
    for (const double lambda : {0.0, 0.4, tautochronic_lambda(n), 1.0}) {
      const Vec2 axis(0.3, -0.1);
      const double R0 = 0.125, rho0 = R0 / (1.0 + n * n), reach = 0.8 * rho0;
      const Curve path = absorber_path({.center = axis,
                                        .direction = 0.7,
                                        .distance = R0,
                                        .order = n,
                                        .lambda = lambda,
                                        .reach = reach});
      CHECK(path.length() == doctest::Approx(2.0 * reach).epsilon(1e-13));
      for (const double s : {-0.79 * rho0, -0.3 * rho0, 0.0, 0.5 * rho0}) {
        const CurvePoint at = path.at(s + reach);
        const double rho = std::sqrt(rho0 * rho0 - lambda * lambda * s * s);
        CHECK(at.curvature == doctest::Approx(1.0 / rho).epsilon(1e-9));
        if (lambda == tautochronic_lambda(n))
          CHECK((at.point - axis).squaredNorm() ==
                doctest::Approx(R0 * R0 - n * n * s * s).epsilon(1e-13));
      }
    }
  CHECK(tests::message_of([] {
          absorber_path({.distance = 0.1, .order = 2.0, .lambda = 1.0, .reach = 0.02});
        }).find("reach = 0.02 m is outside the accepted range 0 to 0.0196 m") != std::string::npos);
}
