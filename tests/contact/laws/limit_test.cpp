// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Where an elastic law ends: refused at set-up where it can be known, and during a run a located
// stop that says when, where, how deep, and what the limit is.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/model.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::tests;

namespace {

constexpr double mass = 8.0, clearance = 0.1e-3;  // [kg], [m]

/// A steel pin of 7.9 mm in the fixed arc slot of the scotch-yoke, thrown at a wall: `speed` > 0 at
/// the outer one, < 0 at the inner one. Both walls have laws with an end; the inner one's is
/// `inner`, the outer one's `outer`.
struct Throw {
  ElasticLaw inner, outer;
  double speed = 0.0;   // [m/s]
  double offset = 0.0;  // [m] of the pin from the centreline at the start
  std::string formulation = "arkode-projection";

  Result run() const {
    Model m;
    const Vec2 start{60e-3 + offset, 0.0};
    const BodyId pin = m.add({.name = "pin",
                              .mass = mass,
                              .inertia = 1e-4,
                              .pose = {start, 0.0},
                              .twist = {{speed, 0.0}, 0.0}});
    m.add(PinInSlot{.name = "yoke.slot",
                    .pin = {pin, start, 7.9e-3},
                    .slot = {ground, arc_slot({.radius = 60e-3, .angle = 2.0, .half_width = 8e-3})},
                    .law = SlotLaws(ContactLaw{inner}, ContactLaw{outer}, ContactLaw{outer})});
    return simulate(
        m, {.until = 1e-3, .relative_tolerance = 1e-10, .formulation = formulation, .samples = 2});
  }
};

/// Ends at 0.06 mm, whatever the wall.
struct Short {
  double K = 4e7;
  ElasticResponse operator()(double d) const { return {K * d, K, 0.5 * K * d * d}; }
  double limit() const { return 0.06e-3; }
  std::string name() const { return "short"; }
};

}  // namespace

TEST_CASE("a run stops where the law of the wall touched ends, and says when and where") {
  for (const std::string formulation : {"arkode-projection", "ida-ggl"})
    for (const bool outer : {true, false}) {
      INFO(formulation, outer ? " outer" : " inner");
      const ElasticLaw endless = PowerLaw{4e7, 1.0, "endless"};
      const ElasticLaw ends = Short{};
      const double speed = 0.5;
      const Result run = Throw{.inner = outer ? endless : ends,
                               .outer = outer ? ends : endless,
                               .speed = outer ? speed : -speed,
                               .formulation = formulation}
                             .run();
      // By hand: free flight over the gap, then a linear oscillator to 99 % of the limit.
      const double w = std::sqrt(4e7 / mass), limit = 0.99 * 0.06e-3;
      const double t = clearance / speed + std::asin(limit * w / speed) / w;
      CHECK(run.summary.stop == Stop::failed);
      CHECK(std::abs(run.summary.t_end / t - 1.0) < 1e-7);
      const std::string& reason = run.summary.reason;
      INFO(reason);
      CHECK(contains(reason, "'yoke.slot': "));
      CHECK(contains(reason, outer ? "outer: " : "inner: "));
      const std::size_t at = reason.find("at t = ");
      REQUIRE(at != std::string::npos);
      CHECK(std::abs(std::stod(reason.substr(at + 7)) / t - 1.0) < 1e-7);
      CHECK(contains(reason, "the penetration 5.94e-05 m"));
      CHECK(contains(reason, "of the 6e-05 m where the law 'short' ends"));
      // What was computed up to there is kept.
      CHECK(run.events.size() == 1);
      CHECK(run.events.front().kind == "onset");
    }
}

TEST_CASE("a law with a logarithm ends a run on both walls of a slot") {
  // The steel of the slot's end, DR = 0.1 mm, 10 mm long, for both walls: ends at 54 um, 193 kN.
  const ElasticLaw johnson =
      make_elastic("johnson", {.pin_radius = 7.9e-3, .wall_radius = 8e-3, .length = 10e-3});
  for (const bool outer : {true, false}) {
    INFO((outer ? "outer" : "inner"));
    const Result run = Throw{.inner = johnson, .outer = johnson, .speed = outer ? 1.5 : -1.5}.run();
    CHECK(run.summary.stop == Stop::failed);
    INFO(run.summary.reason);
    CHECK(contains(run.summary.reason,
                   fmt::format("{:g} m where the law 'johnson", johnson.limit())));
    CHECK(contains(run.summary.reason, outer ? "outer: at t = " : "inner: at t = "));
    // A third of the speed stays within the law.
    CHECK(
        Throw{.inner = johnson, .outer = johnson, .speed = outer ? 0.5 : -0.5}.run().summary.ok());
  }
}

TEST_CASE("a pose beyond the end of its law is refused at the start") {
  for (const bool outer : {true, false}) {
    INFO((outer ? "outer" : "inner"));
    const ElasticLaw ends = Short{};
    for (const double depth : {0.0597e-3, 0.08e-3}) {
      const Result run = Throw{.inner = ends,
                               .outer = ends,
                               .speed = 0.0,
                               .offset = (outer ? 1.0 : -1.0) * (clearance + depth)}
                             .run();
      INFO(run.summary.reason);
      CHECK(run.summary.stop == Stop::failed);
      CHECK(run.summary.t_end == 0.0);
      CHECK(contains(run.summary.reason, "'yoke.slot': "));
      CHECK(contains(run.summary.reason, outer ? "outer: at t = 0 s" : "inner: at t = 0 s"));
      CHECK(contains(run.summary.reason, "where the law 'short' ends"));
    }
  }
}
