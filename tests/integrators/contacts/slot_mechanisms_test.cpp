// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Pins in slots against an integration by hand, and what comes into a slot from behind its walls.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/contact/geometry/curve_slot.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::tests;
using namespace yoke::literals;

namespace {

using Y = std::array<double, 4>;  // x, y, vx, vy of the pin

/// Dormand and Prince's pair of order 5(4); its error control alone finds the touches.
template <class F>
Y integrated(const F& rates, Y y, double until, double tolerance) {
  constexpr double A[7][6] = {{},
                              {1. / 5},
                              {3. / 40, 9. / 40},
                              {44. / 45, -56. / 15, 32. / 9},
                              {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
                              {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
                              {35. / 384, 0.0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}};
  constexpr double E[7] = {71. / 57600,      0.0,       -71. / 16695, 71. / 1920,
                           -17253. / 339200, 22. / 525, -1. / 40};
  std::array<Y, 7> k{};
  double t = 0.0, step = 1e-8;
  while (t < until) {
    step = std::min(step, until - t);
    Y stage = y;
    for (int s = 0; s < 7; ++s) {
      stage = y;
      for (int j = 0; j < s; ++j)
        for (std::size_t i = 0; i < 4; ++i)
          stage[i] += step * A[s][j] * k[static_cast<std::size_t>(j)][i];
      k[static_cast<std::size_t>(s)] = rates(stage);
    }
    double error = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      double sum = 0.0;
      for (int s = 0; s < 7; ++s) sum += step * E[s] * k[static_cast<std::size_t>(s)][i];
      error = std::max(error, std::abs(sum) / (tolerance * (1e-6 + std::abs(y[i]))));
    }
    if (error <= 1.0 || step < 1e-15) t += step, y = stage;
    step = std::min(1e-4, step * std::clamp(0.9 * std::pow(error + 1e-30, -0.2), 0.2, 4.0));
  }
  return y;
}

}  // namespace

TEST_CASE("a pin in an S of lines and arcs moves as an integration by hand says") {
  const double h = 5.0_mm, pin = 4.5_mm, mass = 0.1, K = 1e7, alpha = 0.2;
  Model m;
  const BodyId body = m.add({.name = "pin",
                             .mass = mass,
                             .inertia = 1e-6,
                             .pose = {{0.24, 0.1}, 0.0},
                             .twist = {{-0.8, 0.0}, 0.0}});
  m.add(Gravity{});
  const Curve s = polyline({{0.0, 0.0}, {0.13, 0.0}, {0.13, 0.1}, {0.26, 0.1}}, {.fillet = 0.03});
  m.add(PinInSlot{.name = "slot",
                  .pin = {body, {0.24, 0.1}, pin},
                  .slot = {ground, curve_slot({.centreline = s, .half_width = h})},
                  .law = ContactLaw{PowerLaw{K, 1.5}, HuntCrossley{alpha}}});

  // Distance from the centreline, worked out by hand: two lines across, one up, two quarter circles.
  const auto rates = [&](const Y& y) {
    Vec2 away(0.0, 0.0);
    const Vec2 p(y[0], y[1]), low(0.1, 0.03), high(0.16, 0.07);
    if (p.y() < 0.05 && p.x() <= low.x())
      away = {0.0, p.y()};
    else if (p.y() > 0.05 && p.x() >= high.x())
      away = {0.0, p.y() - 0.1};
    else if (p.y() < low.y())
      away = (p - low) * (1.0 - 0.03 / (p - low).norm());
    else if (p.y() > high.y())
      away = (p - high) * (1.0 - 0.03 / (p - high).norm());
    else
      away = {p.x() - 0.13, 0.0};
    const double D = away.norm(), d = D - (h - pin);
    Y rate{y[2], y[3], 0.0, -9.81};
    if (d > 0.0) {
      const Vec2 n = away / D;
      const double force =
          K * std::pow(d, 1.5) * (1.0 + 1.5 * alpha * (n.x() * y[2] + n.y() * y[3]));
      rate[2] -= force * n.x() / mass, rate[3] -= force * n.y() / mass;
    }
    return rate;
  };
  const Y want = integrated(rates, {0.24, 0.1, -0.8, 0.0}, 0.2, 1e-13);
  const Result run = simulate(m, {.until = 0.2, .relative_tolerance = 1e-12, .samples = 2});
  REQUIRE(run.summary.ok());
  CHECK(run.events.size() == 30);
  CHECK(std::abs(run["pin.x_m"](1) - want[0]) < 1e-10);
  CHECK(std::abs(run["pin.y_m"](1) - want[1]) < 1e-10);
  CHECK(std::abs(run["pin.vx_m_per_s"](1) - want[2]) < 1e-8);
}

TEST_CASE("a pin that left an open slot and comes back through its wall stays apart, and is told") {
  const ContactLaw law{PowerLaw{1e8, 1.5}, HuntCrossley{0.2}};
  Model m;
  const BodyId pin = m.add({.name = "pin",
                            .mass = 0.1,
                            .inertia = 1e-6,
                            .pose = {{0.05, 0.0}, 0.0},
                            .twist = {{2.0, 0.05}, 0.0}});
  m.add(PinInSlot{.name = "slot",
                  .pin = {pin, {0.05, 0.0}, 9.5_mm},
                  .slot = {ground, curve_slot({.centreline = line_segment({0.0, 0.0}, {0.1, 0.0}),
                                               .half_width = 10.0_mm,
                                               .end = SlotEnd::open,
                                               .edge_radius = 1.0_mm})},
                  .law = law});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = pin,
                            .at_a = {0.0, 0.0},
                            .at_b = {0.05, 0.0},
                            .stiffness = 20.0,
                            .free_length = 0.0});
  for (const char* formulation : {"arkode-projection", "ida-ggl", "adams-baumgarte"}) {
    CAPTURE(formulation);
    const Result run = simulate(
        m, {.until = 0.8, .relative_tolerance = 1e-10, .formulation = formulation, .samples = 801});
    REQUIRE(run.summary.ok());
    CHECK(run["pin.x_m"].maxCoeff() > 0.13);  // it was outside
    CHECK(run["pin.x_m"].tail(1)[0] < 0.09);  // and is in the slot again
    CHECK(run.summary.energy_balance < 1e-6);
    REQUIRE(run.summary.notes.size() == 1);
    CHECK(run.summary.notes[0].find("'slot': came from behind the wall 'left' at t = 0.58") == 0);
    for (const EventRecord& event : run.events) CHECK(event.penetration < 1e-3);
  }
}

TEST_CASE("a disc that comes up through a plate from below stays apart until it is above") {
  const ContactLaw law{PowerLaw{1e8, 1.5}, HuntCrossley{0.2}};
  Model m;
  const BodyId disc = m.add({.name = "disc",
                             .mass = 0.1,
                             .inertia = 1e-6,
                             .pose = {{0.0, -0.1}, 0.0},
                             .twist = {{0.1, 2.5}, 0.0}});
  m.add(Gravity{});
  m.add(DiscOnCurve{.name = "plate",
                    .disc = {disc, {0.0, -0.1}, 10.0_mm},
                    .body = ground,
                    .curve = line_segment({1.0, 0.0}, {-1.0, 0.0}),
                    .side = CurveSide::right,
                    .law = law,
                    .thickness = 5.0_mm});
  const Result run = simulate(m, {.until = 0.6, .relative_tolerance = 1e-10, .samples = 601});
  REQUIRE(run.summary.ok());
  CHECK(run.summary.energy_balance < 1e-8);
  CHECK(run["disc.y_m"].maxCoeff() > 0.15);
  CHECK(run["disc.y_m"].tail(1)[0] > 0.0);  // it has come down on the plate
  CHECK(run.summary.notes.size() == 1);
  REQUIRE(!run.events.empty());
  CHECK(run.events.front().speed > 1.5);
}

TEST_CASE("a disc that starts behind a surface is refused") {
  Model m;
  const BodyId disc = m.add({.name = "disc", .mass = 0.1, .inertia = 1e-6});
  const ContactLaw law{PowerLaw{1e8, 1.5}};
  const std::string message = message_of([&] {
    m.add(DiscOnCurve{.name = "floor",
                      .disc = {disc, {0.2, -0.5}, 10.0_mm},
                      .body = ground,
                      .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                      .law = law});
  });
  CHECK(message.find("contact 'floor': the centre of the disc (0.2, -0.5) m is 0.5 m behind the "
                     "surface") == 0);
  CHECK(message_of([&] {
          m.add(DiscOnDisc{.name = "two",
                           .disc = {disc, {0.0, 0.0}, 10.0_mm},
                           .other = {ground, {1.0_mm, 0.0}, 20.0_mm},
                           .law = law});
        }).find("is 0.019 m behind the surface") != std::string::npos);
}
