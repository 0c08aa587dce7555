// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Elements as users write them, outside the library: only the equation or the law.
#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include <yoke/core/authoring/auto_constraint.hpp>
#include <yoke/core/authoring/auto_force.hpp>
#include <yoke/core/authoring/check.hpp>
#include <yoke/core/model.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/joints/fixture.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::tests;

namespace {

struct Mechanism {
  Model model;
  BodyId crank =
      model.add({.name = "crank", .mass = 0.09, .inertia = 3e-5, .pose = {{0.31, -0.72}, 0.43}});
  BodyId slider =
      model.add({.name = "slider", .mass = 2.35, .inertia = 3e-3, .pose = {{-0.57, 0.88}, -1.19}});
};

void check(const Model& model, double tolerance = 1e-8) {
  for (const ElementCheck& result : check_elements(model)) {
    INFO(result.message());
    CHECK(result.ok(tolerance));
  }
}

// ------------------------------------------------------------- the shortest way: one class, add it

// A pin of a stays on a circular arc fixed in b: |p - centre| - R = 0 [m].
class PointOnArc : public AutoConstraint<PointOnArc, 1, 2> {
 public:
  PointOnArc(const std::string& name, BodyId a, BodyId b, const Vec2& pin, const Vec2& centre,
             double R)
      : AutoConstraint(name, {a, b}, {{"radial", Measure::length}}),
        pin_(pin),
        centre_(centre),
        R_(R) {}

  template <class T>
  T phi(const AutoPose<T>& a, const AutoPose<T>& b, const T& /*t*/) const {
    return (a.point(pin_) - b.point(centre_)).norm() - R_;
  }

 private:
  Vec2 pin_, centre_;  // in body axes
  double R_;
};

// -------------------------------------------- placed by global geometry, described with names

class ArcDriveConstraint;

struct ArcDrive {
  std::string name;
  BodyId a;
  BodyId b;
  Vec2 at{0.0, 0.0};  // [m] pin on a, global
  double swing = 0.0;

  std::unique_ptr<Constraint> build(const Model& model) const;
};

// Two equations with time in them: the pin of a follows a moving point of b, and b turns with a.
class ArcDriveConstraint : public AutoConstraint<ArcDriveConstraint, 2, 2> {
 public:
  ArcDriveConstraint(const ArcDrive& d, const Vec2& pin)
      : AutoConstraint(d.name, {d.a, d.b}, {{"path", Measure::length}, {"twist", Measure::angle}}),
        pin_(pin),
        swing_(d.swing) {}

  template <class T>
  Eigen::Vector2<T> phi(const AutoPose<T>& a, const AutoPose<T>& b, const T& t) const {
    const auto local = b.to_local(Eigen::Vector2<T>(a.point(pin_) - b.position()));
    const auto height = swing_ * sin(3.0 * t);
    return {local.y() - height * local.x() * local.x(), b.angle - 0.5 * pow(a.angle, 2) - t};
  }
  bool rheonomic() const override { return true; }

 private:
  Vec2 pin_;
  double swing_;
};

std::unique_ptr<Constraint> ArcDrive::build(const Model& model) const {
  return std::make_unique<ArcDriveConstraint>(*this, model.to_local(a, at));
}

// ------------------------------------------------- built-in elements written the automatic way

class AutoRevolute : public AutoConstraint<AutoRevolute, 2, 2> {
 public:
  AutoRevolute(BodyId a, BodyId b, const Vec2& s_a, const Vec2& s_b)
      : AutoConstraint("auto", {a, b}, {{"x", Measure::length}, {"y", Measure::length}}),
        s_a_(s_a),
        s_b_(s_b) {}
  template <class T>
  Eigen::Vector2<T> phi(const AutoPose<T>& a, const AutoPose<T>& b, const T&) const {
    return b.point(s_b_) - a.point(s_a_);
  }

 private:
  Vec2 s_a_, s_b_;
};

struct OneNameForTwo : AutoConstraint<OneNameForTwo, 2, 2> {
  OneNameForTwo(const std::string& name, BodyId a, BodyId b)
      : AutoConstraint(name, {a, b}, {{"x", Measure::length}}) {}
  template <class T>
  Eigen::Vector2<T> phi(const AutoPose<T>& a, const AutoPose<T>& b, const T&) const {
    return b.position() - a.position();
  }
};

class AutoSpring : public AutoForce<AutoSpring, 2> {
 public:
  AutoSpring(BodyId a, BodyId b, const Vec2& s_a, const Vec2& s_b)
      : AutoForce("auto", {a, b}), s_a_(s_a), s_b_(s_b) {}
  template <class T>
  void apply(AutoBody<T>& a, AutoBody<T>& b, AutoElement<T>& e) const {
    const Eigen::Vector2<T> d = b.point(s_b_) - a.point(s_a_);
    const Eigen::Vector2<T> rate = b.point_velocity(s_b_) - a.point_velocity(s_a_);
    const T length = d.norm();
    const T length_rate = d.dot(rate) / length;
    const double k = e.parameters[0], c = e.parameters[1], free_length = e.parameters[2];
    const Eigen::Vector2<T> pull = d * ((k * (length - free_length) + c * length_rate) / length);
    a.add_force(pull, a.point(s_a_));
    b.add_force(-pull, b.point(s_b_));
    e.potential += 0.5 * k * (length - free_length) * (length - free_length);
    e.dissipated_power += c * length_rate * length_rate;
  }
  bool dissipates() const override { return true; }
  std::vector<Parameter> parameters() const override {
    return {{"stiffness", "N/m", 130}, {"damping", "N s/m", 17}, {"free_length", "m", 0.37}};
  }

 private:
  Vec2 s_a_, s_b_;
};

// ---------------------------------------------------------------- forces of users' own

// Hardens, F = k d + k3 d^3; acts between the centres.
class HardeningSpring : public AutoForce<HardeningSpring, 2> {
 public:
  HardeningSpring(std::string name, BodyId a, BodyId b) : AutoForce(std::move(name), {a, b}) {}

  template <class T>
  void apply(AutoBody<T>& a, AutoBody<T>& b, AutoElement<T>& e) const {
    const Eigen::Vector2<T> d = b.position() - a.position();
    const auto stretch = d.norm() - 0.2;
    const auto tension = stretch > 0.0 ? 50.0 * stretch + 900.0 * pow(stretch, 3) : T(0.0);
    a.add_force(d.normalized() * tension, a.position());
    b.add_force(d.normalized() * -tension, b.position());
    if (stretch > 0.0) e.potential += 25.0 * stretch * stretch + 225.0 * pow(stretch, 4);
  }
};

// Spring and dashpot in series; z is how far the dashpot is drawn out: c z' = k (twist - z).
class MaxwellTorsion : public AutoForce<MaxwellTorsion, 2, 1> {
 public:
  MaxwellTorsion(std::string name, BodyId a, BodyId b) : AutoForce(std::move(name), {a, b}) {}

  template <class T>
  void apply(AutoBody<T>& a, AutoBody<T>& b, AutoElement<T, 1>& e) const {
    const double k = e.parameters[0], c = e.parameters[1];
    const T twist = b.angle - a.angle - e.z[0];
    a.add_torque(k * twist);
    b.add_torque(-k * twist);
    e.z_dot[0] = k / c * twist;
    e.potential += 0.5 * k * twist * twist;
    e.dissipated_power += k * twist * k * twist / c;
  }
  bool dissipates() const override { return true; }
  std::vector<Channel> states() const override { return {{"dashpot", "rad"}}; }
  void initial_states(double* z) const override { z[0] = 0.25; }
  std::vector<Parameter> parameters() const override {
    return {{"stiffness", "N m/rad", 8.0}, {"damping", "N m s/rad", 0.7}};
  }
};

}  // namespace

TEST_CASE("a user's constraint: pin on a circular arc, from its equation alone") {
  Mechanism m;
  m.model.add(PointOnArc("arc", m.crank, m.slider, {0.045, 0.01}, {-0.02, 0.03}, 0.060));
  m.model.add(PointOnArc("arc on ground", m.crank, ground, {0.045, 0.01}, {0.4, 0.3}, 0.060));
  m.model.add(PointOnArc("pin on ground", ground, m.crank, {0.4, 0.3}, {0.045, 0.01}, 0.060));
  check(m.model);
}

TEST_CASE("a user's constraint: acceleration of a pin that runs round a fixed circle") {
  Mechanism m;
  // Pin at the centre of the crank, 2 m to the right of the circle's centre, upwards at 3 m/s:
  // G v' = gamma must ask for the centripetal acceleration -9 / 2 along x.
  m.model.add(PointOnArc("arc", m.crank, ground, {0.0, 0.0}, {0.5, 0.25}, 2.0));
  State state = m.model.start_state();
  state.q.head<3>() << 2.5, 0.25, 0.4;
  state.v.head<3>() << 0.0, 3.0, 11.0;
  std::vector<BodyMotion> bodies(3);
  bodies[1] = {2.5, 0.25, 0.4, std::cos(0.4), std::sin(0.4), 0.0, 3.0, 11.0};
  const auto x = evaluate(*m.model.constraints()[0],
                          {.t = 0.0, .bodies = bodies, .inertia = m.model.bodies()});
  CHECK(near(x.phi, {0.0}));
  CHECK(near({x.G[0], x.G[1], x.G[2]}, {1.0, 0.0, 0.0}));
  CHECK(near(x.gamma, {-4.5}));
}

TEST_CASE("a user's constraint with two rows and time in it, placed by global geometry") {
  Mechanism m;
  m.model.add(ArcDrive{.name = "drive", .a = m.crank, .b = m.slider, .at = {0.2, 0.1}, .swing = 2});
  m.model.insert(std::make_unique<AutoRevolute>(m.crank, m.slider, Vec2(0.1, 0.2), Vec2(0.3, 0.4)));
  check(m.model);
  CHECK(m.model.constraints().size() == 2);
}

TEST_CASE("an automatic constraint names one equation for each row") {
  const Mechanism m;
  CHECK(message_of([&] { OneNameForTwo("pair", m.crank, m.slider); }) ==
        "joint 'pair': 1 equations are named for the 2 rows of phi");
}

TEST_CASE("an automatic constraint equals the hand-written one in every block") {
  Mechanism m;
  const Vec2 at(0.12, 0.34);
  for (const BodyId a : {m.crank, ground}) {
    const auto by_hand = Revolute{.name = "hand", .a = a, .b = m.slider, .at = at}.build(m.model);
    const AutoRevolute automatic(a, m.slider, m.model.to_local(a, at),
                                 m.model.to_local(m.slider, at));
    for (unsigned seed = 1; seed < 4; ++seed) {
      const State state = ugly_state(m.model, seed);
      std::vector<BodyMotion> bodies(3);
      for (int i = 0; i < 2; ++i) {
        const double angle = state.q[3 * i + 2];
        bodies[static_cast<std::size_t>(i + 1)] = {
            state.q[3 * i],     state.q[3 * i + 1], angle,
            std::cos(angle),    std::sin(angle),    state.v[3 * i],
            state.v[3 * i + 1], state.v[3 * i + 2]};
      }
      const Motion motion{.t = state.t, .bodies = bodies, .inertia = m.model.bodies()};
      const auto x = evaluate(*by_hand, motion, {1.7, -2.3});
      const auto y = evaluate(automatic, motion, {1.7, -2.3});
      CHECK(near(x.phi, y.phi, 1e-14));
      CHECK(near(x.G, y.G, 1e-14));
      CHECK(near(x.phi_t, y.phi_t, 1e-14));
      CHECK(near(x.gamma, y.gamma, 1e-13));
      CHECK(near(x.H, y.H, 1e-13));
      CHECK(near(x.K, y.K, 1e-13));
    }
  }
}

TEST_CASE("an automatic force equals the hand-written one in every block") {
  Mechanism m;
  const Vec2 p(0.12, 0.34), r(-0.41, 0.27);
  const auto by_hand = TranslationalSpring{.name = "hand",
                                           .a = m.crank,
                                           .b = m.slider,
                                           .at_a = p,
                                           .at_b = r,
                                           .stiffness = 130,
                                           .damping = 17,
                                           .free_length = 0.37}
                           .build(m.model);
  const AutoSpring automatic(m.crank, m.slider, m.model.to_local(m.crank, p),
                             m.model.to_local(m.slider, r));
  std::vector<BodyMotion> bodies(3);
  bodies[1] = {0.4, -0.3, 0.7, std::cos(0.7), std::sin(0.7), 1.3, -0.4, 2.2};
  bodies[2] = {-0.6, 0.5, -1.1, std::cos(1.1), -std::sin(1.1), 0.3, 1.9, -3.1};
  const Motion motion{.t = 0.0, .bodies = bodies, .inertia = m.model.bodies()};
  const double parameters[] = {130, 17, 0.37};
  const auto all = [&](const ForceElement& force) {
    std::vector<double> blocks(6 + 36 + 36);
    Energy energy;
    force.evaluate({.motion = motion, .parameters = parameters}, {.Q = blocks.data(),
                                                                  .dQ_dq = blocks.data() + 6,
                                                                  .dQ_dv = blocks.data() + 42,
                                                                  .energy = &energy});
    blocks.push_back(energy.potential);
    blocks.push_back(energy.dissipated_power);
    return blocks;
  };
  CHECK(near(all(*by_hand), all(automatic), 1e-12));
}

TEST_CASE("a user's spring that hardens, from its law alone") {
  Mechanism m;
  m.model.add(HardeningSpring("spring", m.crank, m.slider));
  m.model.add(HardeningSpring("anchored", ground, m.slider));
  check(m.model);
}

TEST_CASE("a user's force with a state of its own") {
  Mechanism m;
  m.model.add(MaxwellTorsion("maxwell", m.crank, m.slider));
  CHECK(m.model.start_state().z[0] == 0.25);
  check(m.model);
}

TEST_CASE("functions of differentiated scalars have the right first and second derivatives") {
  // f'(x) and f''(x) by a second road: known closed forms at x = 0.4.
  const double x = 0.4;
  const auto second = [x](const auto& f) {
    using First = Dual<double, 1>;
    using Second = Dual2<1>;
    const Second y = f(Second(auto_variable<First>(x, 0), Second::Gradient(First(1.0))));
    return std::pair{y.value().gradient()[0], y.gradient()[0].gradient()[0]};
  };
  const auto expect = [&](const auto& f, double first, double curvature) {
    const auto [d1, d2] = second(f);
    CHECK(near(d1, first, 1e-13));
    CHECK(near(d2, curvature, 1e-13));
  };
  const double r = 1.0 - x * x;
  expect([](auto u) { return asin(u); }, 1 / std::sqrt(r), x / std::pow(r, 1.5));
  expect([](auto u) { return acos(u); }, -1 / std::sqrt(r), -x / std::pow(r, 1.5));
  expect([](auto u) { return atan(u); }, 1 / (1 + x * x), -2 * x / std::pow(1 + x * x, 2));
  expect([](auto u) { return atan2(u, 2.0); }, 2 / (4 + x * x), -4 * x / std::pow(4 + x * x, 2));
  expect([](auto u) { return atan2(2.0, u); }, -2 / (4 + x * x), 4 * x / std::pow(4 + x * x, 2));
  expect([](auto u) { return pow(u, 2.5); }, 2.5 * std::pow(x, 1.5), 3.75 * std::sqrt(x));
  expect([](auto u) { return pow(u, 0); }, 0.0, 0.0);
  expect([](auto u) { return pow(u, u); }, std::pow(x, x) * (1 + std::log(x)),
         std::pow(x, x) * (std::pow(1 + std::log(x), 2) + 1 / x));
  expect([](auto u) { return hypot(u, 0.3); }, 0.8, 0.09 / 0.125);
  expect([](auto u) { return abs(-u); }, 1.0, 0.0);
  expect([](auto u) { return abs2(u); }, 0.8, 2.0);
  expect([](auto u) { return exp(u) * log(u); }, std::exp(x) * (std::log(x) + 1 / x),
         std::exp(x) * (std::log(x) + 2 / x - 1 / (x * x)));
  expect([](auto u) { return tan(u); }, 1 + std::tan(x) * std::tan(x),
         2 * std::tan(x) * (1 + std::tan(x) * std::tan(x)));
  expect([](auto u) { return tanh(u); }, 1 - std::tanh(x) * std::tanh(x),
         -2 * std::tanh(x) * (1 - std::tanh(x) * std::tanh(x)));
  expect([](auto u) { return sinh(u) + cosh(u); }, std::exp(x), std::exp(x));
  expect([](auto u) { return 1 / u - u / 2 + (3 - u); }, -1 / (x * x) - 1.5, 2 / (x * x * x));
  expect([](auto u) { return sqrt(u); }, 0.5 / std::sqrt(x), -0.25 / std::pow(x, 1.5));
  expect([](auto u) { return std::max(u, 2.0 * u); }, 2.0, 0.0);
  expect(
      [](auto u) {
        auto y = u;
        y += 2.0, y *= u, y -= 1.0, y /= u;
        return y;
      },
      1 + 1 / (x * x), -2 / (x * x * x));
}
