// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A part of the matrix of impacts (tests/validation/impacts_test.cpp) in a few seconds: every
// dissipative and every elastic law at least once, in turn by geometry, integrator and restitution.
// And impacts that are not central, against the equation of motion written out.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <yoke/core/model.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/integrators/wall.hpp>
#include <yoke/tests/validation/impact_matrix.hpp>

using namespace yoke;
using namespace yoke::cases;
using namespace yoke::reference;

TEST_CASE("every law at least once, in every geometry, against closed forms and quadratures") {
  const std::vector<Spring> all = springs();
  Worst worst;
  std::set<std::string> elastic;
  std::size_t turn = 0;
  for (const DissipativeNote& note : dissipative_catalog())
    for (const bool clamp : {false, true}) {
      if (clamp && !pulls(note.name)) continue;
      for (const CentralImpact::Setup setup : all_setups) {
        const Spring& spring = note.linear_only ? all[0] : all[turn % all.size()];
        const double e = note.name == "none"                       ? 1.0
                         : note.name == "marhefka-orin-simplified" ? asked[2 + turn % 4]
                                                                   : asked[turn % 6];
        elastic.insert(spring.specification);
        check_impact(note.name, spring, e, *expected_of(note.name, spring, e, clamp), clamp, setup,
                     integrators[turn / 2 % 2], worst);
        ++turn;
      }
    }
  CHECK(elastic.size() == all.size());
  for (const ElasticNote& note : elastic_catalog()) {
    const auto of_note = [&](const std::string& name) { return name.starts_with(note.name); };
    CHECK_MESSAGE(std::any_of(elastic.begin(), elastic.end(), of_note), note.name);
  }
  report("some of each", worst);
}

// The shares with which the force vanishes exactly at the corner of the formula, on the way out.
TEST_CASE("lee-wang-2 let go exactly at its corner does what it does just beside it") {
  struct Corner {
    double q, e, share;
  };
  for (const Corner& corner : {Corner{0.5, 0.05, 0.346095703},
                               {3.0, 0.3, 0.341326705},
                               {20.0, 0.7, 0.168000214},
                               {3.0, 0.95, 0.0310602516}})
    for (const std::string formulation : integrators) {
      INFO("q = ", corner.q, " e = ", corner.e, " ", formulation);
      const auto restitution = [&](double aside) {
        const ContactLaw law{
            make_elastic("power:K=1e8,n=1", {}),
            make_dissipative("lee-wang-2", {.restitution = corner.e,
                                            .q = corner.q,
                                            .epsilon = corner.share * (1.0 + aside),
                                            .tensile = TensilePhase::clamp})};
        return simulate_impact({.law = law, .speed = v, .mass = m, .formulation = formulation})
            .restitution;
      };
      const double there = restitution(0.0);
      for (const double aside : {1e-13, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-5, 1e-3})
        for (const double side : {-1.0, 1.0})
          CHECK(std::abs(restitution(side * aside) / there - 1.0) < promise + 10.0 * aside);
      const Expected beside = lee_wang_2(1e8, corner.e, corner.q, corner.share * 1.0001, true);
      CHECK(std::abs(there / beside.restitution - 1.0) < 1e-3);
    }
}

// Its damping fades before its spring does: let go, it presses once more just before d = 0, within
// one step of free flight. Missed, that is up to 2 % of the restitution.
TEST_CASE("lee-wang-2 let go where the force vanishes presses again before the end") {
  for (const auto& [q, share] : {std::pair{2.0, 0.1}, {3.0, 0.02}, {3.0, 0.1}, {0.5, 0.5}})
    for (const std::string formulation : integrators) {
      INFO("q = ", q, " epsilon = ", share, " ", formulation);
      const double e = 0.1;
      const ContactLaw law{
          make_elastic("power:K=1e8,n=1", {}),
          make_dissipative(
              "lee-wang-2",
              {.restitution = e, .q = q, .epsilon = share, .tensile = TensilePhase::clamp})};
      const ImpactOutcome x =
          simulate_impact({.law = law, .speed = v, .mass = m, .formulation = formulation});
      const Expected expected = lee_wang_2(1e8, e, q, share, true);
      CHECK(std::abs(x.restitution / expected.restitution - 1.0) < promise);
      CHECK(std::abs(x.duration / expected.duration - 1.0) < promise);
    }
}

namespace {

/// m x'' = Q - F dd/dx for one or two coordinates, by Runge-Kutta with a step far below need, from
/// the first touch to the release. The law is K d^1.5 (1 + X d'/v_i), or K d + c d' with xi.
struct OwnEquation {
  using Row = std::array<double, 2>;
  Row mass;                                       // [kg], [kg m^2]
  std::function<Row(const Row&)> load;            // Q(x)
  std::function<double(const Row&)> penetration;  // d(x)
  std::function<Row(const Row&)> gradient;        // dd/dx
  double K, X = 0.0, xi = 0.0;

  struct Point {
    Row x, v;
  };
  struct Answer {
    double onset, release;                   // [s]
    double approach, separation, effective;  // [m/s], [m/s], [kg]
  };

  double rate(const Point& p) const {
    const Row g = gradient(p.x);
    return g[0] * p.v[0] + g[1] * p.v[1];
  }

  Answer run(Point p, double h_free, double h_contact) const {
    Answer answer{};
    bool touching = false;
    const auto slope = [&](const Point& at) {
      const Row g = gradient(at.x), Q = load(at.x);
      double F = 0.0;
      if (touching) {
        const double d = std::max(penetration(at.x), 0.0), d_rate = rate(at);
        F = xi > 0.0 ? K * d + 2.0 * xi * std::sqrt(answer.effective * K) * d_rate
                     : K * std::pow(d, 1.5) * (1.0 + X * d_rate / answer.approach);
      }
      return Point{at.v, {(Q[0] - F * g[0]) / mass[0], (Q[1] - F * g[1]) / mass[1]}};
    };
    const auto moved = [](const Point& at, double by, const Point& k) {
      return Point{{at.x[0] + by * k.x[0], at.x[1] + by * k.x[1]},
                   {at.v[0] + by * k.v[0], at.v[1] + by * k.v[1]}};
    };
    const auto step = [&](const Point& at, double h) {
      const Point a = slope(at), b = slope(moved(at, 0.5 * h, a)), c = slope(moved(at, 0.5 * h, b)),
                  f = slope(moved(at, h, c));
      Point next = at;
      for (std::size_t i = 0; i < 2; ++i) {
        next.x[i] += h / 6.0 * (a.x[i] + 2.0 * b.x[i] + 2.0 * c.x[i] + f.x[i]);
        next.v[i] += h / 6.0 * (a.v[i] + 2.0 * b.v[i] + 2.0 * c.v[i] + f.v[i]);
      }
      return next;
    };
    double t = 0.0;
    const auto until = [&](double h, const std::function<double(const Point&)>& done) {
      for (Point next = step(p, h); done(next) < 0.0; next = step(p, h)) t += h, p = next;
      const double by = root([&](double x) { return done(step(p, x)); }, 0.0, h);
      p = step(p, by);
      t += by;
    };
    until(h_free, [&](const Point& at) { return penetration(at.x); });
    const Row g = gradient(p.x);
    answer.onset = t;
    answer.approach = rate(p);
    answer.effective = 1.0 / (g[0] * g[0] / mass[0] + g[1] * g[1] / mass[1]);
    touching = true;
    until(h_contact, [&](const Point& at) { return -rate(at); });
    until(h_contact, [&](const Point& at) { return -penetration(at.x); });
    answer.release = t;
    answer.separation = -rate(p);
    return answer;
  }
};

double damping_ratio_of(double e) { return -std::log(e) / std::hypot(std::log(e), reference::pi); }

void compare(const Result& run, const OwnEquation::Answer& expected) {
  REQUIRE(run.summary.ok());
  REQUIRE(run.events.size() >= 2);
  const EventRecord &onset = run.events[0], &release = run.events[1];
  REQUIRE(onset.kind == "onset");
  REQUIRE(release.kind == "release");
  const auto relative = [](double a, double b) { return std::abs(a / b - 1.0); };
  CHECK(relative(onset.t, expected.onset) < 1e-8);
  CHECK(relative(onset.speed, expected.approach) < 1e-8);
  CHECK(relative(release.t - onset.t, expected.release - expected.onset) < 1e-8);
  CHECK(relative(-release.speed, expected.separation) < 1e-8);
}

}  // namespace

TEST_CASE("a heavy pendulum strikes a wall obliquely, away from its centre of percussion") {
  // Pivot at the origin; centre of mass and tip on different rays of the body; gravity on; the wall
  // is horizontal, so its normal is not perpendicular to the arm.
  constexpr double mass = 1.7, inertia = 0.013, gravity = 9.81, wall = -0.25;
  const Vec2 center{0.11, 0.02}, tip{0.31, -0.04};  // from the pivot, body axes at angle zero
  const double start = -0.5, omega = -1.3;
  const auto height = [](const Vec2& p, double angle) {
    return std::sin(angle) * p.x() + std::cos(angle) * p.y();
  };
  const auto across = [](const Vec2& p, double angle) {
    return std::cos(angle) * p.x() - std::sin(angle) * p.y();
  };
  const double about_pivot = inertia + mass * center.squaredNorm();
  for (const std::string law : {"flores", "kelvin-voigt"})
    for (const std::string formulation : integrators) {
      INFO(law, " ", formulation);
      const double e = 0.6;
      OwnEquation own{.mass = {about_pivot, 1.0},
                      .load =
                          [&](const auto& x) {
                            return OwnEquation::Row{-mass * gravity * across(center, x[0]), 0.0};
                          },
                      .penetration = [&](const auto& x) { return wall - height(tip, x[0]); },
                      .gradient =
                          [&](const auto& x) {
                            return OwnEquation::Row{-across(tip, x[0]), 0.0};
                          },
                      .K = law == "flores" ? 3e9 : 3e7};
      (law == "flores" ? own.X : own.xi) =
          law == "flores" ? 8.0 * (1.0 - e) / (5.0 * e) : damping_ratio_of(e);

      const Vec2 at{across(center, start), height(center, start)};
      Model model;
      const BodyId arm = model.add({.name = "arm",
                                    .mass = mass,
                                    .inertia = inertia,
                                    .pose = {at, start},
                                    .twist = {omega * Vec2{-at.y(), at.x()}, omega}});
      model.add(Revolute{.name = "pivot", .a = ground, .b = arm, .at = {0.0, 0.0}});
      model.add(Gravity{.acceleration = {0.0, -gravity}});
      model.add(tests::Wall{
          .name = "stop",
          .body = arm,
          .law = {make_elastic(law == "flores" ? "power:K=3e9,n=1.5" : "power:K=3e7,n=1", {}),
                  make_dissipative(law, {.restitution = e})},
          .height = wall,
          .point = tip - center});
      const Result run = simulate(
          model,
          {.until = 0.3, .relative_tolerance = 1e-12, .formulation = formulation, .samples = 2});
      compare(run, own.run({{start, 0.0}, {omega, 0.0}}, 1e-5, 2e-8));
    }
}

TEST_CASE("a free bar falls on a wall with its end: the contact turns it") {
  constexpr double mass = 0.9, inertia = 0.021, gravity = 9.81, K = 3e9;
  const Vec2 end{0.21, -0.03};
  const double start = -0.4, spin = 0.7;
  for (const std::string formulation : integrators) {
    INFO(formulation);
    const double e = 0.6;
    OwnEquation own{
        .mass = {mass, inertia},
        .load =
            [&](const auto&) {
              return OwnEquation::Row{-mass * gravity, 0.0};
            },
        .penetration =
            [&](const auto& x) {
              return -(x[0] + std::sin(x[1]) * end.x() + std::cos(x[1]) * end.y());
            },
        .gradient =
            [&](const auto& x) {
              return OwnEquation::Row{-1.0, -(std::cos(x[1]) * end.x() - std::sin(x[1]) * end.y())};
            },
        .K = K,
        .X = 8.0 * (1.0 - e) / (5.0 * e)};
    Model model;
    const BodyId bar = model.add({.name = "bar",
                                  .mass = mass,
                                  .inertia = inertia,
                                  .pose = {{0.0, 0.15}, start},
                                  .twist = {{0.8, -0.2}, spin}});
    model.add(Gravity{.acceleration = {0.0, -gravity}});
    model.add(tests::Wall{.name = "floor",
                          .body = bar,
                          .law = {make_elastic("power:K=3e9,n=1.5", {}),
                                  make_dissipative("flores", {.restitution = e})},
                          .point = end});
    const Result run = simulate(
        model,
        {.until = 0.2, .relative_tolerance = 1e-12, .formulation = formulation, .samples = 2});
    compare(run, own.run({{0.15, start}, {-0.2, spin}}, 1e-5, 2e-8));
  }
}
