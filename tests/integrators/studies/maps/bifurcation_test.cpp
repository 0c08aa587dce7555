// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Diagrams and basins of oscillators whose attractors are known.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <vector>

#include <yoke/integrators/studies/maps/basins.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using yoke::tests::contains;
using yoke::tests::message_of;

/// x'' + 0.1 x' + x + x^3 = 0.5 cos(w t): for w between about 1.5 and 1.9 it has two steady states.
SectionedModel hardening(double w) {
  SectionedModel made;
  const BodyId mass = made.model.add(Body{.name = "mass", .mass = 1.0, .inertia = 1.0});
  made.model.add(Prismatic{.name = "guide", .a = ground, .b = mass});
  made.model.add(applied_force("spring", mass, {0.0, 0.0}, [w](auto t, const auto& b) {
    return vec(0.5 * cos(w * t) - 0.1 * b.vx - b.x - b.x * b.x * b.x, 0.0 * b.x);
  }));
  made.section = Section::every(2.0 * pi / w);
  made.start = made.model.start_state();
  return made;
}

BifurcationOptions few(Continuation continuation, int jobs = 1) {
  BifurcationOptions options{.map = {.columns = {"mass.x_m", "mass.vx_m_per_s"},
                                     .discard = 60,
                                     .points = 6,
                                     .run = {.relative_tolerance = 1e-6, .samples = 0}},
                             .continuation = continuation,
                             .jobs = jobs};
  return options;
}

/// [m] of the last point in a direction.
double reach(const Bifurcation& map, double value, bool backward) {
  double size = -1.0;
  for (std::size_t i = 0; i < map.points.rows(); ++i)
    if (map.points.value(i, 0) == value && (map.points.value(i, 1) == 1.0) == backward)
      size = std::hypot(map.points.value(i, 4), map.points.value(i, 5) / value);
  return size;
}

/// x'' + x' - x + x^3 = 0: from rest it comes to 1 or -1, on the side where it begins.
SectionedModel two_wells(const StudyPoint& point) {
  SectionedModel made;
  const BodyId mass = made.model.add(Body{.name = "mass",
                                          .mass = 1.0,
                                          .inertia = 1.0,
                                          .pose = {{point["x"], 0.0}, 0.0},
                                          .twist = {{point["v"], 0.0}, 0.0}});
  made.model.add(Prismatic{.name = "guide", .a = ground, .b = mass});
  made.model.add(applied_force("wells", mass, {point["x"], 0.0}, [](auto, const auto& b) {
    return vec(b.x - b.x * b.x * b.x - b.vx, 0.0 * b.x);
  }));
  made.section = Section::every(1.0);
  made.start = made.model.start_state();
  return made;
}

TEST_SUITE("bifurcation") {
  TEST_CASE("forward and backward differ where there are two steady states, and nowhere else") {
    const std::vector<double> values{1.2, 1.4, 1.6, 1.7, 2.2, 2.6};
    const Bifurcation map = bifurcation(hardening, values, few(Continuation::both, 2));
    CHECK(map.complete);
    REQUIRE(map.rows.size() == 12);
    for (const BifurcationRow& row : map.rows) {
      CHECK(row.points == 6);
      CHECK(row.period == 1);
      CHECK(row.reason.empty());
    }
    CHECK(reach(map, 1.2, false) == doctest::Approx(reach(map, 1.2, true)).epsilon(1e-2));
    CHECK(reach(map, 2.6, false) == doctest::Approx(reach(map, 2.6, true)).epsilon(1e-2));
    CHECK(reach(map, 1.7, false) > 3.0 * reach(map, 1.7, true));
  }

  TEST_CASE("a diagram has the same bits for any number of jobs") {
    const std::vector<double> values{1.2, 1.7, 2.2};
    for (const Continuation c : {Continuation::both, Continuation::afresh}) {
      const Bifurcation one = bifurcation(hardening, values, few(c, 1));
      const Bifurcation two = bifurcation(hardening, values, few(c, 2));
      CHECK(one.points.data() == two.points.data());
    }
  }

  TEST_CASE("a diagram that is stopped has the values until then") {
    std::atomic<std::size_t> done = 0;
    BifurcationOptions options = few(Continuation::forward);
    options.observer = [&](std::size_t n, std::size_t total) {
      CHECK(total == 3);
      done = n;
    };
    options.stop = [&] { return done == 2; };
    const Bifurcation map = bifurcation(hardening, {1.2, 1.7, 2.2}, options);
    CHECK(!map.complete);
    CHECK(map.rows.size() == 2);
    CHECK(map.points.rows() == 12);
  }

  TEST_CASE("a value that cannot run is a row with its reason; the next begins afresh") {
    const ModelOfParameter fails = [](double w) {
      if (w == 1.5) throw ModelError("no such mechanism");
      SectionedModel made = hardening(w);
      if (w == 1.4)
        made.model.add(EventFunction{.name = "end",
                                     .function = [](const Motion& at) { return at.t - 280.0; },
                                     .stop = true});
      made.start = made.model.start_state();
      return made;
    };
    const Bifurcation map = bifurcation(fails, {1.2, 1.4, 1.5, 1.6}, few(Continuation::forward));
    REQUIRE(map.rows.size() == 4);
    CHECK(map.rows[0].reason.empty());
    CHECK(map.rows[1].points < 6);
    CHECK(contains(map.rows[1].reason, "event 'end'"));
    CHECK(map.rows[2].points == 0);
    CHECK(map.rows[2].reason == "no such mechanism");
    CHECK(map.rows[3].points == 6);
    CHECK(contains(message_of([&] { bifurcation(hardening, {}, {}); }), "values"));
  }

  TEST_CASE("what is carried over keeps its place and its drivers their angle") {
    const auto crank = [](double speed) {
      Model m;
      const BodyId body = m.add(Body{.name = "crank", .mass = 1.0, .inertia = 1.0});
      m.add(Revolute{.name = "pivot", .a = ground, .b = body, .at = {0.0, 0.0}});
      m.add(AngleDriver{.name = "motor", .body = body, .angle = constant_speed(0.0, speed)});
      return m;
    };
    const Model slow = crank(2.0), fast = crank(5.0);
    State last = slow.start_state();
    last.t = 3.0;
    last.q << 0.0, 0.0, 6.0;
    const State next = carried_over(slow, last, fast, fast.start_state());
    CHECK(next.q[2] == 6.0);
    CHECK(time_of_drivers(fast, next, last.t) == doctest::Approx(1.2).epsilon(1e-12));
    CHECK(time_of_drivers(Model(), State(), 7.0) == 7.0);  // without drivers
  }
}

TEST_SUITE("basins") {
  TEST_CASE(
      "starts in two wells come to the bottom of their own, with the same bits for any jobs") {
    const StudyPoints grid =
        grid_points({linear_axis("x", -1.3, 1.3, 6), linear_axis("v", 0.0, 0.01, 2)});
    BasinOptions options{.map = {.columns = {"mass.x_m", "mass.vx_m_per_s"},
                                 .discard = 25,
                                 .points = 4,
                                 .run = {.relative_tolerance = 1e-6, .samples = 0}}};
    options.study.jobs = 1;
    const Basins one = basins(two_wells, grid, options);
    options.study.jobs = 2;
    const Basins two = basins(two_wells, grid, options);
    CHECK(one.table().data() == two.table().data());
    REQUIRE(one.attractors.size() == 2);
    CHECK(one.attractors[0].mean[0] == doctest::Approx(-1.0).epsilon(1e-4));
    CHECK(one.attractors[1].mean[0] == doctest::Approx(1.0).epsilon(1e-4));
    CHECK(one.attractors[0].period == 1);
    CHECK(one.attractors[0].starts == 6);
    CHECK(one.attractors[1].starts == 6);
    for (std::size_t i = 0; i < grid.size(); ++i)
      CHECK(one.attractor[i] == (grid.coordinate(i, 0) < 0.0 ? 0 : 1));
    CHECK(contains(message_of([&] { basins(two_wells, grid, {.tolerance = 0.0}); }),
                   "tolerance = 0"));
  }

  TEST_CASE("a start that goes off is unbounded, one that cannot run has failed") {
    const ModelOfStart off = [](const StudyPoint& point) {
      if (point["x"] == 2.0) throw ModelError("no such start");
      SectionedModel made;
      const double x = point["x"];
      const BodyId mass = made.model.add(
          Body{.name = "mass", .mass = 1.0, .inertia = 1.0, .pose = {{x, 0.0}, 0.0}});
      made.model.add(Prismatic{.name = "guide", .a = ground, .b = mass});
      made.model.add(applied_force("push", mass, {x, 0.0},
                                   [](auto, const auto& b) { return vec(b.x, 0.0 * b.x); }));
      made.section = Section::every(1.0);
      made.start = made.model.start_state();
      return made;
    };
    BasinOptions options{.map = {.columns = {"mass.x_m"}, .discard = 8, .points = 4},
                         .bound = 100.0};
    options.study.jobs = 1;
    const Basins map = basins(off, grid_points({value_axis("x", {0.0, 1.0, 2.0})}), options);
    REQUIRE(map.attractor.size() == 3);
    CHECK(map.attractor[0] == 0);
    CHECK(map.attractor[1] == basin_unbounded);
    CHECK(map.attractor[2] == basin_failed);
    const Table table = map.table();
    CHECK(table.value(0, 2) == 1.0);
    CHECK(table.value(1, 2) == 0.0);
    CHECK(std::isnan(table.value(2, 2)));
  }

  TEST_CASE("basins in a folder go on where they were ended") {
    const yoke::tests::TemporaryFolder scratch;
    const StudyPoints grid =
        grid_points({linear_axis("x", -1.3, 1.3, 4), linear_axis("v", 0.0, 0.01, 1 + 1)});
    BasinOptions options{.map = {.columns = {"mass.x_m"}, .discard = 20, .points = 4}};
    options.study = {.jobs = 1, .folder = scratch.path()};
    std::size_t done = 0;
    options.study.observer = [&](const StudyProgress& p) { done = p.done; };
    options.study.stop = [&] { return done >= 3; };
    CHECK(!basins(two_wells, grid, options).study.complete);
    options.study.stop = {};
    const Basins whole = basins(two_wells, grid, options);
    CHECK(whole.study.complete);
    CHECK(whole.study.progress.reused == 3);
    CHECK(whole.attractors.size() == 2);
  }
}

}  // namespace
