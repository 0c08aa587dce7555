// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Points of sections where closed forms say where they are, by every formulation.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/integrators/studies/maps/poincare.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/wall.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using yoke::tests::contains;
using yoke::tests::every_formulation;
using yoke::tests::message_of;

constexpr double rate = 3.0, decay = 0.2;  // [rad/s], [1/s] of the oscillator

/// x'' + 2 decay x' + (rate^2 + decay^2) x = 0 from x = 1 at rest relative to its envelope.
Model oscillator() {
  Model m;
  const BodyId mass = m.add(Body{.name = "mass",
                                 .mass = 1.0,
                                 .inertia = 1.0,
                                 .pose = {{1.0, 0.0}, 0.0},
                                 .twist = {{-decay, 0.0}, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = mass});
  m.add(applied_force("spring", mass, {1.0, 0.0}, [](auto, const auto& b) {
    return vec(-(rate * rate + decay * decay) * b.x - 2.0 * decay * b.vx, 0.0 * b.x);
  }));
  return m;
}
double position(double t) { return std::exp(-decay * t) * std::cos(rate * t); }

Poincare points_of(Model& m, const Section& section, PoincareOptions options) {
  m.add(section);
  options.columns = {"mass.x_m", "mass.vx_m_per_s"};
  options.run.relative_tolerance = 1e-9;
  return poincare(m, section, options);
}

Model turning_crank(double start, double speed) {
  Model m;
  const BodyId crank =
      m.add(Body{.name = "crank", .mass = 1.0, .inertia = 1.0, .pose = {{0.0, 0.0}, start}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(start, speed)});
  return m;
}

TEST_SUITE("poincare") {
  TEST_CASE("a section by a period has its points at offset + k period, by every formulation") {
    for (const std::string& name : every_formulation) {
      CAPTURE(name);
      Model m = oscillator();
      const Section section = Section::every(0.7, 0.1);
      const Poincare map =
          points_of(m, section, {.discard = 2, .points = 5, .run = {.formulation = name}});
      CHECK(map.complete);
      CHECK(map.discarded == 2);
      REQUIRE(map.points.rows() == 5);
      const double tolerance = name == "generalised-alpha" ? 1e-5 : 1e-7;
      for (std::size_t i = 0; i < 5; ++i) {
        const double t = 0.1 + 0.7 * static_cast<double>(i + 2);
        CHECK(map.points.value(i, 0) == doctest::Approx(t).epsilon(1e-14));
        CHECK(std::abs(map.points.value(i, 1) - position(t)) < tolerance);
      }
      CHECK(map.last.t == map.points.value(4, 0));
      CHECK(map.last.q[0] == map.points.value(4, 1));
    }
  }

  TEST_CASE("a plane is passed where the closed form says, in the direction asked for") {
    for (const std::string& name : every_formulation) {
      CAPTURE(name);
      for (const Crossing crossing : {Crossing::upwards, Crossing::downwards, Crossing::both}) {
        if (crossing != Crossing::upwards && name != every_formulation.front()) continue;
        Model m = oscillator();
        const Section section = Section::plane({{"mass.x_m"}}, 0.0, crossing);
        const Poincare map =
            points_of(m, section,
                      {.discard = 0, .points = 4, .duration = 20.0, .run = {.formulation = name}});
        REQUIRE(map.points.rows() == 4);
        // cos(rate t) falls through zero at pi/2, rises at 3 pi/2 ...
        const double first = crossing == Crossing::upwards ? 1.5 * pi : 0.5 * pi,
                     next = crossing == Crossing::both ? pi : 2.0 * pi;
        const double tolerance = name == "generalised-alpha" ? 1e-4 : 1e-7;
        for (std::size_t i = 0; i < 4; ++i) {
          const double t = (first + next * static_cast<double>(i)) / rate;
          CHECK(std::abs(map.points.value(i, 0) - t) < tolerance);
          CHECK(std::abs(map.points.value(i, 1)) < 1e-12);  // on the plane itself
        }
      }
    }
  }

  TEST_CASE("a plane may be a combination of coordinates and velocities") {
    Model m = oscillator();
    // x' + decay x = -rate exp(-decay t) sin(rate t)
    const Section section = Section::plane({{"mass.vx_m_per_s", 1.0}, {"mass.x_m", decay}}, 0.0);
    const Poincare map = points_of(m, section, {.discard = 0, .points = 3, .duration = 20.0});
    REQUIRE(map.points.rows() == 3);
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(std::abs(map.points.value(i, 0) - (2.0 * static_cast<double>(i) + 1.0) * pi / rate) <
            1e-7);
  }

  TEST_CASE("a driver passes an angle once a turn, whatever its start and sense") {
    for (const double speed : {5.0, -5.0}) {
      Model m = turning_crank(0.3, speed);
      const Crossing sense = speed > 0.0 ? Crossing::upwards : Crossing::downwards;
      const Section section = Section::phase("motor", 1.0, sense);
      m.add(section);
      const Poincare map = poincare(m, section, {.discard = 0, .points = 6, .duration = 20.0});
      REQUIRE(map.points.rows() == 6);
      const double first = speed > 0.0 ? 0.7 : 2.0 * pi - 0.7;
      for (std::size_t i = 0; i < 6; ++i)
        CHECK(map.points.value(i, 0) ==
              doctest::Approx((first + 2.0 * pi * static_cast<double>(i)) / 5.0).epsilon(1e-12));
      CHECK(map.period == 1);  // the angle counts up to turns
      Model other = turning_crank(0.3, speed);
      const Section against =
          Section::phase("crank", 1.0, speed > 0.0 ? Crossing::downwards : Crossing::upwards);
      other.add(against);
      const Poincare none = poincare(other, against, {.points = 1, .duration = 5.0});
      CHECK(none.points.rows() == 0);
      CHECK(contains(none.reason, "0 of 101 points in 5 s"));
    }
  }

  TEST_CASE("a section does not change the run") {
    Model with = yoke::tests::double_pendulum();
    const Section section = Section::plane({{"a.angle_rad"}}, -1.0, Crossing::downwards);
    with.add(section);
    const Poincare map = poincare(with, section, {.discard = 0, .points = 3, .duration = 20.0});
    REQUIRE(map.points.rows() == 3);
    const Model without = yoke::tests::double_pendulum();
    const Result run = simulate(without, {.until = map.last.t, .samples = 2});
    CHECK((run.final.q - map.last.q).cwiseAbs().maxCoeff() < 1e-6);
  }

  TEST_CASE("events of a contact are points with their speed") {
    const double height = 0.2;
    Model m;
    const BodyId ball = m.add(
        Body{.name = "ball", .mass = 0.1, .inertia = 1e-5, .pose = {{0.0, 0.02 + height}, 0.0}});
    m.add(Gravity{});
    m.add(DiscOnCurve{.name = "floor",
                      .disc = {ball, {0.0, 0.02 + height}, 0.02},
                      .body = ground,
                      .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                      .law = ContactLaw{PowerLaw{1e8, 1.5}}});
    const Section section = Section::at_event("floor", "onset");
    const Poincare map = poincare(m, section, {.discard = 1, .points = 3, .duration = 5.0});
    REQUIRE(map.points.rows() == 3);
    for (std::size_t i = 0; i < 3; ++i)  // without loss every impact is as the first
      CHECK(map.points[std::string("speed_m_per_s")][static_cast<Eigen::Index>(i)] ==
            doctest::Approx(std::sqrt(2.0 * 9.81 * height)).epsilon(1e-6));
    CHECK(map.period == 1);
  }

  TEST_CASE("whoever stops it has the points until then") {
    Model m = oscillator();
    const Section section = Section::every(0.5);
    std::size_t seen = 0;
    PoincareOptions options{.discard = 3, .points = 100};
    options.observer = [&](std::size_t points) { return (seen = points) < 7; };
    const Poincare map = points_of(m, section, options);
    CHECK(seen == 7);
    CHECK(map.points.rows() == 4);
    CHECK(!map.complete);
    CHECK(contains(map.reason, "stopped after 7 of 103 points"));
  }

  TEST_CASE("a run that fails keeps its points and says why") {
    Model m = oscillator();
    m.add(
        EventFunction{.name = "late",
                      .function = [](const Motion& at) { return at.t - 2.2; },
                      .action = [](const EventAction&) { throw std::runtime_error("too late"); }});
    const Poincare map = points_of(m, Section::every(0.5), {.discard = 0, .points = 100});
    CHECK(map.points.rows() == 4);
    CHECK(!map.complete);
    CHECK(contains(map.reason, "too late"));
  }

  TEST_CASE("what does not fit is refused by name, value and what is accepted") {
    Model m = turning_crank(0.0, 1.0);
    const auto refusal = [&](const Section& s, const PoincareOptions& options = {}) {
      return message_of([&] { poincare(m, s, options); });
    };
    CHECK(
        contains(refusal(Section::every(0.0)), "period = 0 s must be finite and greater than 0 s"));
    CHECK(
        contains(refusal(Section::phase("moter", 0.0)), "'moter' is neither an angle driver nor"));
    CHECK(contains(refusal(Section::phase("moter", 0.0)), "'motor', 'crank'"));
    CHECK(contains(refusal(Section::at_event("stop", "onset")), "no element 'stop'"));
    CHECK(contains(refusal(Section::plane({}, 0.0)), "needs a column"));
    CHECK(contains(refusal(Section::plane({{"crank.angle"}}, 0.0)), "crank.angle_rad"));
    CHECK(contains(refusal(Section::phase("motor", 0.0), {.duration = 1.0}),
                   "has not been added to the model"));
    CHECK(contains(refusal(Section::phase("motor", 0.0)), "duration = 0 s"));
    CHECK(contains(refusal(Section::every(1.0), {.points = 0}), "points = 0"));
    CHECK(contains(refusal(Section::every(1.0), {.columns = {"crank.z"}}), "crank.x_m"));
  }

  TEST_CASE("the period of points is the smallest after which they repeat") {
    const auto period = [](const std::vector<double>& values, const char* column) {
      Table t;
      t.add_column("t", "s");
      t.add_column(column, "");
      for (const double v : values) {
        double* row = t.append();
        row[0] = static_cast<double>(t.rows());
        row[1] = v;
      }
      return period_of(t, {-1.0, 1e-3});
    };
    CHECK(period({1, 1, 1, 1}, "x") == 1);
    CHECK(period({1, 2, 1, 2, 1}, "x") == 2);
    CHECK(period({1, 2, 3, 1, 2, 3}, "x") == 3);
    CHECK(period({1, 2, 3, 1, 2}, "x") == 0);
    CHECK(period({1, 2, 1, 2.01}, "x") == 0);
    CHECK(period({1, 2, 1, 2.0001}, "x") == 2);
    CHECK(period({0, 2 * pi, 4 * pi}, "a.angle_rad") == 1);
    CHECK(period({0, 2 * pi, 4 * pi}, "x") == 0);
    CHECK(period({1}, "x") == 0);
  }
}

}  // namespace
