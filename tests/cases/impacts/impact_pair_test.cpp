// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The impact pair against a mass between rigid stops, whose impacts are searched for one by one.
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

/// Rigid stops, carrier at sin(t): relative speeds of `count` impacts of a mass that starts in the
/// middle as fast as the carrier.
std::vector<double> rigid_impacts(double e, double gap, int count) {
  double t = 0.0, x = 0.0, v = 1.0;
  std::vector<double> speeds;
  for (int i = 0; i < count; ++i) {
    const auto outside = [&](double at) {  // > 0 in a stop
      return std::abs(x + v * (at - t) - std::sin(at)) - gap;
    };
    double low = t + 1e-6;
    while (outside(low + 1e-4) < 0.0) low += 1e-4;
    double high = low + 1e-4;
    for (int k = 0; k < 60; ++k) {
      const double mid = 0.5 * (low + high);
      (outside(mid) < 0.0 ? low : high) = mid;
    }
    x += v * (low - t);
    t = low;
    const double relative = v - std::cos(t);
    speeds.push_back(std::abs(relative));
    v = std::cos(t) - e * relative;
  }
  return speeds;
}

double mean_speed(const Result& run) {
  std::vector<Impact> impacts = impacts_of(run, "left stop");
  REQUIRE(impacts.size() > 10);
  double sum = 0.0;
  for (std::size_t i = impacts.size() - 5; i < impacts.size(); ++i)
    sum += impacts[i].approach / 5.0;
  return sum;
}

TEST_CASE("impact pair: the stiffer the stops, the nearer to rigid ones, in proportion") {
  const double Aw = 1e-3 * 2.0 * pi * 20.0;
  const std::vector<double> rigid = rigid_impacts(0.5, 2.0, 400);
  const double speed = rigid.back() * Aw;
  CHECK(rigid[398] == doctest::Approx(rigid[399]).epsilon(1e-9));  // it settles
  double before = 0.0;
  // The duration of an impact is as K^(-2/5): by 4 from one to the next.
  for (const double stiffness : {1e9, 32e9, 1024e9}) {
    const auto run = impact_run("impact_pair", {fmt::format("stiffness={}", stiffness)});
    REQUIRE(run.checks.size() == 3);
    const double off = mean_speed(run.result) - speed;
    CHECK(std::abs(off) < 0.03 * speed);
    if (before != 0.0) CHECK(before / off == doctest::Approx(4.0).epsilon(0.1));
    before = off;
  }
  CHECK(std::abs(before) < 1e-3 * speed);
}

TEST_CASE("impact pair: from the middle it settles into the same motion, under other laws too") {
  for (const char* law : {"restitution", "hunt-crossley", "power:K=1e10,n=1.5+hu-guo:e=0.5"}) {
    const auto run =
        impact_run("impact_pair", {"start=centre", "periods=100"}, law, {.samples = 20001});
    CHECK(run.checks.size() == 3);  // it settled, and has the speed of the closed form
    // Never outside: gap, and the penetration.
    const Eigen::VectorXd play = run.result["mass.x_m"] - run.result["carrier.x_m"];
    CHECK(play.cwiseAbs().maxCoeff() < 2.1e-3);
    CHECK(play.cwiseAbs().maxCoeff() > 2e-3);
  }
}

TEST_CASE("impact pair: what does not fit is refused") {
  const Case& c = find_case("impact_pair");
  const auto refusal = [&](const std::vector<std::string>& settings) {
    return message_of([&] { make_model(c, Parameters(c.parameters, settings)); });
  };
  // sqrt(1 + (3 pi/2)^2) = 4.8173
  CHECK(contains(refusal({"gap=5mm"}), "gap = 5 mm must be less than 4.8173"));
  CHECK(contains(refusal({"restitution=1"}), "restitution 1 less than 1"));
}

}  // namespace
