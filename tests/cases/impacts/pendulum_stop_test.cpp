// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The pendulum at a stop against its own equation, integrated by Runge and Kutta's method.
#include <doctest/doctest.h>

#include <cmath>

#include <yoke/tests/cases/impacts/impact_case.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using yoke::tests::contains;
using yoke::tests::impact_run;
using yoke::tests::message_of;

struct Swing {
  double angle, omega;
};

/// [s] until a pendulum of rate w falls through `stop`; `at` becomes its state there.
double time_to_stop(double w, double stop, Swing& at) {
  const double h = 1e-5;
  const auto slope = [&](const Swing& s) { return Swing{s.omega, -w * w * std::sin(s.angle)}; };
  const auto moved = [](const Swing& s, double by, const Swing& d) {
    return Swing{s.angle + by * d.angle, s.omega + by * d.omega};
  };
  for (double t = 0.0; t < 100.0; t += h) {
    const Swing k1 = slope(at), k2 = slope(moved(at, 0.5 * h, k1)),
                k3 = slope(moved(at, 0.5 * h, k2)), k4 = slope(moved(at, h, k3));
    const Swing next{at.angle + h / 6.0 * (k1.angle + 2.0 * (k2.angle + k3.angle) + k4.angle),
                     at.omega + h / 6.0 * (k1.omega + 2.0 * (k2.omega + k3.omega) + k4.omega)};
    if (next.angle <= stop && next.omega < 0.0) {
      // Within a step of 10 us the angle is a parabola to 1e-15.
      const double a = slope(at).omega, gone = at.angle - stop;
      const double rest = (-at.omega - std::sqrt(at.omega * at.omega - 2.0 * a * gone)) / a;
      const double part = std::abs(a) < 1e-9 ? -gone / at.omega : rest;
      at = {stop, at.omega + part * a};
      return t + part;
    }
    at = next;
  }
  return -1.0;
}

constexpr double deg = pi / 180.0;

TEST_CASE("pendulum at a stop: impacts come when its own equation says") {
  constexpr double w2 = 9.81 * 0.25 / (0.5 * 0.02 * 0.02 + 0.25 * 0.25);
  for (const double stop : {-30.0, 0.0, 20.0}) {
    CAPTURE(stop);
    const auto run = impact_run("pendulum_stop", {fmt::format("stop={}deg", stop), "duration=2.5s"},
                                "", {.relative_tolerance = 1e-10});
    const std::vector<Impact> impacts = impacts_of(run.result, "stop");
    REQUIRE(impacts.size() >= 2);
    Swing s{60.0 * deg, 0.0};
    CHECK(impacts[0].start ==
          doctest::Approx(time_to_stop(std::sqrt(w2), stop * deg, s)).epsilon(1e-8));
    CHECK(impacts[0].approach == doctest::Approx(-0.25 * s.omega).epsilon(1e-8));
    for (std::size_t i = 1; i < impacts.size(); ++i) {
      s = {stop * deg, impacts[i - 1].rebound / 0.25};
      const double flight = impacts[i].start - impacts[i - 1].end;
      CHECK(flight == doctest::Approx(time_to_stop(std::sqrt(w2), stop * deg, s)).epsilon(1e-7));
    }
  }
}

TEST_CASE("pendulum at a stop: a small swing beats half as long as it would swing") {
  const double w = std::sqrt(9.81 * 0.25 / (0.5 * 0.02 * 0.02 + 0.25 * 0.25));
  const auto run =
      impact_run("pendulum_stop", {"stop=0deg", "start=1deg", "restitution=1", "stiffness=1e13"});
  const std::vector<Impact> impacts = impacts_of(run.result, "stop");
  REQUIRE(impacts.size() >= 5);
  // theta^2/16 of the amplitude, 2e-5, is what the elliptic integral adds.
  for (std::size_t i = 1; i < impacts.size(); ++i)
    CHECK(impacts[i].start - impacts[i - 1].end == doctest::Approx(pi / w).epsilon(3e-5));
}

TEST_CASE("pendulum at a stop: its swing tends to the one that just reaches the stop") {
  const auto run = impact_run("pendulum_stop", {"duration=10s", "restitution=0.5"});
  const Eigen::VectorXd angle = run.result["pendulum.angle_rad"];
  CHECK(angle.minCoeff() > -10.0 * deg - 3e-3);  // 0.7 mm of penetration
  const std::vector<Impact> impacts = impacts_of(run.result, "stop");
  REQUIRE(impacts.size() >= 8);
  // Each impact has half the speed of the one before; gravity takes g T sin(10 deg) at most.
  for (std::size_t i = 1; i < impacts.size(); ++i) {
    const double pull = 9.81 * (impacts[i - 1].end - impacts[i - 1].start) * std::sin(10.0 * deg);
    CHECK(std::abs(impacts[i].approach - 0.5 * impacts[i - 1].approach) < pull);
  }
  CHECK(angle.tail(angle.size() / 5).maxCoeff() == doctest::Approx(10.0 * deg).epsilon(2e-3));
}

TEST_CASE("pendulum at a stop: what does not fit is refused") {
  const Case& c = find_case("pendulum_stop");
  const auto refusal = [&](const std::vector<std::string>& settings) {
    return message_of([&] { make_model(c, Parameters(c.parameters, settings)); });
  };
  CHECK(contains(refusal({"start=-20deg"}), "start = -20 deg must be greater than stop = -10 deg"));
  CHECK(contains(refusal({"stop=-70deg"}), "stop = -70 deg must be above -60 deg"));
  CHECK(contains(refusal({"radius=300mm"}), "radius = 300 mm must be less than length = 250 mm"));
}

}  // namespace
