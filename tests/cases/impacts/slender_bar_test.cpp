// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The dropped bar against its equations of motion, integrated by Runge and Kutta's method.
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include <yoke/tests/cases/impacts/impact_case.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using yoke::tests::contains;
using yoke::tests::impact_run;
using yoke::tests::message_of;

using BarState = std::array<double, 4>;  // y of the middle, angle, and their rates

/// The bar of the case, elastic: K d^1.5 at each end.
struct Bar {
  double length = 0.2, radius = 6.5e-3, K = 1e9;
  double mass = 7850.0 * pi * radius * radius * length;
  double inertia = mass * length * length / 12.0;

  BarState slope(const BarState& s) const {
    BarState d{s[2], s[3], -9.81, 0.0};
    for (const double side : {-0.5, 0.5}) {
      const double arm = side * length * std::cos(s[1]);
      const double in = radius - s[0] - side * length * std::sin(s[1]);
      if (!(in > 0.0)) continue;
      const double force = K * in * std::sqrt(in);
      d[2] += force / mass;
      d[3] += arm * force / inertia;
    }
    return d;
  }
  BarState after(BarState s, double time, int steps) const {
    const double h = time / steps;
    const auto moved = [](const BarState& y, double by, const BarState& d) {
      BarState sum = y;
      for (std::size_t i = 0; i < 4; ++i) sum[i] += by * d[i];
      return sum;
    };
    for (int i = 0; i < steps; ++i) {
      const BarState k1 = slope(s), k2 = slope(moved(s, 0.5 * h, k1)),
                     k3 = slope(moved(s, 0.5 * h, k2)), k4 = slope(moved(s, h, k3));
      for (std::size_t j = 0; j < 4; ++j) s[j] += h / 6.0 * (k1[j] + 2.0 * (k2[j] + k3[j]) + k4[j]);
    }
    return s;
  }
};

TEST_CASE("slender bar: one end, both ends one behind the other, and both at once") {
  const Bar bar;
  for (const double degrees : {0.0, 0.05, 0.3, 2.0, 20.0, 45.0, 75.0, 90.0}) {
    CAPTURE(degrees);
    const double until = 0.125;  // the lower end meets the floor at 0.101 s
    const auto run = impact_run("slender_bar", {fmt::format("angle={}deg", degrees)}, "elastic",
                                {.until = until, .relative_tolerance = 1e-10});
    const double angle = degrees * pi / 180.0;
    const BarState start{0.05 + bar.radius + 0.5 * bar.length * std::sin(angle), angle, 0.0, 0.0};
    const BarState end = bar.after(start, until, 200000);
    const Eigen::Index last = static_cast<Eigen::Index>(run.result.samples.rows()) - 1;
    CHECK(std::abs(run.result["bar.y_m"][last] - end[0]) < 1e-8);
    CHECK(std::abs(run.result["bar.angle_rad"][last] - end[1]) < 1e-7);
    CHECK(std::abs(run.result["bar.vy_m_per_s"][last] - end[2]) < 1e-6);
    CHECK(std::abs(run.result["bar.omega_rad_per_s"][last] - end[3]) < 1e-5);
  }
}

TEST_CASE("slender bar: apparent restitution over the angle, with a stiff floor") {
  constexpr double e = 0.8;
  for (const double degrees : {10.0, 30.0, 50.0, 70.0, 90.0}) {
    CAPTURE(degrees);
    const auto run =
        impact_run("slender_bar", {fmt::format("angle={}deg", degrees), "stiffness=1e13"},
                   "restitution", {.until = 0.102, .samples = 5001});
    const double c = std::cos(degrees * pi / 180.0), v = std::sqrt(2.0 * 9.81 * 0.05);
    const Eigen::Index last = static_cast<Eigen::Index>(run.result.samples.rows()) - 1;
    const double since = 0.102 - impacts_of(run.result, "lower end").front().end;
    const double apparent = (run.result["bar.vy_m_per_s"][last] + 9.81 * since) / v;
    CHECK(std::abs(apparent - ((1.0 + e) / (1.0 + 3.0 * c * c) - 1.0)) < 2e-3);
  }
}

TEST_CASE("slender bar: what does not fit is refused") {
  const Case& c = find_case("slender_bar");
  CHECK(contains(message_of([&] { make_model(c, Parameters(c.parameters, {"radius=60mm"})); }),
                 "length = 200 mm must be at least 240 mm"));
}

}  // namespace
