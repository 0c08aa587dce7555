// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The acceleration-level equations, the projections and the reactions against mechanics done by
// hand.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <yoke/core/authoring/auto_constraint.hpp>
#include <yoke/core/authoring/auto_force.hpp>
#include <yoke/core/equations/dynamics.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/joints/weld.hpp>

namespace {

using namespace yoke;
using doctest::Approx;

constexpr double g = 9.81;

/// A rod about a pivot at `pivot`, turned by `angle` from the x axis, centre of mass at `arm`.
struct Pendulum {
  double mass = 1.7, inertia = 0.21, arm = 0.63, angle = 0.4, omega = 2.3;
  Vec2 pivot{0.11, -0.27};
  Model model() const {
    Model m;
    const Vec2 d = rotate(angle, {arm, 0.0});
    const BodyId rod = m.add({.name = "rod",
                              .mass = mass,
                              .inertia = inertia,
                              .pose = {pivot + d, angle},
                              .twist = {omega * perp(d), omega}});
    m.add(Revolute{.name = "pivot", .a = ground, .b = rod, .at = pivot});
    m.add(Gravity{.acceleration = {0.0, -g}});
    return m;
  }
};

/// Some force element on the bodies given, so that there is a slot to ask the effective mass of.
template <int Bodies>
class Probe : public AutoForce<Probe<Bodies>, Bodies> {
 public:
  explicit Probe(std::array<BodyId, Bodies> bodies)
      : AutoForce<Probe<Bodies>, Bodies>("probe", bodies) {}
  template <class... Args>
  void apply(Args&...) const {}
};

double effective_mass(const Model& model, const std::vector<double>& direction) {
  Dynamics dynamics(model);
  State state = model.start_state();
  REQUIRE(dynamics.assemble(state));
  return dynamics.effective_mass(dynamics.system().forces().back(), direction.data());
}

/// The generalised direction of a push along n at a point with the arm d from the centre of mass.
std::vector<double> push(const Vec2& n, const Vec2& d) { return {n.x(), n.y(), cross(d, n)}; }

/// The centres of a and b and their angles obey 1.3 x_a - 0.7 y_b + 0.4 angle_b = c: a plane.
class Plane : public AutoConstraint<Plane, 1, 2> {
 public:
  Plane(BodyId a, BodyId b, double c)
      : AutoConstraint("plane", {a, b}, {{"mix", Measure::length}}), c_(c) {}
  template <class T>
  T phi(const AutoPose<T>& a, const AutoPose<T>& b, const T& t) const {
    return 1.3 * a.x - 0.7 * b.y + 0.4 * b.angle - c_ - 0.2 * t;
  }
  bool rheonomic() const override { return true; }

 private:
  double c_;
};

}  // namespace

TEST_CASE("a pendulum accelerates and pulls on its pivot as moment and force balance say") {
  const Pendulum p;
  const Model model = p.model();
  Dynamics dynamics(model);
  State state = model.start_state();
  REQUIRE(dynamics.assemble(state));
  // Moments about the pivot, then Newton for the centre of mass.
  const double about_pivot = p.inertia + p.mass * p.arm * p.arm;
  const double alpha = -p.mass * g * p.arm * std::cos(p.angle) / about_pivot;
  const Vec2 d = rotate(p.angle, {p.arm, 0.0});
  const Vec2 a = alpha * perp(d) - p.omega * p.omega * d;
  CHECK(state.a[2] == Approx(alpha).epsilon(1e-14));
  CHECK(state.a[0] == Approx(a.x()).epsilon(1e-14));
  CHECK(state.a[1] == Approx(a.y()).epsilon(1e-14));
  const Reaction on_rod = dynamics.reaction(0, state.lambda.data());
  CHECK(on_rod.force.x() == Approx(p.mass * a.x()).epsilon(1e-14));
  CHECK(on_rod.force.y() == Approx(p.mass * (a.y() + g)).epsilon(1e-14));
  CHECK(std::abs(on_rod.moment) < 1e-14);
}

TEST_CASE("reactions of a simply supported beam follow from moments about its supports") {
  // Pin at the left, roller at the right on a plane inclined by `slope`; weight in the middle of
  // its own and a load at a third place.
  const double l = 1.9, weight = 3.1 * g, load = 17.0, at = 0.55, middle = 0.83, slope = 0.35;
  for (const bool line_on_ground : {true, false}) {
    CAPTURE(line_on_ground);
    Model m;
    const BodyId beam =
        m.add({.name = "beam", .mass = 3.1, .inertia = 0.77, .pose = {{middle, 0.2}, 0.6}});
    m.add(Revolute{.name = "pin", .a = ground, .b = beam, .at = {0.0, 0.2}});
    const Vec2 right(l, 0.2), along = rotate(slope, {1.0, 0.0});
    if (line_on_ground)
      m.add(PointOnLine{
          .name = "roller", .a = beam, .at = right, .b = ground, .through = right, .along = along});
    else  // the roller sits on the ground, its track under the beam
      m.add(PointOnLine{
          .name = "roller", .a = ground, .at = right, .b = beam, .through = right, .along = along});
    m.add(Gravity{.acceleration = {0.0, -g}});
    m.add(AppliedForce{.name = "load", .body = beam, .at = {at, 0.2}, .force = [=](double) -> Vec2 {
                         return {0.0, -load};
                       }});
    Dynamics dynamics(m);
    State state = m.start_state();
    REQUIRE(dynamics.assemble(state));
    CHECK(state.a.norm() < 1e-13);

    const double R_y = (weight * middle + load * at) / l;  // moments about the pin
    const double R_x = -R_y * std::tan(slope);             // normal to the track
    const Reaction pin = dynamics.reaction(0, state.lambda.data());
    CHECK(pin.force.x() == Approx(-R_x).epsilon(1e-13));
    CHECK(pin.force.y() == Approx(weight + load - R_y).epsilon(1e-13));
    CHECK(std::abs(pin.moment) < 1e-13);
    // On the body that carries the point: the beam, or the ground.
    const Reaction roller = dynamics.reaction(1, state.lambda.data());
    const double sign = line_on_ground ? 1.0 : -1.0;
    CHECK(roller.force.x() == Approx(sign * R_x).epsilon(1e-13));
    CHECK(roller.force.y() == Approx(sign * R_y).epsilon(1e-13));
  }
}

TEST_CASE("a cantilever's clamp carries the moment of the load about the clamp") {
  Model m;
  const BodyId beam = m.add({.name = "beam", .mass = 2.0, .inertia = 0.4, .pose = {{0.7, 1.1}, 0}});
  m.add(Weld{.name = "clamp", .a = ground, .b = beam, .at = Vec2(0.1, 1.1)});
  m.add(AppliedForce{.name = "load", .body = beam, .at = {1.5, 1.1}, .force = [](double) -> Vec2 {
                       return {2.5, -13.0};
                     }});
  Dynamics dynamics(m);
  State state = m.start_state();
  REQUIRE(dynamics.assemble(state));
  const Reaction clamp = dynamics.reaction(0, state.lambda.data());
  CHECK(clamp.force.x() == Approx(-2.5).epsilon(1e-14));
  CHECK(clamp.force.y() == Approx(13.0).epsilon(1e-14));
  CHECK(clamp.moment == Approx(13.0 * 1.4).epsilon(1e-14));
}

TEST_CASE("on a plane the projection is the nearest point in the metric of the masses") {
  Model m;
  const double c = 0.37, ma = 1.7, mb = 0.4, Jb = 0.09, t = 0.8;
  const BodyId a = m.add({.name = "a", .mass = ma, .inertia = 0.3, .pose = {{0.9, -0.2}, 0.5}});
  const BodyId b = m.add({.name = "b", .mass = mb, .inertia = Jb, .pose = {{-0.6, 1.4}, -0.8}});
  m.add(Plane(a, b, c));
  Dynamics dynamics(m);
  State state = m.start_state();
  state.t = t;
  state.v << 0.3, -0.8, 1.1, 0.7, -0.4, 2.2;
  const Eigen::VectorXd q = state.q, v = state.v;
  REQUIRE(dynamics.project(state));

  // Lagrange: dq = -M^-1 G^T r / (G M^-1 G^T)
  const double mobility = 1.3 * 1.3 / ma + 0.7 * 0.7 / mb + 0.4 * 0.4 / Jb;
  const auto moved = [&](double residual) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(6);
    d[0] = -1.3 / ma, d[4] = 0.7 / mb, d[5] = -0.4 / Jb;
    return Eigen::VectorXd(d * residual / mobility);
  };
  const double phi = 1.3 * q[0] - 0.7 * q[4] + 0.4 * q[5] - c - 0.2 * t;
  const double phi_dot = 1.3 * v[0] - 0.7 * v[4] + 0.4 * v[5] - 0.2;
  CHECK((state.q - q - moved(phi)).cwiseAbs().maxCoeff() < 1e-14);
  CHECK((state.v - v - moved(phi_dot)).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(std::abs(1.3 * state.q[0] - 0.7 * state.q[4] + 0.4 * state.q[5] - c - 0.2 * t) < 1e-15);
}

TEST_CASE("on a curved constraint the way of the projection is normal to it, and it is made once") {
  const Pendulum p;
  const Model model = p.model();
  Dynamics dynamics(model);
  double previous = 1.0;
  for (const double size : {1e-2, 1e-4}) {
    State state = model.start_state();
    const Eigen::Vector3d off(0.7 * size, -0.4 * size, 0.9 * size);
    state.q += off;
    state.v += 3.0 * off;
    const Eigen::VectorXd q = state.q, v = state.v;
    REQUIRE(dynamics.project(state));
    // The tangent of the motion allowed: turning about the pivot.
    const Vec2 d = rotate(state.q[2], {p.arm, 0.0});
    const Eigen::Vector3d tangent(-d.y(), d.x(), 1.0), M(p.mass, p.mass, p.inertia);
    const auto slip = [&](const Eigen::VectorXd& way) {
      const Eigen::VectorXd weighted = M.cwiseProduct(way);
      return std::abs(weighted.dot(tangent)) / weighted.norm();
    };
    CHECK(slip(state.q - q) < 2.0 * size);
    CHECK(slip(state.q - q) < previous);
    CHECK(slip(state.v - v) < 1e-12);  // linear: exact
    previous = slip(state.q - q);
    CHECK((Vec2(state.q.head<2>()) - d - p.pivot).norm() < 1e-15);

    const Eigen::VectorXd q1 = state.q, v1 = state.v;
    REQUIRE(dynamics.project(state));
    CHECK(state.q == q1);
    CHECK((state.v - v1).cwiseAbs().maxCoeff() < 4e-16 * v1.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("a smooth projection corrects also what is within rounding of the largest coordinate") {
  const Pendulum p;
  const Model model = p.model();
  Dynamics dynamics(model);
  State state = model.start_state();
  state.q[2] += 2000.0 * pi;
  REQUIRE(dynamics.project(state));
  const double small = 1e-12;  // 16 roundings of 6283 rad are 2.2e-11
  const auto away = [&](const Eigen::VectorXd& q) {
    return (Vec2(q.head<2>()) - rotate(q[2], {p.arm, 0.0}) - p.pivot).norm();
  };
  for (const Correction how : {Correction::coarse, Correction::smooth, Correction::exact}) {
    Eigen::VectorXd q = state.q, v = state.v;
    q[0] += small;
    v[1] += 0.1;
    REQUIRE(dynamics.project(0.0, q.data(), v.data(), how));
    if (how == Correction::coarse) {
      CHECK(q[0] == state.q[0] + small);
    } else {
      CHECK(away(q) < 0.3 * small);
    }
    // Velocities fit wherever the position is, also where factors of before the correction serve.
    const Vec2 d = rotate(q[2], {p.arm, 0.0});
    CHECK((Vec2(v.head<2>()) - v[2] * Vec2(-d.y(), d.x())).norm() < 0.1 * small);
  }
}

TEST_CASE("effective mass of a free body is that of a push beside its centre of mass") {
  Model m;
  const BodyId a = m.add({.name = "a", .mass = 1.7, .inertia = 0.09, .pose = {{0.4, 0.3}, 0.8}});
  m.add(Probe<1>({a}));
  const Vec2 n = rotate(1.1, {1.0, 0.0}), d(0.21, -0.13);
  const double lever = cross(d, n);
  CHECK(effective_mass(m, push(n, d)) ==
        Approx(1.0 / (1.0 / 1.7 + lever * lever / 0.09)).epsilon(1e-14));
}

TEST_CASE("effective mass between two free bodies is the reduced mass") {
  Model m;
  const BodyId a = m.add({.name = "a", .mass = 1.7, .inertia = 0.09});
  const BodyId b = m.add({.name = "b", .mass = 0.6, .inertia = 0.05, .pose = {{1.0, 0.0}, 0.0}});
  m.add(Probe<2>({a, b}));
  CHECK(effective_mass(m, {1.0, 0.0, 0.0, -1.0, 0.0, 0.0}) ==
        Approx(1.7 * 0.6 / 2.3).epsilon(1e-14));
}

TEST_CASE("effective mass of a pin on a crank is the crank's inertia about its pivot over r^2") {
  const Pendulum crank;
  Model m = crank.model();
  m.add(Probe<1>({m.find_body("rod")}));
  // Pin at r from the pivot in the direction of the rod, pushed at 50 degrees to the tangent.
  const double r = 0.9, oblique = 50.0 * pi / 180.0;
  const Vec2 n = rotate(crank.angle + pi / 2.0 + oblique, {1.0, 0.0});
  const Vec2 d = rotate(crank.angle, {r - crank.arm, 0.0});
  const double about_pivot = crank.inertia + crank.mass * crank.arm * crank.arm;
  CHECK(effective_mass(m, push(n, d)) ==
        Approx(about_pivot / std::pow(r * std::cos(oblique), 2)).epsilon(1e-13));
  // Along the rod nothing gives.
  CHECK(effective_mass(m, push(rotate(crank.angle, {1.0, 0.0}), d)) > 1e14);
}

TEST_CASE("against a driven crank only the slider counts, along its guide") {
  const Pendulum crank;
  const double slider_mass = 2.353, direction = 0.35;
  for (const bool driven : {true, false}) {
    CAPTURE(driven);
    Model m = crank.model();
    const BodyId rod = m.find_body("rod");
    const BodyId slider =
        m.add({.name = "slider", .mass = slider_mass, .inertia = 0.0035, .pose = {{2.0, 0.3}, 0}});
    m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
    const double omega = crank.omega, angle = crank.angle;
    if (driven)
      m.add(AngleDriver{.name = "motor", .body = rod, .angle = constant_speed(angle, omega)});
    m.add(Probe<2>({rod, slider}));
    const double r = 0.9;
    const Vec2 n = rotate(direction, {1.0, 0.0}), d = rotate(angle, {r - crank.arm, 0.0});
    const Vec2 lever_slider(0.4, -0.7);  // takes no part: the slider cannot turn
    const double lever = cross(rotate(angle, {r, 0.0}), n);
    const double about_pivot = crank.inertia + crank.mass * crank.arm * crank.arm;
    const double crank_mobility = driven ? 0.0 : lever * lever / about_pivot;
    const double slider_mobility = n.x() * n.x() / slider_mass;
    CHECK(effective_mass(m, {n.x(), n.y(), cross(d, n), -n.x(), -n.y(), -cross(lever_slider, n)}) ==
          Approx(1.0 / (crank_mobility + slider_mobility)).epsilon(1e-13));
  }
}

TEST_CASE("where nothing gives the effective mass is infinite or beyond any mass") {
  Model m;
  const BodyId a = m.add({.name = "a", .mass = 1.7, .inertia = 0.09});
  m.add(Weld{.name = "weld", .a = ground, .b = a});
  m.add(Probe<1>({a}));
  CHECK(effective_mass(m, {0.6, 0.8, 0.1}) > 1e14);
}

TEST_CASE("a compound with a point mass swings like the rod with the mass welded on") {
  const Pendulum p{.omega = 0.0};
  const Vec2 tip = p.pivot + rotate(p.angle, {1.2, 0.0});
  Model compound;
  const Body rod = p.model().bodies()[1];
  const BodyId one = compound.add(with_point_mass(rod, 0.8, tip));
  compound.add(Revolute{.name = "pivot", .a = ground, .b = one, .at = p.pivot});
  compound.add(Gravity{.acceleration = {0.0, -g}});
  Dynamics dynamics(compound);
  State state = compound.start_state();
  REQUIRE(dynamics.assemble(state));
  const double inertia = p.inertia + p.mass * p.arm * p.arm + 0.8 * 1.2 * 1.2;
  const double moment = -g * std::cos(p.angle) * (p.mass * p.arm + 0.8 * 1.2);
  CHECK(state.a[2] == Approx(moment / inertia).epsilon(1e-13));
}

TEST_CASE("masses twelve orders of magnitude apart keep their digits") {
  // A mote on a boulder's edge: the boulder falls as if alone, the mote with the edge.
  Model m;
  const BodyId boulder = m.add({.name = "boulder", .mass = 1e6, .inertia = 3e5});
  const BodyId mote =
      m.add({.name = "mote", .mass = 1e-6, .inertia = 1e-13, .pose = {{0.7, 0.0}, 0.0}});
  m.add(Revolute{.name = "grip", .a = boulder, .b = mote, .at = {0.7, 0.0}});
  m.add(
      AppliedForce{.name = "blow", .body = boulder, .at = {0.0, 0.4}, .force = [](double) -> Vec2 {
                     return {2e6, 0.0};
                   }});
  Dynamics dynamics(m);
  State state = m.start_state();
  REQUIRE(dynamics.assemble(state));
  const double alpha = -0.4 * 2e6 / 3e5;
  CHECK(state.a[0] == Approx(2.0).epsilon(1e-11));
  CHECK(state.a[2] == Approx(alpha).epsilon(1e-11));
  CHECK(state.a[4] == Approx(0.7 * alpha).epsilon(1e-11));
  const Reaction grip = dynamics.reaction(0, state.lambda.data());
  CHECK(grip.force.x() == Approx(2e-6).epsilon(1e-9));
  CHECK(grip.force.y() == Approx(0.7e-6 * alpha).epsilon(1e-9));
}

TEST_CASE("how bodies on a massless rod start does not depend on what they are not joined to") {
  // A slider on a rod without mass, at rates that do not fit; beside it a heavy body far away.
  const auto start = [](bool bystander) {
    Model m;
    const BodyId rod = m.add(Body{.name = "rod",
                                  .mass = 0.0,
                                  .inertia = 0.0,
                                  .pose = {{0.2, 0.15}, 0.6},
                                  .twist = {{0.3, 0.1}, 0.4}});
    const BodyId link = m.add(Body{.name = "link",
                                   .mass = 1.0,
                                   .inertia = 0.01,
                                   .pose = {{0.0, 0.15}, 0.0},
                                   .twist = {{0.1, 0.0}, 2.0}});
    const BodyId slider = m.add(Body{.name = "slider",
                                     .mass = 2.0,
                                     .inertia = 0.01,
                                     .pose = {{0.4, 0.0}, 0.0},
                                     .twist = {{-1.0, 0.2}, 0.5}});
    if (bystander)
      m.add(Body{.name = "far", .mass = 1e6, .inertia = 1e6, .pose = {{30.0, 10.0}, 0.0}});
    m.add(Revolute{.name = "pivot", .a = ground, .b = link, .at = {0.0, 0.0}});
    m.add(Revolute{.name = "pin", .a = link, .b = rod, .at = {0.0, 0.3}});
    m.add(Revolute{.name = "end", .a = rod, .b = slider, .at = {0.4, 0.0}});
    // Fixed twice: where joints depend on each other, the start is sought in the metric of masses.
    const BodyId plate =
        m.add(Body{.name = "plate", .mass = 1.0, .inertia = 0.01, .pose = {{0.5, 0.5}, 0.0}});
    m.add(Weld{.name = "weld", .a = ground, .b = plate});
    m.add(Weld{.name = "second weld", .a = ground, .b = plate});
    Dynamics dynamics(m);
    State state = m.start_state();
    REQUIRE(dynamics.assemble(state));
    return Eigen::VectorXd(state.v.head(9));  // of rod, link and slider
  };
  const Eigen::VectorXd alone = start(false), beside = start(true);
  CHECK((alone - beside).norm() < 1e-12 * alone.norm());
}
