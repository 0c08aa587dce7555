// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Friction of ideal joints from their reactions, against closed forms and equations of one coordinate in
// which the friction is solved for with the acceleration.
#include <doctest/doctest.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <yoke/contact/clearance.hpp>
#include <yoke/contact/laws/catalog/friction_catalog.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/friction/coulomb.hpp>
#include <yoke/contact/laws/friction/lugre.hpp>
#include <yoke/contact/laws/friction/regularised_coulomb.hpp>
#include <yoke/core/assembly.hpp>
#include <yoke/integrators/analyses/inverse_dynamics.hpp>
#include <yoke/integrators/analyses/mechanics.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

namespace {

constexpr double g = 9.81;

/// What generalised-alpha, of order 2, reaches with reasonable effort.
double tolerance_of(const FormulationNote& f, double rtol) {
  return f.name == "generalised-alpha" ? std::max(rtol, 1e-7) : rtol;
}

std::vector<double> times_of(const Result& r, const std::string& kind, const std::string& element) {
  std::vector<double> times;
  for (const EventRecord& e : r.events)
    if (e.kind == kind && e.element == element) times.push_back(e.t);
  return times;
}

TEST_CASE("joint friction: a rotor in its bearing stops where the closed form says, and stays") {
  const double m = 3.0, I = 0.02, r = 0.01, mu = 0.2, w0 = 4.0;
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    Model model;
    const BodyId rotor =
        model.add(Body{.name = "rotor", .mass = m, .inertia = I, .twist = {{0.0, 0.0}, w0}});
    model.add(Gravity{});
    model.add(Revolute{.name = "bearing",
                       .a = ground,
                       .b = rotor,
                       .friction = PinFriction{.law = Coulomb{mu, mu}, .radius = r}});
    const double rtol = tolerance_of(f, 1e-10);
    const Result result = simulate(model, {.until = 3.0,
                                           .relative_tolerance = rtol,
                                           .formulation = std::string(f.name),
                                           .samples = 31});
    REQUIRE(result.summary.ok());
    const double slowing = mu * r * m * g / I, stop = w0 / slowing;
    const std::vector<double> sticks = times_of(result, "stick", "bearing.friction");
    REQUIRE(sticks.size() == 1);
    CHECK(sticks[0] == Approx(stop).epsilon(10.0 * rtol));
    CHECK(result.final.q[2] == Approx(0.5 * w0 * stop).epsilon(100.0 * rtol));
    CHECK(result.final.v[2] == 0.0);
    CHECK(result["bearing.friction.load_N"][3] == Approx(m * g).epsilon(1e-9));
    CHECK(result["bearing.friction.friction_force_N"][3] == Approx(mu * m * g).epsilon(1e-9));
    CHECK(result["dissipated_J"].tail(1)[0] == Approx(0.5 * I * w0 * w0).epsilon(100.0 * rtol));
    CHECK(result.summary.energy_balance < 1e2 * rtol * 0.5 * I * w0 * w0);
  }
}

/// A rod that hangs from a pin with friction, by one coordinate: the load depends on the acceleration,
/// the acceleration on the load.
struct PendulumLine {
  double m, I, l, r, mu;
  double acceleration(double angle, double rate) const {
    const double way = rate > 0.0 ? 1.0 : -1.0;
    const auto off = [&](double a) {
      const double along = m * (g * std::cos(angle) + l * rate * rate);
      const double across = m * (g * std::sin(angle) + l * a);
      return (I + m * l * l) * a + m * g * l * std::sin(angle) +
             way * mu * r * std::hypot(along, across);
    };
    std::uintmax_t most = 200;
    const auto [low, high] = boost::math::tools::toms748_solve(
        off, -1e3, 1e3, boost::math::tools::eps_tolerance<double>(52), most);
    return 0.5 * (low + high);
  }
  double angle_at(double t, double angle, double rate) const {
    using State = std::array<double, 2>;
    State x{angle, rate};
    const auto slope = [this](const State& y, State& dy, double) {
      dy = {y[1], acceleration(y[0], y[1])};
    };
    boost::numeric::odeint::integrate_adaptive(
        boost::numeric::odeint::make_controlled<
            boost::numeric::odeint::runge_kutta_fehlberg78<State>>(1e-13, 1e-13),
        slope, x, 0.0, t, 1e-3);
    return x[0];
  }
};

Model pendulum(const PendulumLine& p, double angle, double rate, double turned = 0.0) {
  Model model;
  const double c = std::cos(turned), s = std::sin(turned);
  const auto turn = [&](const Vec2& v) {
    return Vec2(c * v.x() - s * v.y(), s * v.x() + c * v.y());
  };
  const Vec2 arm(p.l * std::sin(angle), -p.l * std::cos(angle));
  const BodyId rod = model.add(Body{.name = "rod",
                                    .mass = p.m,
                                    .inertia = p.I,
                                    .pose = {turn(arm), angle + turned},
                                    .twist = {turn(rate * perp(arm)), rate}});
  model.add(Gravity{.acceleration = turn({0.0, -g})});
  model.add(Revolute{.name = "pin",
                     .a = ground,
                     .b = rod,
                     .friction = PinFriction{.law = Coulomb{p.mu, p.mu}, .radius = p.r}});
  return model;
}

TEST_CASE("joint friction: a pendulum follows its load, which depends on its acceleration") {
  const PendulumLine p{.m = 2.0, .I = 0.05, .l = 0.3, .r = 0.04, .mu = 0.3};
  const double t = 0.35;  // within the first swing
  const double expected = p.angle_at(t, -1.4, 0.5);
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    const double rtol = tolerance_of(f, 1e-11);
    for (const double turned : {0.0, 0.7}) {
      const Result r = simulate(pendulum(p, -1.4, 0.5, turned), {.until = t,
                                                                 .relative_tolerance = rtol,
                                                                 .formulation = std::string(f.name),
                                                                 .samples = 3});
      REQUIRE(r.summary.ok());
      CHECK(r.final.q[2] - turned == Approx(expected).epsilon(100.0 * rtol));
    }
  }
}

TEST_CASE("joint friction: a pendulum comes to rest within its dead band and balances its energy") {
  const PendulumLine p{.m = 2.0, .I = 0.05, .l = 0.3, .r = 0.04, .mu = 0.3};
  const Result r = simulate(pendulum(p, 1.4, 0.0), {.until = 12.0, .relative_tolerance = 1e-11});
  REQUIRE(r.summary.ok());
  CHECK(r.final.v[2] == 0.0);
  // At rest N = m g: it holds where m g l |sin| <= mu r m g.
  CHECK(std::abs(std::sin(r.final.q[2])) < p.mu * p.r / p.l);
  CHECK(r.summary.energy_balance < 1e-9 * p.m * g * p.l);
  CHECK(times_of(r, "stick", "pin.friction").size() == 1);
  // Released beyond the band it falls, within it stays.
  const double edge = std::asin(p.mu * p.r / p.l);
  const Eigen::VectorXd within =
      simulate(pendulum(p, 0.999 * edge, 0.0), {.until = 1.0})["rod.angle_rad"];
  CHECK(std::abs(within.tail(1)[0] - 0.999 * edge) < 1e-15);
  CHECK(simulate(pendulum(p, 1.001 * edge, 0.0), {.until = 1.0}).final.q[2] < edge);
}

struct Drawer {
  double mass = 2.0, length = 0.2, arm = 0.0, push = 10.0, mu = 0.3, speed = 0.0;
  double lean = 0.0;  // [rad] of the guide; there is no gravity
};

/// A block in a guide, pushed along it beside its middle.
Model drawer(const Drawer& d) {
  Model model;
  const Vec2 along(std::cos(d.lean), std::sin(d.lean));
  const BodyId block = model.add(Body{.name = "block",
                                      .mass = d.mass,
                                      .inertia = 0.01,
                                      .pose = {{0.0, 0.0}, d.lean},
                                      .twist = {d.speed * along, 0.0}});
  model.add(Prismatic{.name = "guide",
                      .a = ground,
                      .b = block,
                      .along = along,
                      .friction = GuideFriction{.law = Coulomb{d.mu, d.mu}, .length = d.length}});
  model.add(AppliedForce{
      .name = "push", .body = block, .at = d.arm * perp(along), .value = d.push * along});
  return model;
}

TEST_CASE("joint friction: a block pushed beside its middle slides under the load of its moment") {
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    const Drawer d{.arm = 0.15, .speed = 0.4, .lean = 0.6};
    const double rtol = tolerance_of(f, 1e-10), t = 0.5;
    const double load = d.push * d.arm * 2.0 / d.length;
    const double a = (d.push - d.mu * load) / d.mass;
    const Result r = simulate(
        drawer(d),
        {.until = t, .relative_tolerance = rtol, .formulation = std::string(f.name), .samples = 3});
    REQUIRE(r.summary.ok());
    const double way = r.final.q.head<2>().dot(Vec2(std::cos(d.lean), std::sin(d.lean)));
    CHECK(way == Approx(d.speed * t + 0.5 * a * t * t).epsilon(10.0 * rtol));
    CHECK(r["guide.friction.load_N"][1] == Approx(load).epsilon(1e-9));
  }
}

TEST_CASE("joint friction: a drawer jams where 2 mu arm > length, however hard it is pushed") {
  Drawer d{.arm = 0.35, .speed = 0.4};
  const double slowing = (2.0 * d.mu * d.arm / d.length - 1.0) * d.push / d.mass;
  REQUIRE(slowing > 0.0);
  const Result r = simulate(drawer(d), {.until = 60.0, .relative_tolerance = 1e-10});
  REQUIRE(r.summary.ok());
  CHECK(r.final.q[0] == Approx(0.5 * d.speed * d.speed / slowing).epsilon(1e-8));
  CHECK(r.final.v[0] == 0.0);
  d.speed = 0.0;
  d.push = 1e6;
  CHECK(simulate(drawer(d), {.until = 1.0}).final.q[0] == 0.0);
  d.arm = 0.33;  // hardly less than length/(2 mu)
  CHECK(simulate(drawer(d), {.until = 1.0}).final.q[0] > 1.0);
}

/// A crank, a rod and a slider with friction in all four joints.
struct SliderCrank {
  double R = 0.1, l = 0.25, angle = 0.8, speed = 0.0;
  double r_ground = 0.012, r_crank = 0.01, r_slider = 0.008;  // [m] of the pins
  double press = 0.0;                                         // [N] against the slider
  FrictionLaw law = Coulomb{0.2, 0.2};
  double preload = 0.0;  // [N] of each joint
  bool guide = true;
  double mirror = 1.0, lean = 0.0;
  std::function<double(double)> torque{};

  double rod_angle() const { return -std::asin(R * std::sin(angle) / l); }
  Model model() const {
    Model m;
    const double c = std::cos(lean), s = std::sin(lean);
    const auto place = [&](double x, double y) {
      return Vec2(c * x - s * mirror * y, s * x + c * mirror * y);
    };
    const double beta = rod_angle();
    const double beta_rate = -R * std::cos(angle) * speed / (l * std::cos(beta));
    const Vec2 A(R * std::cos(angle), R * std::sin(angle));
    const Vec2 B = A + l * Vec2(std::cos(beta), std::sin(beta));
    const Vec2 v_A = speed * perp(A), v_B = v_A + beta_rate * perp(Vec2(B - A));
    const auto body = [&](const char* name, double mass, double inertia, const Vec2& at,
                          double turn, const Vec2& v, double w) {
      return m.add(Body{.name = name,
                        .mass = mass,
                        .inertia = inertia,
                        .pose = {place(at.x(), at.y()), lean + mirror * turn},
                        .twist = {place(v.x(), v.y()), mirror * w}});
    };
    const BodyId crank = body("crank", 1.0, 0.004, 0.5 * A, angle, 0.5 * v_A, speed);
    const BodyId rod = body("rod", 0.6, 0.004, 0.5 * (A + B), beta, 0.5 * (v_A + v_B), beta_rate);
    const BodyId slider = body("slider", 1.5, 0.002, B, 0.0, v_B, 0.0);
    const auto pin = [&](const char* name, BodyId a, BodyId b, const Vec2& at, double r) {
      m.add(Revolute{.name = name,
                     .a = a,
                     .b = b,
                     .at = place(at.x(), at.y()),
                     .friction = PinFriction{.law = law, .radius = r, .preload = preload}});
    };
    pin("ground_pin", ground, crank, {0.0, 0.0}, r_ground);
    pin("crank_pin", crank, rod, A, r_crank);
    pin("slider_pin", rod, slider, B, r_slider);
    Prismatic along{.name = "guide", .a = ground, .b = slider, .along = {c, s}};
    if (guide) along.friction = GuideFriction{.law = law, .length = 0.06, .preload = preload};
    m.add(along);
    if (press != 0.0)
      m.add(AppliedForce{
          .name = "press", .body = slider, .at = place(B.x(), 0.0), .value = place(-press, 0.0)});
    if (torque) {
      const auto given = torque;
      const double sign = mirror;
      m.add(AppliedTorque{
          .name = "motor", .body = crank, .torque = [=](double t) { return sign * given(t); }});
    }
    return m;
  }
};

/// The torque at which it breaks away, by the friction circles: the force S in the rod is tangent to
/// circles of radius mu r about both of its pins. way = +1: the crank turns forward.
double break_away(const SliderCrank& m, double mu, double way) {
  const double beta = m.rod_angle(), circles = mu * (m.r_crank + m.r_slider);
  const Vec2 A(m.R * std::cos(m.angle), m.R * std::sin(m.angle));
  const auto force_on_rod_at_B = [&](double y) { return Vec2(-m.press, y); };
  const auto moment = [&](double y) {
    const Vec2 F = force_on_rod_at_B(y);
    return cross(Vec2(m.l * std::cos(beta), m.l * std::sin(beta)), F) + way * circles * F.norm();
  };
  std::uintmax_t most = 200;
  const auto [low, high] = boost::math::tools::toms748_solve(
      moment, -20.0 * m.press, 20.0 * m.press, boost::math::tools::eps_tolerance<double>(52), most);
  const Vec2 F = force_on_rod_at_B(0.5 * (low + high));
  return -cross(A, F) + way * mu * (m.r_crank + m.r_ground) * F.norm();
}

TEST_CASE("joint friction: a slider-crank breaks away at the torque of the friction circles") {
  const double mu = 0.2;
  for (const double way : {1.0, -1.0}) {
    SliderCrank m{.press = 50.0, .guide = false};
    const double limit = break_away(m, mu, way), other = break_away(m, mu, -way);
    const double middle = 0.5 * (limit + other), ramp = (limit - middle) / 0.7;
    m.torque = [=](double t) { return middle + ramp * t; };
    for (const char* formulation : {"arkode-projection", "ida-ggl", "generalised-alpha"}) {
      INFO(std::string(formulation), way);
      const Result r = simulate(
          m.model(),
          {.until = 0.75, .relative_tolerance = 1e-7, .formulation = formulation, .samples = 16});
      REQUIRE(r.summary.ok());
      for (const char* pin : {"ground_pin.friction", "crank_pin.friction", "slider_pin.friction"}) {
        const std::vector<double> slips = times_of(r, "slip", pin);
        REQUIRE(slips.size() == 1);
        CHECK(slips[0] == Approx(0.7).epsilon(1e-8));
      }
      CHECK(std::abs(r["crank.angle_rad"][13] - m.angle) < 1e-14);
      CHECK(way * r.final.v[2] > 0.0);
    }
  }
}

// Where the crank is square to the guide the rod hardly turns, so the slider's pin hardly slides at first.
TEST_CASE("joint friction: a pin slides that hardly turns with the mechanism at first") {
  const double mu = 0.2;
  for (const double beside : {1e-3, -1e-3}) {
    SliderCrank m{.angle = 0.5 * pi + beside, .r_ground = 1e-6, .r_crank = 1e-6, .guide = false};
    m.torque = [](double) { return 5.0; };
    for (const char* formulation : {"arkode-projection", "ida-ggl"}) {
      INFO(std::string(formulation), beside);
      const Result r = simulate(m.model(), {.until = 0.1, .formulation = formulation});
      REQUIRE(r.summary.ok());
      const Eigen::VectorXd friction = r["slider_pin.friction.friction_force_N"].cwiseAbs();
      const Eigen::VectorXd load = r["slider_pin.friction.load_N"];
      CHECK(load.minCoeff() > 1.0);
      CHECK((friction - mu * load).cwiseAbs().maxCoeff() < 1e-12 * load.maxCoeff());
    }
  }
}

TEST_CASE(
    "joint friction: a slider-crank runs out alike in all formulations, turned and mirrored") {
  const SliderCrank start{.speed = 12.0, .preload = 10.0};
  const SimulationOptions options{.until = 3.0, .relative_tolerance = 1e-11, .samples = 31};
  const Result reference = simulate(start.model(), options);
  REQUIRE(reference.summary.ok());
  CHECK(reference.final.v.norm() < 1e-20);
  CHECK(reference.summary.energy_balance < 1e-9 * reference["kinetic_J"][0]);
  CHECK(reference["dissipated_J"].tail(1)[0] == Approx(reference["kinetic_J"][0]).epsilon(1e-9));
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    SimulationOptions o = options;
    o.relative_tolerance = tolerance_of(f, 1e-10);
    o.formulation = std::string(f.name);
    const Result r = simulate(start.model(), o);
    REQUIRE(r.summary.ok());
    CHECK(r.final.q[2] == Approx(reference.final.q[2]).epsilon(1e3 * o.relative_tolerance));
  }
  for (const double mirror : {1.0, -1.0}) {
    SliderCrank other = start;
    other.mirror = mirror;
    other.lean = 1.1;
    const Result r = simulate(other.model(), options);
    REQUIRE(r.summary.ok());
    const double turned = mirror * (r.final.q[2] - other.lean);
    CHECK(turned == Approx(reference.final.q[2]).epsilon(1e-8));
  }
}

// A carriage on its guide and a hinged arm, pinned together: nothing can move.
Model structure(double torque) {
  Model m;
  const BodyId carriage = m.add(Body{.name = "carriage",
                                     .mass = 0.05086011534540704,
                                     .inertia = 9.706272320052635e-06,
                                     .pose = {{0.014, -0.042}, 0.0}});
  const BodyId arm = m.add(Body{
      .name = "arm", .mass = 6.0, .inertia = 8.635531974927493e-4, .pose = {{-0.022, 0.03}, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = carriage, .along = {-0.86, 0.51}});
  m.add(Revolute{.name = "hinge", .a = ground, .b = arm, .at = {-0.0022, 0.0076}});
  m.add(Revolute{
      .name = "pin",
      .a = carriage,
      .b = arm,
      .at = {0.011, -0.033},
      .friction = PinFriction{.law = Coulomb{.mu = 0.24, .mu_static = 0.28}, .radius = 0.0018}});
  m.add(AppliedTorque{.name = "torque", .body = carriage, .torque = [=](double t) {
                        return torque * std::cos(2.3 * t + 2.8);
                      }});
  return m;
}

void check_that_it_rests(const Model& m, const State& start) {
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    const Result r = simulate(m, start,
                              {.until = 0.1,
                               .relative_tolerance = tolerance_of(f, 1e-9),
                               .formulation = std::string(f.name)});
    REQUIRE_MESSAGE(r.summary.ok(), r.summary.reason);
    CHECK((r.final.q - start.q).norm() < 1e-15);
    CHECK(times_of(r, "slip", "pin.friction").empty());
    CHECK(r["pin.friction.friction_force_N"].norm() == 0.0);
  }
}

TEST_CASE("joint friction: a pin of a loaded structure neither slides nor bears anything") {
  const Model m = structure(3.645377392373994e-05);
  check_that_it_rests(m, assemble(m));
}

TEST_CASE(
    "joint friction: a pin of a structure without load rests, whatever rounding its speed is") {
  const Model m = structure(0.0);
  for (const double speed : {1e-5, 1e-3, 1e-1}) {
    State start = assemble(m);
    for (Eigen::Index i = 0; i < start.v.size(); ++i) start.v[i] = speed * std::cos(double(i));
    check_that_it_rests(m, assemble(m, start, {}));
  }
}

// A mass of 510 t at the end of two links of some kg, which whirl at their dead centre with reactions of 1e9 N.
TEST_CASE("joint friction: generalised-alpha follows it through the dead centre of light links") {
  Model m;
  const BodyId first =
      m.add(Body{.name = "first", .mass = 8.0, .inertia = 0.29, .pose = {{-0.21, 0.39}, 0.0}});
  const BodyId second =
      m.add(Body{.name = "second", .mass = 9.9, .inertia = 0.26, .pose = {{-0.018, 0.55}, 0.0}});
  const BodyId heavy = m.add(Body{.name = "heavy",
                                  .mass = 5.1e5,
                                  .inertia = 9700.0,
                                  .pose = {{0.062, 0.83}, 0.0},
                                  .twist = {{0.0, 0.0}, -2.4}});
  m.add(Revolute{.name = "foot", .a = ground, .b = first, .at = {-0.096, 0.26}});
  m.add(Revolute{.name = "knee", .a = first, .b = second, .at = {-0.017, 0.42}});
  m.add(Revolute{
      .name = "pin",
      .a = second,
      .b = heavy,
      .at = {-0.083, 0.75},
      .friction = PinFriction{.law = Coulomb{.mu = 0.31, .mu_static = 0.37}, .radius = 0.02}});
  SimulationOptions options{.until = 0.08, .relative_tolerance = 1e-10, .samples = 2};
  const Result good = simulate(m, options);
  options.formulation = "generalised-alpha";
  for (const double tolerance : {1e-6, 1e-7}) {
    options.relative_tolerance = tolerance;
    const Result r = simulate(m, options);
    REQUIRE_MESSAGE(r.summary.ok(), r.summary.reason);
    for (const char* kind : {"stick", "slip"}) {
      const std::vector<double> times = times_of(r, kind, "pin.friction");
      REQUIRE(times.size() == 1);
      CHECK(std::abs(times[0] - times_of(good, kind, "pin.friction").at(0)) < 0.02 * tolerance);
    }
  }
}

TEST_CASE("joint friction: every law runs, dissipates and keeps its ledger in every formulation") {
  for (const FrictionNote& info : friction_catalog()) {
    INFO(info.name);
    SliderCrank m{.speed = 6.0};
    std::vector<std::pair<std::string, double>> given;
    for (const FrictionParameter& parameter : info.parameters)
      if (parameter.default_text.empty()) given.emplace_back(parameter.name, 0.2);
    m.law = make_friction(info.name, given);
    const SimulationOptions options{.until = 0.05, .relative_tolerance = 1e-9, .samples = 11};
    const Result reference = simulate(m.model(), options);
    REQUIRE(reference.summary.ok());
    for (const FormulationNote& f : formulations()) {
      INFO(f.name);
      SimulationOptions o = options;
      o.relative_tolerance = tolerance_of(f, 1e-9);
      // Order 2 takes many steps where bristles are as fast as here.
      if (f.name == "generalised-alpha" && m.law.has_state()) o.relative_tolerance = 1e-5;
      o.formulation = std::string(f.name);
      const Result r = simulate(m.model(), o);
      REQUIRE(r.summary.ok());
      CHECK(r.final.q[2] == Approx(reference.final.q[2]).epsilon(1e2 * o.relative_tolerance));
      CHECK(r.summary.energy_balance < 1e3 * o.relative_tolerance * r["kinetic_J"][0]);
      CHECK(r["dissipated_J"].tail(1)[0] > 0.0);
    }
  }
}

TEST_CASE(
    "joint friction: a block whose friction tips it onto its guide wedges, and the run says so") {
  // Friction along the guide, h below the centre of mass, has the moment T h about the block's middle,
  // whose ends then press with 2 T h/L: more than T/mu where 2 mu h > L.
  const auto run = [](double h) {
    Model model;
    const BodyId block = model.add(Body{.name = "block",
                                        .mass = 2.0,
                                        .inertia = 0.01,
                                        .pose = {{0.0, h}, 0.0},
                                        .twist = {{1.0, 0.0}, 0.0}});
    model.add(Gravity{});
    model.add(Prismatic{.name = "guide",
                        .a = ground,
                        .b = block,
                        .at = Vec2(0.0, 0.0),
                        .friction = GuideFriction{.law = Coulomb{0.5, 0.5}, .length = 0.1}});
    return simulate(model, {.until = 0.05, .samples = 3});
  };
  const Result slides = run(0.09);  // 2 mu h/L = 0.9
  REQUIRE(slides.summary.ok());
  CHECK(slides.final.v[0] == Approx(1.0 - 0.5 * g * 0.05).epsilon(1e-6));
  const Result wedges = run(0.11);
  CHECK(!wedges.summary.ok());
  CHECK_MESSAGE(contains(wedges.summary.reason, "'guide.friction' wedges"), wedges.summary.reason);
}

TEST_CASE(
    "joint friction that wedges a moment after the last good state is to blame for the stop") {
  // As above, but a torque holds the block back from tipping, until it falls below
  // m g (mu h - L/2): two reactions that satisfy the friction become one there, and then none.
  for (const char* formulation : {"arkode-projection", "ida-ggl", "generalised-alpha"}) {
    CAPTURE(formulation);
    Model model;
    const BodyId block = model.add(Body{.name = "block",
                                        .mass = 2.0,
                                        .inertia = 0.01,
                                        .pose = {{0.0, 0.11}, 0.0},
                                        .twist = {{1.0, 0.0}, 0.0}});
    model.add(Gravity{});
    model.add(AppliedTorque{
        .name = "hand", .body = block, .torque = [](double t) { return 0.2 - 5.0 * t; }});
    model.add(Prismatic{.name = "guide",
                        .a = ground,
                        .b = block,
                        .at = Vec2(0.0, 0.0),
                        .friction = GuideFriction{.law = Coulomb{0.5, 0.5}, .length = 0.1}});
    const Result r = simulate(model, {.until = 0.05, .formulation = formulation, .samples = 3});
    CHECK(!r.summary.ok());
    CHECK(r.summary.t_end < (0.2 - 2.0 * g * (0.5 * 0.11 - 0.05)) / 5.0 + 1e-6);
    CHECK_MESSAGE(contains(r.summary.reason, "'guide.friction' wedges"), r.summary.reason);
  }
}

TEST_CASE("joint friction: mechanics solve for it at forces given") {
  const SliderCrank m{.speed = 6.0, .law = Coulomb{0.2, 0.2}};
  const Model model = m.model();
  const Result r = simulate(model, {.until = 0.01, .relative_tolerance = 1e-10, .samples = 2});
  Mechanics mechanics(model);
  mechanics.at(r.final);
  Eigen::VectorXd a(9), lambda(mechanics.equations());
  mechanics.accelerations(Eigen::VectorXd::Zero(9), a, lambda);
  CHECK((a - r.final.a).norm() < 1e-10 * r.final.a.norm());
  // As much inertia force as the accelerations: what balances the friction.
  CHECK((mechanics.mass_matrix().cwiseProduct(a) - mechanics.forces() +
         mechanics.constraint_jacobian().transpose() * lambda)
            .norm() < 1e-9 * lambda.norm());
}

TEST_CASE("joint friction: a run taken up while joints stick gives the same bits") {
  SliderCrank m{.speed = 4.0, .press = 20.0};
  m.torque = [](double t) { return 3.0 * std::sin(20.0 * t); };
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    TemporaryFolder whole, cut_short;
    SimulationOptions o{.until = 0.6,
                        .relative_tolerance = tolerance_of(f, 1e-7),
                        .formulation = std::string(f.name),
                        .samples = 61,
                        .checkpoints = {.folder = whole.path(), .every = 0.05}};
    const Result all = simulate(m.model(), o);
    REQUIRE(all.summary.ok());
    CHECK(!times_of(all, "stick", "guide.friction").empty());
    CHECK(!times_of(all, "slip", "guide.friction").empty());
    o.checkpoints.folder = cut_short.path();
    SimulationOptions stopped = o;
    stopped.observer = [](const Progress& p) { return p.t < 0.32; };
    CHECK(!simulate(m.model(), stopped).summary.ok());
    o.checkpoints.resume = true;
    const Result resumed = simulate(m.model(), o);
    const std::vector<double>&a = resumed.samples.data(), &b = all.samples.data();
    REQUIRE(a.size() == b.size());
    CHECK(std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0);
  }
}

TEST_CASE("joint friction: the drive of a given motion bears it") {
  // A crank driven at constant speed in its bearing: the torque is mu r N against the motion.
  const double m = 2.0, l = 0.1, r = 0.02, mu = 0.25, w = 5.0;
  Model model;
  const BodyId crank = model.add(Body{.name = "crank",
                                      .mass = m,
                                      .inertia = 0.01,
                                      .pose = {{l, 0.0}, 0.0},
                                      .twist = {{0.0, l * w}, w}});
  model.add(Gravity{});
  model.add(Revolute{.name = "bearing",
                     .a = ground,
                     .b = crank,
                     .friction = PinFriction{.law = RegularisedCoulomb{.mu = mu, .threshold = 1e-6},
                                             .radius = r}});
  const auto torque = [&](double angle) {
    const Vec2 reaction = m * (Vec2(0.0, g) - w * w * l * Vec2(std::cos(angle), std::sin(angle)));
    return m * g * l * std::cos(angle) + mu * r * reaction.norm();
  };
  const auto motion = [&](double t) {
    State s;
    const double c = std::cos(w * t), n = std::sin(w * t);
    s.q = Eigen::Vector3d(l * c, l * n, w * t);
    s.v = Eigen::Vector3d(-l * w * n, l * w * c, w);
    s.a = Eigen::Vector3d(-l * w * w * c, -l * w * w * n, 0.0);
    return s;
  };
  const Result given = inverse_dynamics(model,
                                        [&](double t) {
                                          State s = model.start_state();
                                          const State at = motion(t);
                                          s.q = at.q;
                                          s.v = at.v;
                                          s.a = at.a;
                                          return s;
                                        },
                                        {{.body = "crank", .coordinate = Coordinate::angle}},
                                        {.until = 1.0, .samples = 21});
  for (int i = 0; i < 21; ++i)
    CHECK(given["crank.angle.drive_N_m"][i] == Approx(torque(w * 0.05 * i)).epsilon(1e-9));
}

/// All blocks of a friction element at a state, for multipliers and bristles given.
struct FrictionBlocks {
  std::vector<double> Q, q, v, z, lambda, rate, rate_q, rate_v, rate_z, rate_lambda;
};

TEST_CASE("joint friction: the blocks are the derivatives") {
  const LuGre lugre{.mu = 0.2, .mu_static = 0.3};
  for (const FrictionLaw& law :
       {FrictionLaw(RegularisedCoulomb{.mu = 0.3, .threshold = 0.2}), FrictionLaw(lugre)}) {
    for (const bool prismatic : {false, true}) {
      INFO(law.name(), prismatic);
      Model model;
      const BodyId a =
          model.add(Body{.name = "a", .mass = 1.0, .inertia = 1.0, .pose = {{0.2, -0.1}, 0.4}});
      const BodyId b =
          model.add(Body{.name = "b", .mass = 1.0, .inertia = 1.0, .pose = {{0.7, 0.3}, -0.9}});
      if (prismatic)
        model.add(Prismatic{.name = "joint",
                            .a = a,
                            .b = b,
                            .along = {0.8, 0.5},
                            .at = Vec2(0.6, 0.1),
                            .friction = GuideFriction{.law = law, .length = 0.3, .preload = 2.0}});
      else
        model.add(Revolute{.name = "joint",
                           .a = a,
                           .b = b,
                           .at = {0.5, 0.2},
                           .friction = PinFriction{.law = law, .radius = 0.05}});
      const ForceElement& element = *model.forces()[0];
      const std::size_t nz = element.states().size();
      // q, v, z, lambda in one row
      std::vector<double> x{0.2, -0.1, 0.4, 0.7,  0.3,  -0.9, 0.3, 0.1,
                            2.0, -0.4, 0.2, -1.5, 1e-6, 5.0,  -7.0};
      const auto blocks_at = [&](const std::vector<double>& at) {
        std::vector<BodyMotion> bodies(3);
        for (std::size_t i = 0; i < 2; ++i)
          bodies[i + 1] = {at[3 * i],
                           at[3 * i + 1],
                           at[3 * i + 2],
                           std::cos(at[3 * i + 2]),
                           std::sin(at[3 * i + 2]),
                           at[6 + 3 * i],
                           at[7 + 3 * i],
                           at[8 + 3 * i]};
        const Motion motion{.t = 0.0, .bodies = bodies, .inertia = model.bodies()};
        FrictionBlocks f;
        f.Q.resize(6), f.q.resize(36), f.v.resize(36), f.z.resize(6), f.lambda.resize(12),
            f.rate.resize(1);
        f.rate_q.resize(6), f.rate_v.resize(6), f.rate_z.resize(1), f.rate_lambda.resize(2);
        ForceRequest out{.Q = f.Q.data(),
                         .dQ_dq = f.q.data(),
                         .dQ_dv = f.v.data(),
                         .dQ_dlambda = f.lambda.data()};
        if (nz > 0) {
          out.dQ_dz = f.z.data(), out.z_dot = f.rate.data(), out.dz_dq = f.rate_q.data();
          out.dz_dv = f.rate_v.data(), out.dz_dz = f.rate_z.data(),
          out.dz_dlambda = f.rate_lambda.data();
        }
        element.evaluate({.motion = motion, .z = &at[12], .multipliers = &at[13]}, out);
        return f;
      };
      const FrictionBlocks here = blocks_at(x);
      REQUIRE(std::abs(here.Q[5]) + std::abs(here.Q[3]) > 0.0);
      for (std::size_t j = 0; j < x.size(); ++j) {
        if (j == 12 && nz == 0) continue;
        const double h = j == 12 ? 1e-9 : 1e-6;
        std::vector<double> more = x, less = x;
        more[j] += h, less[j] -= h;
        const FrictionBlocks up = blocks_at(more), down = blocks_at(less);
        const auto exact = [&](std::size_t i) {
          return j < 6     ? here.q[6 * i + j]
                 : j < 12  ? here.v[6 * i + j - 6]
                 : j == 12 ? here.z[i]
                           : here.lambda[2 * i + j - 13];
        };
        double size = 1.0;
        for (std::size_t i = 0; i < 6; ++i) size = std::max(size, std::abs(exact(i)));
        for (std::size_t i = 0; i < 6; ++i)
          CHECK(std::abs((up.Q[i] - down.Q[i]) / (2.0 * h) - exact(i)) < 1e-6 * size);
        if (nz == 0) continue;
        const double rate = j < 6     ? here.rate_q[j]
                            : j < 12  ? here.rate_v[j - 6]
                            : j == 12 ? here.rate_z[0]
                                      : here.rate_lambda[j - 13];
        CHECK((up.rate[0] - down.rate[0]) / (2.0 * h) == Approx(rate).epsilon(1e-5).scale(1e-3));
      }
    }
  }
}

TEST_CASE("joint friction: what is wrong is named") {
  const auto of_pin = [](const PinFriction& friction, bool clearance = false) {
    return message_of([&] {
      Model model;
      const BodyId body = model.add(Body{.name = "body", .mass = 1.0, .inertia = 1.0});
      Revolute pin{.name = "pin", .a = ground, .b = body, .friction = friction};
      if (clearance)
        pin.clearance = BearingClearance{.journal_radius = 0.01,
                                         .radial = 1e-4,
                                         .law = ContactLaw(PowerLaw{1e8, 1.5}, HuntCrossley{10.0})};
      model.add(pin);
    });
  };
  CHECK(of_pin({.law = Coulomb{0.1, 0.1}}) ==
        "friction of 'pin': radius = 0 m must be finite and greater than 0 m");
  CHECK(of_pin({.law = FrictionLaw(), .radius = 0.01}) == "friction of 'pin': law is missing");
  CHECK(of_pin({.law = Coulomb{0.1, 0.1}, .radius = 0.01, .preload = -1.0}) ==
        "friction of 'pin': preload = -1 N must be finite and at least 0 N");
  CHECK(contains(of_pin({.law = Coulomb{0.1, 0.1}, .radius = 0.01}, true), "without clearance"));
  CHECK(contains(message_of([] {
                   Model model;
                   const BodyId body = model.add(Body{.name = "body", .mass = 1.0, .inertia = 1.0});
                   model.add(Prismatic{.name = "guide",
                                       .a = ground,
                                       .b = body,
                                       .friction = GuideFriction{.law = Coulomb{0.1, 0.1}}});
                 }),
                 "friction of 'guide': length = 0 m"));
}

}  // namespace
