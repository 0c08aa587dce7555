// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Drivers that run into a dead point: every formulation says so, and where, as kinematics() does.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <yoke/integrators/analyses/kinematics.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/tests/integrators/analyses/analysed.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// A crank longer than its rod: it can turn as far as the rod is square to the guide.
const SliderCrankOptions too_long{.crank = 0.13, .rod = 0.12, .angle = 0.3, .omega = 10.0};
const double t_dead = (std::asin(0.12 / 0.13) - 0.3) / 10.0;

double time_in(const std::string& message) {
  const std::string words = "dead point at t = ";
  const auto place = message.find(words);
  return place == std::string::npos ? std::nan("")
                                    : std::stod(message.substr(place + words.size()));
}

}  // namespace

TEST_CASE("a dead point: simulate gives the message of kinematics, in every formulation") {
  const Model m = slider_crank(too_long);
  const Result exact = kinematics(m, {.until = 1.0, .samples = 3});
  CHECK(std::abs(exact.summary.t_end - t_dead) < 1e-9);
  CHECK_MESSAGE(std::abs(time_in(exact.summary.reason) - t_dead) < 1e-9, exact.summary.reason);
  for (const std::string& formulation : every_formulation)
    for (const double tolerance : {1e-4, 1e-9}) {
      INFO(formulation << " at " << tolerance);
      const Result run =
          simulate(m, {.until = 1.0, .relative_tolerance = tolerance, .formulation = formulation});
      CHECK(run.summary.stop == Stop::failed);
      CHECK(run.summary.reason == exact.summary.reason);
    }
}

TEST_CASE("a dead point is found where something else moves freely, with links of any mass") {
  for (const double ratio : {1.0, 1e-5}) {
    Model m;
    const Model whole = slider_crank(too_long);
    for (std::size_t i = 1; i < whole.bodies().size(); ++i) {
      Body body = whole.bodies()[i];
      if (body.name == "rod") body.mass *= ratio, body.inertia *= ratio;
      m.add(body);
    }
    const BodyId crank = m.find_body("crank"), rod = m.find_body("rod"),
                 slider = m.find_body("slider");
    const Vec2 pin = 2.0 * m.body(crank).pose.position, end = m.body(slider).pose.position;
    m.add(Revolute{"pivot", ground, crank, {0.0, 0.0}});
    m.add(Revolute{"crank pin", crank, rod, pin});
    m.add(Revolute{"slider pin", rod, slider, end});
    m.add(Prismatic{.name = "guide", .a = ground, .b = slider});
    m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(0.3, 10.0)});
    const BodyId bob = m.add(
        Body{.name = "bob", .mass = 0.1, .inertia = 1e-4, .pose = {end + Vec2(0.02, -0.05), 0.0}});
    m.add(Revolute{"hook", slider, bob, end});
    m.add(Gravity{});
    for (const std::string& formulation : every_formulation) {
      INFO(formulation << ", ratio " << ratio);
      const Result run = simulate(m, {.until = 1.0, .formulation = formulation});
      CHECK_MESSAGE(std::abs(time_in(run.summary.reason) - t_dead) < 1e-9, run.summary.reason);
    }
  }
}

TEST_CASE("a force without a limit is not blamed on the tolerance, nor on the driver") {
  Model m = slider_crank({.angle = 0.3, .omega = 10.0, .driven = false});
  m.add(AppliedForce{.name = "pull",
                     .body = m.find_body("slider"),
                     .at = m.body(m.find_body("slider")).pose.position,
                     .force = [](double t) { return Vec2(1.0 / std::abs(0.1 - t), 0.0); }});
  for (const std::string& formulation : both_formulations) {
    INFO(formulation);
    const Result run = simulate(m, {.until = 0.2, .formulation = formulation});
    if (run.summary.ok()) continue;  // a step may pass over the pole
    CHECK_MESSAGE(!contains(run.summary.reason, "too tight"), run.summary.reason);
    CHECK_MESSAGE(!contains(run.summary.reason, "dead point"), run.summary.reason);
  }
}
