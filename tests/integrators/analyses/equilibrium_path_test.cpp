// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Paths of equilibria against closed forms: snap-through, buckling, loops, stops.
#include <doctest/doctest.h>

#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/integrators/analyses/equilibrium.hpp>
#include <yoke/integrators/analyses/equilibrium_path.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/tests/integrators/analyses/analysed.hpp>
#include <yoke/tests/integrators/wall.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

constexpr double g = 9.81;

/// Of the truss: |y| at the limits, from d(load)/dy = 0.
double truss_limit(double b, double h) {
  return std::sqrt(std::pow(std::hypot(b, h) * b * b, 2.0 / 3.0) - b * b);
}

/// Two bars of length L in a toggle, the first on a pivot, the second on a slider that a spring k
/// holds; pressed down where they meet by F. A loop.
///   load = 4 k L (cos(angle) - cos(start)) tan(angle), largest at cos(angle)^3 = cos(start)
Model toggle(double L, double k, double start, double F) {
  Model m;
  const Vec2 A = rotate(start, {L, 0.0}), B(2.0 * A.x(), 0.0);
  const auto first = add_link(m, "first", {0.0, 0.0}, A), second = add_link(m, "second", A, B);
  const auto slider = m.add(Body{.name = "slider", .mass = 1.0, .inertia = 0.02, .pose = {B, 0.0}});
  m.add(Revolute{.name = "O", .a = ground, .b = first, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "A", .a = first, .b = second, .at = A});
  m.add(Revolute{.name = "B", .a = second, .b = slider, .at = B});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = slider,
                            .at_a = B + Vec2(1.0, 0.0),
                            .at_b = B,
                            .stiffness = k});
  m.add(AppliedForce{
      .name = "press", .body = first, .at = A, .force = [F](double) { return Vec2(0.0, -F); }});
  return m;
}

/// A rod that stands on a hinge with a torsion spring, relaxed `lean` beside the vertical.
Model standing_rod(double mass, double length, double k, double lean) {
  Model m;
  const auto rod = m.add(Body{.name = "rod",
                              .mass = mass,
                              .inertia = mass * length * length / 12.0,
                              .pose = {{0.0, 0.5 * length}, 0.5 * pi}});
  m.add(Revolute{.name = "hinge", .a = ground, .b = rod, .at = {0.0, 0.0}});
  m.add(TorsionalSpring{
      .name = "spring", .a = ground, .b = rod, .stiffness = k, .free_angle = 0.5 * pi + lean});
  m.add(Gravity{});
  return m;
}

}  // namespace

TEST_CASE("the path of a truss goes through both limits of its snap-through") {
  const double b = 1.0, h = 0.2, k = 5000.0;
  const double y_limit = truss_limit(b, h), limit = truss_load(b, h, k, y_limit);
  const EquilibriumPath path = equilibrium_path(truss(b, h, k, 2.0 * limit, h));
  REQUIRE_MESSAGE(path.complete, path.reason);
  REQUIRE(path.critical.size() == 2);
  const Eigen::VectorXd y = path["node.y_m"], load = path["load_factor"];
  const double sides[] = {1.0, -1.0};
  for (std::size_t i = 0; i < 2; ++i) {
    const CriticalPoint& point = path.critical[i];
    CHECK(point.kind == PathPoint::limit);
    CHECK(point.value == doctest::Approx(sides[i] * 0.5).epsilon(1e-12));
    const auto row = static_cast<Eigen::Index>(point.row);
    CHECK(y[row] == doctest::Approx(sides[i] * y_limit).epsilon(1e-9));
    CHECK(point.state.q[1] == y[row]);
    CHECK(path.points.text(point.row, path.points.index("point")) == "limit");
    CHECK(path.points.text(point.row, path.points.index("stability")) == "neutral");
  }
  // Every point is on the curve, and stable where that falls.
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    CHECK(std::abs(2.0 * limit * load[i] - truss_load(b, h, k, y[i])) < 1e-9 * limit);
    const double beyond = std::abs(y[i]) - y_limit;
    if (std::abs(beyond) < 1e-6) continue;
    CHECK(path.points.text(static_cast<std::size_t>(i), path.points.index("stability")) ==
          (beyond > 0.0 ? "stable" : "unstable"));
  }
  CHECK(load[0] == 0.0);
  CHECK(load[load.size() - 1] == 1.0);
  CHECK(y[y.size() - 1] < -h);
  CHECK(path.final.q[1] == y[y.size() - 1]);
  CHECK((y.tail(y.size() - 1) - y.head(y.size() - 1)).maxCoeff() < 0.0);
  CHECK(contains(path.reason, "load_factor = 1 was reached"));
}

TEST_CASE(
    "the path does not depend on the length of its steps, on units or on where the mechanism is") {
  const double b = 1.0, h = 0.2, k = 5000.0, limit = truss_load(b, h, k, truss_limit(b, h));
  for (const double size : {1.0, 1e-3, 1e4})
    for (const double step : {0.3, 0.02}) {
      INFO("size " << size << ", steps of " << step);
      const EquilibriumPath path = equilibrium_path(
          truss(b * size, h * size, k, 2.0 * limit * size, h * size), {.largest_step = step});
      REQUIRE_MESSAGE(path.complete, path.reason);
      REQUIRE(path.critical.size() == 2);
      CHECK(path.critical[1].value == doctest::Approx(-0.5).epsilon(1e-11));
      CHECK(path.critical[1].state.q[1] ==
            doctest::Approx(-size * truss_limit(b, h)).epsilon(1e-9));
    }
}

TEST_CASE(
    "a toggle in a loop snaps through at cos^3 = cos of its start; joints bear the share of the load") {
  const double L = 0.4, k = 1000.0, start = 0.5;
  const auto load = [&](double angle) {
    return 4.0 * k * L * (std::cos(angle) - std::cos(start)) * std::tan(angle);
  };
  const double angle = std::acos(std::cbrt(std::cos(start))), F = 3.0 * load(angle);
  const EquilibriumPath path = equilibrium_path(toggle(L, k, start, F));
  REQUIRE_MESSAGE(path.complete, path.reason);
  REQUIRE(path.critical.size() == 2);
  CHECK(path.critical[0].value == doctest::Approx(1.0 / 3.0).epsilon(1e-11));
  CHECK(path.critical[1].value == doctest::Approx(-1.0 / 3.0).epsilon(1e-11));
  CHECK(path.critical[0].state.q[2] == doctest::Approx(angle).epsilon(1e-9));
  CHECK(path.critical[1].state.q[2] == doctest::Approx(-angle).epsilon(1e-9));
  const Eigen::VectorXd at = path["first.angle_rad"], share = path["load_factor"],
                        bears = path["B.fy_N"];
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    CHECK(std::abs(share[i] * F - load(at[i])) < 1e-9 * F);
    CHECK(std::abs(bears[i] + 0.5 * share[i] * F) < 1e-9 * F);
  }
  const Eigen::VectorXd stiffness = path["lowest_stiffness_per_s2"];
  for (const CriticalPoint& point : path.critical)
    CHECK(std::abs(stiffness[static_cast<Eigen::Index>(point.row)]) <
          1e-8 * stiffness.cwiseAbs().maxCoeff());
}

TEST_CASE(
    "a perfect column passes its branch point, an imperfect one leans as its closed form says") {
  const double mass = 1.0, length = 1.0, k = 2.0, moment = mass * g * 0.5 * length;
  const EquilibriumPath perfect = equilibrium_path(standing_rod(mass, length, k, 0.0));
  REQUIRE_MESSAGE(perfect.complete, perfect.reason);
  REQUIRE(perfect.critical.size() == 1);
  CHECK(perfect.critical[0].kind == PathPoint::branch);
  CHECK(perfect.critical[0].value == doctest::Approx(k / moment).epsilon(1e-9));
  CHECK((perfect["rod.angle_rad"].array() - 0.5 * pi).abs().maxCoeff() < 1e-12);

  for (const double lean : {1e-3, 1e-6}) {
    const EquilibriumPath path = equilibrium_path(standing_rod(mass, length, k, lean));
    REQUIRE_MESSAGE(path.complete, path.reason);
    CHECK(path.critical.empty());
    const Eigen::VectorXd angle = path["rod.angle_rad"], factor = path["load_factor"];
    for (Eigen::Index i = 0; i < angle.size(); ++i) {
      const double beside = angle[i] - 0.5 * pi;
      CHECK(std::abs(k * (beside - lean) - factor[i] * moment * std::sin(beside)) < 1e-9 * moment);
    }
    CHECK(angle[angle.size() - 1] - 0.5 * pi > 1.0);
  }
}

TEST_CASE("a parameter is what changes: a weaker spring lets the rod lean, from either end") {
  const double moment = g * 0.5, lean = 0.01;
  const Model rod = standing_rod(1.0, 1.0, 10.0, lean);
  const EquilibriumPath path =
      equilibrium_path(rod, {.parameter = "spring.stiffness", .from = 10.0, .to = 1.0});
  REQUIRE_MESSAGE(path.complete, path.reason);
  const Eigen::VectorXd angle = path["rod.angle_rad"], k = path["spring.stiffness_N_m_per_rad"];
  for (Eigen::Index i = 0; i < angle.size(); ++i)
    CHECK(std::abs(k[i] * (angle[i] - 0.5 * pi - lean) - moment * std::sin(angle[i] - 0.5 * pi)) <
          1e-9 * moment);
  CHECK(k[0] == 10.0);
  CHECK(k[k.size() - 1] == 1.0);
  // A free angle turned right over: the rod is pushed to the other side, and snaps.
  const EquilibriumPath over = equilibrium_path(
      standing_rod(1.0, 1.0, 3.0, 0.5),
      {.parameter = "spring.free_angle", .from = 0.5 * pi + 0.5, .to = 0.5 * pi - 0.5});
  REQUIRE_MESSAGE(over.complete, over.reason);
  REQUIRE(over.critical.size() == 2);
  // d(free angle)/d(lean) = 0: k = moment cos(lean)
  const double limit = std::acos(3.0 / moment);
  CHECK(over.critical[0].state.q[2] == doctest::Approx(0.5 * pi + limit).epsilon(1e-9));
  CHECK(over.critical[1].state.q[2] == doctest::Approx(0.5 * pi - limit).epsilon(1e-9));
  CHECK(over.critical[0].value ==
        doctest::Approx(0.5 * pi + limit - moment / 3.0 * std::sin(limit)).epsilon(1e-11));
}

TEST_CASE("a stop on the way makes a corner, however hard it is") {
  const double b = 1.0, h = 0.2, k = 5000.0, F = 30.0, stop = -0.05;
  for (const double exponent : {1.0, 1.5})
    for (const double K : {1e6, 1e10}) {
      INFO("K " << K << ", exponent " << exponent);
      Model m = truss(b, h, k, F, h);
      m.add(Wall{.name = "stop",
                 .body = m.find_body("node"),
                 .law = {PowerLaw{K, exponent}},
                 .height = stop});
      const EquilibriumPath path = equilibrium_path(m);
      REQUIRE_MESSAGE(path.complete, path.reason);
      REQUIRE(path.critical.size() == 2);
      CHECK(path.critical[0].value ==
            doctest::Approx(truss_load(b, h, k, truss_limit(b, h)) / F).epsilon(1e-11));
      // Where the penetration is small beside the stop, the load turns there.
      CHECK(path.critical[1].value ==
            doctest::Approx(truss_load(b, h, k, stop) / F).epsilon(K > 1e9 ? 1e-8 : 1e-3));
      const Eigen::VectorXd y = path["node.y_m"], factor = path["load_factor"];
      for (Eigen::Index i = 0; i < y.size(); ++i) {
        const double d = std::max(0.0, stop - y[i]);
        if (d > 0.0 && d < 1e-9) continue;  // a contact takes less for rounding
        CHECK(std::abs(F * factor[i] - truss_load(b, h, k, y[i]) - K * std::pow(d, exponent)) <
              1e-7 * F);
      }
      CHECK(factor[factor.size() - 1] == 1.0);
      CHECK(path["stop.normal_force_N"][y.size() - 1] ==
            doctest::Approx(F - truss_load(b, h, k, y[y.size() - 1])).epsilon(1e-6));
    }
}

TEST_CASE("a chain larger than the dense analysis is followed too, its stability unknown") {
  const int links = 520;
  const double l = 1.0 / links;
  Model m;
  BodyId last = ground;
  for (int i = 0; i < links; ++i) {
    const BodyId link = m.add(Body{.name = "link " + std::to_string(i),
                                   .mass = l,
                                   .inertia = l * l * l / 12.0,
                                   .pose = {{(i + 0.5) * l, 0.0}, 0.0}});
    m.add(Revolute{"pin " + std::to_string(i), last, link, {i * l, 0.0}});
    m.add(TorsionalSpring{
        .name = "coil " + std::to_string(i), .a = last, .b = link, .stiffness = 1.0 / l});
    last = link;
  }
  m.add(Gravity{});
  const EquilibriumPath path = equilibrium_path(m);
  REQUIRE_MESSAGE(path.complete, path.reason);
  const std::size_t end = path.points.rows() - 1;
  CHECK(path.points.text(end, path.points.index("stability")) == "unknown");
  const Equilibrium e = equilibrium(m);
  REQUIRE(e.found);
  CHECK((path.final.q - e.state.q).cwiseAbs().maxCoeff() < 1e-8);
}

TEST_CASE("a path that ends early keeps its points and says where and why") {
  const double b = 1.0, h = 0.2, k = 5000.0, F = 30.0;
  const EquilibriumPath few = equilibrium_path(truss(b, h, k, F, h), {.points = 10});
  CHECK(!few.complete);
  CHECK(few.points.rows() == 10);
  CHECK_MESSAGE(contains(few.reason, "the path ends at load_factor = 0."), few.reason);
  CHECK_MESSAGE(contains(few.reason, "10 points are made"), few.reason);
  // A contact law that cannot bear the load.
  const Johnson law(1e11, 1e-4, 1e-3);
  const double press = 3.0 * law(law.limit()).force;
  Model m;
  const auto ball =
      m.add(Body{.name = "ball", .mass = 1.0, .inertia = 1e-4, .pose = {{0.0, -1e-7}, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = ball, .along = {0.0, 1.0}});
  m.add(Wall{.name = "floor", .body = ball, .law = {law}});
  m.add(AppliedForce{
      .name = "press", .body = ball, .force = [press](double) { return Vec2(0.0, -press); }});
  const EquilibriumPath path = equilibrium_path(m, {.from = 0.01});
  CHECK(!path.complete);
  const Eigen::VectorXd factor = path["load_factor"];
  CHECK(factor[factor.size() - 1] > 0.2);
  CHECK(factor[factor.size() - 1] < 0.34);
  CHECK_MESSAGE(contains(path.reason, "no equilibrium was found next to it"), path.reason);
}

TEST_CASE("options of a path that make no sense are refused") {
  const Model m = truss(1.0, 0.2, 5000.0, 30.0, 0.2);
  const auto message = [&](const EquilibriumPathOptions& o) {
    return message_of([&] { equilibrium_path(m, o); });
  };
  CHECK(contains(message({.from = 1.0}), "from and to are both 1"));
  CHECK(contains(message({.to = NAN}), "to"));
  CHECK(contains(message({.largest_step = 0.0}), "largest_step = 0 must be above 0, at most 1"));
  CHECK(contains(message({.points = 1}), "points = 1 must be at least 2"));
  CHECK(contains(message({.loads = {"wind"}}), "there is no force 'wind'"));
  CHECK(contains(message({.parameter = "left.stifness"}), "left.stiffness"));
  CHECK(contains(message({.parameter = "left.stiffness", .from = -1.0}), "-1 N/m"));
  CHECK(contains(message({.parameter = "left.stiffness", .loads = {"load"}}), "give one of both"));
  // A pendulum without weight stands anywhere.
  Model loose;
  const auto rod =
      loose.add(Body{.name = "rod", .mass = 1.0, .inertia = 0.1, .pose = {{0.5, 0.0}, 0.0}});
  loose.add(Revolute{.name = "pivot", .a = ground, .b = rod, .at = {0.0, 0.0}});
  loose.add(Gravity{});
  CHECK(contains(message_of([&] { equilibrium_path(loose); }), "nothing holds 'rod'"));
  CHECK(equilibrium_path(loose, {.from = 0.1}).complete);
}
