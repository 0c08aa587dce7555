// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Over-closed mechanisms of every size, speed, place and mass, drawn at random: those whose equations
// agree start, those that contradict themselves are refused by name.
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/joints/weld.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// Uniform numbers, the same on every platform.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double decades(double low, double high) { return std::pow(10.0, (*this)(low, high)); }
  int below(int n) { return static_cast<int>((*this)(0.0, n)); }

 private:
  std::mt19937_64 engine_;
};

/// Where a mechanism is, how large it is and how fast: the answer must not depend on it.
struct Frame {
  explicit Frame(Random& random)
      : turn(random(-3.0, 3.0)),
        size(random.decades(-4.0, 3.0)),
        speed(random.below(3) == 0 ? 0.0 : random.decades(-6.0, 3.0)),
        origin(size * Vec2(random(-30.0, 30.0), random(-30.0, 30.0))),
        density(random.decades(-2.0, 3.0)) {}
  Vec2 point(const Vec2& p) const { return origin + size * rotate(turn, p); }
  double turn, size, speed;
  Vec2 origin;
  double density;
};

BodyId add_body(Model& m, Random& random, const Frame& f, const std::string& name,
                const Vec2& centre, double angle, const Twist& twist = {}) {
  const double mass = f.density * random.decades(-1.5, 1.5);
  return m.add(
      {.name = name,
       .mass = mass,
       .inertia = mass * std::pow(f.size * random(0.1, 0.6), 2),
       .pose = {f.point(centre), f.turn + angle},
       .twist = {f.size * f.speed * rotate(f.turn, twist.velocity), f.speed * twist.omega}});
}

/// Parallel cranks carry a coupler, some by rods; the last is `stretch` times as long as the others.
Model cranks(Random& random, double stretch = 1.0) {
  const Frame f(random);
  Model m;
  const double phi = random(0.3, 2.8), omega = random(-1.0, 1.0);
  const Vec2 arm = rotate(phi, {random(0.2, 1.5), 0.0});
  const BodyId coupler = add_body(m, random, f, "coupler", {random(-1.0, 1.0), random(-1.0, 1.0)},
                                  random(-3.0, 3.0), {omega * perp(arm), 0.0});
  const int count = 3 + random.below(4);
  for (int i = 0; i < count; ++i) {
    const Vec2 tip(i + random(0.0, 0.5), random(-0.4, 0.4));
    const Vec2 foot = tip - (i == count - 1 ? stretch : 1.0) * arm;
    const std::string name = "crank " + std::to_string(i);
    if (i >= 2 && random.below(2) == 0) {
      m.add(Distance{name, ground, coupler, f.point(foot), f.point(tip)});
      continue;
    }
    const BodyId crank = add_body(m, random, f, name, 0.5 * (foot + tip), random(-3.0, 3.0),
                                  {0.5 * omega * perp(arm), omega});
    m.add(Revolute{name + " foot", ground, crank, f.point(foot)});
    m.add(Revolute{name + " tip", coupler, crank, f.point(tip)});
  }
  if (random.below(2) == 0) m.add(Gravity{});
  return m;
}

/// A tree of bodies in which joints come twice, and rods whose ends are fixed to one body and its
/// twin: redundant wherever the mechanism goes.
Model twins(Random& random) {
  const Frame f(random);
  Model m;
  std::vector<BodyId> bodies{ground};
  std::vector<Vec2> centres{Vec2(0.0, 0.0)};
  const int count = 1 + random.below(5);
  for (int i = 0; i < count; ++i) {
    const auto to = static_cast<std::size_t>(random.below(static_cast<int>(bodies.size())));
    const Vec2 centre = centres[to] + Vec2(random(-1.0, 1.0), random(-1.0, 1.0));
    const std::string name = "body " + std::to_string(i);
    const BodyId body = add_body(m, random, f, name, centre, random(-3.0, 3.0),
                                 {{random(-1.0, 1.0), random(-1.0, 1.0)}, random(-1.0, 1.0)});
    const Vec2 at = 0.5 * (centre + centres[to]) + Vec2(random(-0.3, 0.3), random(-0.3, 0.3));
    const Vec2 along = rotate(random(-3.0, 3.0), {1.0, 0.0});
    const int kind = random.below(4), times = 1 + random.below(3);
    for (int k = 0; k < times; ++k) {
      const std::string joint = name + " joint " + std::to_string(k);
      if (kind == 0) m.add(Revolute{joint, bodies[to], body, f.point(at)});
      if (kind == 1)
        m.add(Prismatic{joint, bodies[to], body, rotate(f.turn, along),
                        f.point(at + random(-1.0, 1.0) * along)});
      if (kind == 2) m.add(Distance{joint, bodies[to], body, f.point(at), f.point(at + along)});
      if (kind == 3) m.add(Weld{joint, bodies[to], body, f.point(at + k * along)});
    }
    bodies.push_back(body);
    centres.push_back(centre);
  }
  if (random.below(2) == 0) m.add(Gravity{});
  return m;
}

/// Bodies on revolute and prismatic joints, with more rods between them than they have freedom: a
/// frame that cannot move, whatever velocity it is given. The last rod is `stretch` times too long.
Model frame(Random& random, double stretch = 1.0) {
  const Frame f(random);
  Model m;
  std::vector<BodyId> bodies{ground};
  std::vector<Vec2> centres{Vec2(0.0, 0.0)};
  const int count = 1 + random.below(4);
  for (int i = 0; i < count; ++i) {
    const auto to = static_cast<std::size_t>(random.below(static_cast<int>(bodies.size())));
    const Vec2 centre = centres[to] + Vec2(random(-1.0, 1.0), random(-1.0, 1.0));
    const std::string name = "body " + std::to_string(i);
    const BodyId body = add_body(m, random, f, name, centre, random(-3.0, 3.0),
                                 {{random(-1.0, 1.0), random(-1.0, 1.0)}, random(-1.0, 1.0)});
    const Vec2 at = 0.5 * (centre + centres[to]) + Vec2(random(-0.3, 0.3), random(-0.3, 0.3));
    if (random.below(2) == 0)
      m.add(Revolute{name + " pin", bodies[to], body, f.point(at)});
    else
      m.add(Prismatic{name + " guide", bodies[to], body, rotate(random(-3.0, 3.0), {1.0, 0.0})});
    bodies.push_back(body);
    centres.push_back(centre);
  }
  const int rods = count + 1 + random.below(3);
  for (int i = 0; i < rods; ++i) {
    // Every body is tied to the ground, then whatever comes.
    const auto b = static_cast<std::size_t>(i < count ? i + 1 : 1 + random.below(count));
    const auto a = static_cast<std::size_t>(i < count ? 0 : random.below(static_cast<int>(b)));
    const Vec2 from = f.point(centres[a] + Vec2(random(-1.0, 1.0), random(-1.0, 1.0)));
    const Vec2 to = f.point(centres[b] + Vec2(random(-1.0, 1.0), random(-1.0, 1.0)));
    m.add(Distance{.name = "rod " + std::to_string(i),
                   .a = bodies[a],
                   .b = bodies[b],
                   .at_a = from,
                   .at_b = to,
                   .length = (i == rods - 1 ? stretch : 1.0) * (to - from).norm()});
  }
  if (random.below(2) == 0) m.add(Gravity{});
  return m;
}

/// Two motors on one crank, the second faster, or accelerated more, by a share `off`.
Model motors(Random& random, double faster, double accelerated) {
  const Frame f(random);
  Model m;
  const double omega = random.decades(-5.0, 4.0);
  const BodyId crank = add_body(m, random, f, "crank", {0.5, 0.0}, 0.0);
  m.add(Revolute{"pivot", ground, crank, f.point({0.0, 0.0})});
  const double start = f.turn;
  const auto motor = [&](double speed_up, double force_up) {
    return [=](double t) {
      const double a = omega * omega * (1.0 + force_up), s = omega * (1.0 + speed_up);
      return TimeValue{start + s * t + 0.5 * a * t * t, s + a * t, a};
    };
  };
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = motor(0.0, 0.0)});
  m.add(AngleDriver{.name = "second", .body = crank, .angle = motor(faster, accelerated)});
  return m;
}

std::string refusal(const Model& m) {
  Dynamics dynamics(m);
  State state = m.start_state();
  const Outcome outcome = dynamics.assemble(state);
  return outcome ? "" : outcome.why;
}

constexpr unsigned models = 300;  // of each kind

}  // namespace

TEST_CASE("of over-closed mechanisms whose equations agree none is refused") {
  for (unsigned seed = 1; seed <= models; ++seed) {
    INFO("seed " << seed);
    Random a(seed), b(seed), c(seed), d(seed);
    CHECK(refusal(cranks(a)) == "");
    CHECK(refusal(twins(b)) == "");
    CHECK(refusal(frame(c)) == "");
    CHECK(refusal(motors(d, 0.0, 0.0)) == "");
  }
}

TEST_CASE("one length that does not fit is refused, whatever the size, and the rods are named") {
  for (unsigned seed = 1; seed <= models; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const double off = random.decades(-5.0, -2.0);
    Random a(seed), b(seed);
    const std::string bar = refusal(frame(a, 1.0 + off));
    CHECK_MESSAGE(contains(bar, "stays violated by"), bar);
    CHECK_MESSAGE(contains(bar, "in conflict with"), bar);
    const std::string link = refusal(cranks(b, 1.0 + off));
    INFO("a crank longer by " << off);
    CHECK_MESSAGE(contains(link, "in conflict with"), link);
    CHECK_MESSAGE(contains(link, "'crank "), link);
  }
}

TEST_CASE("motors that differ in rate or acceleration by a millionth are refused at every speed") {
  for (unsigned seed = 1; seed <= models; ++seed) {
    INFO("seed " << seed);
    Random a(seed), b(seed);
    const std::string rate = refusal(motors(a, 1e-6, 0.0));
    CHECK_MESSAGE(contains(rate, "in conflict with"), rate);
    CHECK_MESSAGE(contains(rate, "rad/s"), rate);
    CHECK_MESSAGE(contains(rate, "its rate stays violated"), rate);
    const std::string acceleration = refusal(motors(b, 0.0, 1e-6));
    CHECK_MESSAGE(contains(acceleration, "in conflict with"), acceleration);
    CHECK_MESSAGE(contains(acceleration, "its acceleration stays violated"), acceleration);
  }
}
