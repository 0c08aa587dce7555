// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Coulomb's law itself: what sticks does not creep, transitions happen where closed forms say.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/friction/coulomb.hpp>
#include <yoke/contact/laws/friction/regularised_coulomb.hpp>
#include <yoke/core/control/event_function.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/integrators/simulation.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

namespace {

constexpr double g = 9.81, K = 1e8;

ContactLaw dry(double mu, double mu_static) {
  return {PowerLaw{K, 1.5}, HuntCrossley{10.0}, Coulomb{mu, mu_static}};
}
double depth_under(double force) { return std::pow(force / K, 2.0 / 3.0); }

struct Floor {
  std::string name = "floor";
  BodyId body = ground;
  Vec2 at{0.0, 0.0};
  double belt = 0.0, reference = 10.0;
};

/// A point of a body on a horizontal line.
void stand(Model& m, BodyId body, const Vec2& point, const ContactLaw& law, const Floor& f = {}) {
  m.add(DiscOnCurve{.name = f.name,
                    .disc = {body, point, 0.0},
                    .body = f.body,
                    .curve = straight_line(f.at, {1.0, 0.0}),
                    .law = law,
                    .surface_speed = f.belt,
                    .reference_force = f.reference});
}

/// A block that does not tip, on a floor; gravity leans by the angle.
Model block(const ContactLaw& law, double angle, double speed = 0.0, double mass = 2.0,
            double belt = 0.0) {
  Model m;
  const double N = mass * g * std::cos(angle), d = depth_under(N);
  const BodyId body = m.add(Body{.name = "block",
                                 .mass = mass,
                                 .inertia = 0.01,
                                 .pose = {{0.0, 0.06 - d}, 0.0},
                                 .twist = {{speed, 0.0}, 0.0}});
  m.add(AngleDriver{.name = "upright", .body = body, .angle = constant(0.0)});
  m.add(Gravity{.acceleration = {g * std::sin(angle), -g * std::cos(angle)}});
  stand(m, body, {0.0, -d}, law, {.belt = belt, .reference = N});
  return m;
}

std::vector<double> times_of(const Result& r, const std::string& kind,
                             const std::string& element = "floor") {
  std::vector<double> times;
  for (const EventRecord& e : r.events)
    if (e.kind == kind && e.element == element) times.push_back(e.t);
  return times;
}

/// What generalised-alpha, of order 2, reaches with reasonable effort.
double tolerance_of(const FormulationNote& f, double rtol) {
  return f.name == "generalised-alpha" ? std::max(rtol, 1e-7) : rtol;
}

TEST_CASE("coulomb: a block below the friction angle stays where it is, above it slides") {
  const double mu = 0.3;
  const double below = std::atan(0.99 * mu), above = std::atan(1.01 * mu);
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    SimulationOptions o{.until = 5.0,
                        .relative_tolerance = tolerance_of(f, 1e-9),
                        .formulation = std::string(f.name),
                        .samples = 21};
    const Result held = simulate(block(dry(mu, mu), below), o);
    REQUIRE(held.summary.ok());
    CHECK(held.final.q[0] == 0.0);
    CHECK(held.final.v[0] == 0.0);
    CHECK(held["floor.friction_force_N"][20] == Approx(2.0 * g * std::sin(below)).epsilon(1e-9));
    o.until = 1.0;
    const Result slides = simulate(block(dry(mu, mu), above), o);
    REQUIRE(slides.summary.ok());
    const double a = g * (std::sin(above) - mu * std::cos(above));
    CHECK(slides.final.q[0] == Approx(0.5 * a).epsilon(100.0 * o.relative_tolerance));
    CHECK(slides["dissipated_J"].tail(1)[0] ==
          Approx(mu * 2.0 * g * std::cos(above) * 0.5 * a).epsilon(1e-6));
    // Static friction alone keeps it.
    const Result kept = simulate(block(dry(0.2, mu), below), o);
    CHECK(kept.final.q[0] == 0.0);
  }
}

TEST_CASE("coulomb: a block stays where it is for 1000 s") {
  for (const char* formulation : {"ida-ggl", "cvode-projection"}) {
    const Result r = simulate(
        block(dry(0.3, 0.3), std::atan(0.297)),
        {.until = 1000.0, .relative_tolerance = 1e-9, .formulation = formulation, .samples = 11});
    REQUIRE(r.summary.ok());
    CHECK(r.final.q[0] == 0.0);
  }
}

TEST_CASE("coulomb: a block thrown up an incline stops and holds, or slides back") {
  const double mu = 0.3, v0 = -1.5;
  for (const double angle : {std::atan(0.2), std::atan(0.5)}) {
    const double up = g * (std::sin(angle) + mu * std::cos(angle));
    const Result r = simulate(block(dry(mu, mu), angle, v0),
                              {.until = 1.0, .relative_tolerance = 1e-10, .samples = 11});
    REQUIRE(r.summary.ok());
    const double stop = -v0 / up, rest = 1.0 - stop;
    const double down = std::max(0.0, g * (std::sin(angle) - mu * std::cos(angle)));
    CHECK(r.final.q[0] == Approx(-0.5 * v0 * v0 / up + 0.5 * down * rest * rest).epsilon(1e-9));
    CHECK(r.final.v[0] == Approx(down * rest).epsilon(1e-9));
    CHECK(times_of(r, "stick").size() == (down > 0.0 ? 0 : 1));
    if (down == 0.0) CHECK(times_of(r, "stick")[0] == Approx(stop).epsilon(1e-9));
    CHECK(r.events.size() <= 3);  // no chatter
  }
}

TEST_CASE("coulomb: stick-slip on a belt has the period and the amplitude of the closed form") {
  const double mu = 0.25, mu_s = 0.4, V = 0.1, k = 100.0, w = 10.0;
  Model m = block(dry(mu, mu_s), 0.0, 0.0, 1.0, V);
  const double height = 0.06 - depth_under(g);
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = m.find_body("block"),
                            .at_a = {-0.5, height},
                            .at_b = {0.0, height},
                            .stiffness = k,
                            .free_length = 0.5});
  const double D = (mu_s - mu) * g / k, amplitude = std::hypot(D, V / w);
  const double period = 2.0 * D / V + 2.0 / w * (pi - std::atan(D * w / V));
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    const bool rough = f.name == "generalised-alpha";
    const Result r = simulate(m, {.until = 3.0,
                                  .relative_tolerance = rough ? 1e-8 : 1e-11,
                                  .formulation = std::string(f.name),
                                  .samples = rough ? 31 : 3001});
    REQUIRE(r.summary.ok());
    const std::vector<double> stick = times_of(r, "stick");
    REQUIRE(stick.size() == 4);
    const double bar = rough ? 1e-7 : 1e-8;
    CHECK(std::abs(stick[3] - stick[1] - 2.0 * period) < bar * period);
    // While it slips it is a free oscillator, from which the amplitude follows.
    double worst = 0.0;
    const Eigen::VectorXd x = r["block.x_m"], v = r["block.vx_m_per_s"], t = r["t_s"];
    for (Eigen::Index i = 0; i < x.size(); ++i)
      if (t[i] > stick[0] && std::abs(v[i] - V) > 1e-6)
        worst = std::max(worst, std::abs(std::hypot(x[i] - mu * g / k, v[i] / w) - amplitude));
    CHECK(worst < bar * amplitude);
    CHECK(r.summary.energy_balance < (rough ? 1e-6 : 1e-9) * r.summary.energy_exchanged);
    if (f.name == "arkode-projection")
      CHECK(std::abs(x.tail(2000).maxCoeff() - mu * g / k - amplitude) < 1e-5 * amplitude);
  }
}

/// A disc pressed by its weight, thrown without spin.
Model thrown_disc(double turn = 0.0, double side = 1.0) {
  Model m;
  const double r = 0.05, d = depth_under(g);
  const Vec2 start = rotate(turn, Vec2(0.0, r - d));
  const BodyId disc = m.add(Body{.name = "disc",
                                 .mass = 1.0,
                                 .inertia = 0.5 * r * r,
                                 .pose = {start, 0.0},
                                 .twist = {rotate(turn, Vec2(side, 0.0)), 0.0}});
  m.add(Gravity{.acceleration = rotate(turn, Vec2(0.0, -g))});
  m.add(DiscOnCurve{.name = "floor",
                    .disc = {disc, start, r},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, rotate(turn, Vec2(1.0, 0.0))),
                    .law = dry(0.2, 0.2),
                    .reference_force = g});
  return m;
}

TEST_CASE("coulomb: a thrown disc begins to roll at the right time and rolls without slip") {
  const double mu = 0.2, arm = 0.05 - depth_under(g), M = 1.0 / (1.0 + arm * arm / 0.00125);
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    const Result r = simulate(thrown_disc(), {.until = 1.0,
                                              .relative_tolerance = tolerance_of(f, 1e-10),
                                              .formulation = std::string(f.name),
                                              .samples = 101});
    REQUIRE(r.summary.ok());
    const std::vector<double> stick = times_of(r, "stick");
    REQUIRE(stick.size() == 1);
    const double bar = 1e3 * tolerance_of(f, 1e-10);
    CHECK(stick[0] == Approx(M / (mu * g)).epsilon(bar));  // v0/(3 mu g) but for the depth
    CHECK(r.final.v[0] == Approx(1.0 - M).epsilon(bar));
    const Eigen::VectorXd slip = r["floor.tangential_velocity_m_per_s"], t = r["t_s"];
    for (Eigen::Index i = 0; i < t.size(); ++i)
      if (t[i] > stick[0]) CHECK(std::abs(slip[i]) < 1e-15);
    CHECK(r["dissipated_J"].tail(1)[0] == Approx(0.5 * M).epsilon(1e-3 + bar));
  }
}

TEST_CASE("coulomb: turned, the same motion; mirrored, the mirrored one") {
  const SimulationOptions o{.until = 0.6, .relative_tolerance = 1e-10};
  const Result here = simulate(thrown_disc(), o);
  const Result there = simulate(thrown_disc(2.1), o), other = simulate(thrown_disc(0.0, -1.0), o);
  const Vec2 moved = rotate(2.1, Vec2(here.final.q[0], 0.0));
  CHECK((Vec2(there.final.q[0], there.final.q[1]) -
         rotate(2.1, Vec2(here.final.q[0], here.final.q[1])))
            .norm() < 1e-9);
  CHECK(moved.norm() > 0.3);
  CHECK(there.final.v[2] == Approx(here.final.v[2]).epsilon(1e-9));
  CHECK(other.final.q[0] == Approx(-here.final.q[0]).epsilon(1e-12));
  CHECK(other.final.v[2] == Approx(-here.final.v[2]).epsilon(1e-12));
}

/// A rigid block on two feet, in equilibrium on an incline of tan(a) = slope, if friction holds it.
Model on_two_feet(const ContactLaw& law, double slope) {
  const double a = std::atan(slope), mass = 2.0, h = 0.02, x1 = -0.1, x2 = 0.06;
  const double N = mass * g * std::cos(a), T = mass * g * std::sin(a);
  const double N2 = (h * T - x1 * N) / (x2 - x1), N1 = N - N2;
  const double d1 = depth_under(N1), d2 = depth_under(N2), lean = std::atan2(d1 - d2, x2 - x1);
  Model m;
  const double y = -d1 - (rotate(lean, Vec2(x1, -h)).y());
  const BodyId body =
      m.add(Body{.name = "block", .mass = mass, .inertia = 0.01, .pose = {{0.0, y}, lean}});
  m.add(Gravity{.acceleration = {g * std::sin(a), -g * std::cos(a)}});
  stand(m, body, Vec2(0.0, y) + rotate(lean, Vec2(x1, -h)), law, {.name = "left"});
  stand(m, body, Vec2(0.0, y) + rotate(lean, Vec2(x2, -h)), law, {.name = "right"});
  return m;
}

TEST_CASE("coulomb: two feet of a block share what one row holds, and break together") {
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    SimulationOptions o{.until = 1.0,
                        .relative_tolerance = tolerance_of(f, 1e-9),
                        .formulation = std::string(f.name),
                        .samples = 11};
    const Result held = simulate(on_two_feet(dry(0.3, 0.3), 0.99 * 0.3), o);
    REQUIRE(held.summary.ok());
    CHECK(std::abs(held.final.q[0]) < 1e-9);  // it leans a little, and no more
    CHECK(times_of(held, "slip", "left").empty());
    CHECK(times_of(held, "slip", "right").empty());
    for (const char* foot : {"left", "right"}) {
      const std::string n = foot;
      CHECK(held[n + ".friction_force_N"][10] / held[n + ".normal_force_N"][10] ==
            Approx(0.99 * 0.3).epsilon(1e-5));
    }
    const Result slides = simulate(on_two_feet(dry(0.3, 0.3), 1.01 * 0.3), o);
    REQUIRE(slides.summary.ok());
    const double a = std::atan(1.01 * 0.3);
    CHECK(slides.final.q[0] == Approx(0.5 * g * (std::sin(a) - 0.3 * std::cos(a))).epsilon(1e-6));
  }
}

/// A table that a driver shakes, with a block on it and another on that.
Model stack(double amplitude, double frequency, double mu_table, double mu_between) {
  Model m;
  const double m1 = 2.0, m2 = 1.0, d1 = depth_under((m1 + m2) * g), d2 = depth_under(m2 * g);
  const BodyId table = m.add(Body{.name = "table", .mass = 5.0, .inertia = 0.1});
  const BodyId low =
      m.add(Body{.name = "low", .mass = m1, .inertia = 0.01, .pose = {{0.0, 0.05 - d1}, 0.0}});
  const BodyId high = m.add(
      Body{.name = "high", .mass = m2, .inertia = 0.01, .pose = {{0.0, 0.15 - d1 - d2}, 0.0}});
  m.add(Prismatic{.name = "rail", .a = ground, .b = table, .along = {1.0, 0.0}});
  m.add(DisplacementDriver{
      .name = "shaker",
      .body = table,
      .displacement = [amplitude, frequency](double t) -> TimeValue {
        const double c = std::cos(frequency * t), s = std::sin(frequency * t), w = frequency;
        return {amplitude * (1.0 - c), amplitude * w * s, amplitude * w * w * c};
      }});
  for (const BodyId b : {low, high})
    m.add(AngleDriver{
        .name = "upright" + std::to_string(b.index), .body = b, .angle = constant(0.0)});
  m.add(Gravity{});
  stand(m, low, {0.0, -d1}, dry(mu_table, mu_table), {.name = "foot", .body = table});
  stand(m, high, {0.0, 0.1 - d1 - d2}, dry(mu_between, mu_between),
        {.name = "between", .body = low, .at = {0.0, 0.1 - d1}});
  return m;
}

/// Velocity of a block on a table whose velocity is A w sin(w t), from rest, by closed forms between
/// transitions, which are found by bisection. `transitions` counts them.
double velocity_on_table(double A, double w, double mu, double end, int& transitions) {
  const auto table = [&](double t) { return A * w * std::sin(w * t); };
  const auto sticks = [&](double t) { return A * w * w * std::abs(std::cos(w * t)) < mu * g; };
  double t = 0.0, from = 0.0, v = 0.0, direction = sticks(0.0) ? 0.0 : 1.0;
  const double step = 1e-6;
  const auto block = [&](double at) { return v + direction * mu * g * (at - from); };
  for (transitions = 0; t + step < end; t += step) {
    const double next = t + step;
    if (direction == 0.0 ? sticks(next) : direction * (table(next) - block(next)) > 0.0) continue;
    double low = t, high = next;
    for (int i = 0; i < 60; ++i) {
      const double mid = 0.5 * (low + high);
      const bool same =
          direction == 0.0 ? sticks(mid) : direction * (table(mid) - block(mid)) > 0.0;
      (same ? low : high) = mid;
    }
    v = table(high);
    const bool broke = direction == 0.0;
    from = high;
    direction = !broke && sticks(high) ? 0.0 : std::cos(w * high) > 0.0 ? 1.0 : -1.0;
    ++transitions;
  }
  return direction == 0.0 ? table(end) : block(end);
}

TEST_CASE("coulomb: blocks on a shaken table stick, slide and turn round without chatter") {
  const double A = 0.02;
  for (const double w :
       {8.0, 14.0, 22.0, 60.0})  // sticks; sticks and slips; ever less; turns round
    for (const auto& [below, between] : {std::pair{0.2, 0.5}, {0.9, 0.2}}) {
      INFO(w << " " << below);
      const Result r = simulate(stack(A, w, below, between),
                                {.until = 1.0, .relative_tolerance = 1e-10, .samples = 11});
      REQUIRE(r.summary.ok());
      int transitions = 0;
      const bool both_slide = 0.9 * g < A * w * w;
      const double expected = velocity_on_table(A, w, 0.2, 1.0, transitions);
      if (below == 0.2) {  // the two go together
        CHECK(r["low.vx_m_per_s"].tail(1)[0] == Approx(expected).epsilon(1e-6));
        CHECK(r["high.vx_m_per_s"].tail(1)[0] == Approx(expected).epsilon(1e-6));
      } else if (!both_slide) {
        CHECK(r["high.vx_m_per_s"].tail(1)[0] == Approx(expected).epsilon(1e-6));
      }
      if (!both_slide) CHECK(static_cast<int>(r.events.size()) <= transitions + 6);
      CHECK(r.summary.energy_balance < 1e-8 * r.summary.energy_exchanged);
      CHECK(r["dissipated_J"].tail(1)[0] >= -1e-12);
    }
}

TEST_CASE("coulomb: the smooth law tends to it, half as far off for half the threshold") {
  const double mu = 0.3, angle = std::atan(0.2);
  const SimulationOptions o{.until = 2.0, .relative_tolerance = 1e-11};
  const double exact = simulate(block(dry(mu, mu), angle, 1.0), o).final.q[0];
  double last = 0.0;
  for (const double threshold : {4e-3, 2e-3, 1e-3}) {
    const ContactLaw law{PowerLaw{K, 1.5}, HuntCrossley{10.0}, RegularisedCoulomb{mu, threshold}};
    const double off = simulate(block(law, angle, 1.0), o).final.q[0] - exact;
    CHECK(off > 0.0);  // it creeps
    if (last > 0.0) CHECK(last / off == Approx(2.0).epsilon(0.02));
    last = off;
  }
}

TEST_CASE("coulomb: a run taken up while it sticks gives the same bits") {
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    const Model model = on_two_feet(dry(0.3, 0.3), 0.2);
    TemporaryFolder whole, cut_short;
    SimulationOptions o{.until = 0.4,
                        .relative_tolerance = tolerance_of(f, 1e-8),
                        .formulation = std::string(f.name),
                        .samples = 41,
                        .checkpoints = {.folder = whole.path(), .every = 0.033}};
    const Result all = simulate(model, o);
    REQUIRE(all.summary.ok());
    CHECK(rests(all.final.contacts[0].grip));
    o.checkpoints.folder = cut_short.path();
    SimulationOptions stopped = o;
    stopped.observer = [](const Progress& p) { return p.t < 0.2; };
    CHECK(!simulate(model, stopped).summary.ok());
    o.checkpoints.resume = true;
    const Result resumed = simulate(model, o);
    const std::vector<double>&a = resumed.samples.data(), &b = all.samples.data();
    REQUIRE(a.size() == b.size());
    CHECK(std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0);
  }
}

TEST_CASE("coulomb: a velocity given to what sticks, in a snapshot, sets it going") {
  const double mu = 0.3, v = 0.2;
  const Model model = block(dry(mu, mu), std::atan(0.5 * mu));
  Simulation run(model, {.until = 1.0, .relative_tolerance = 1e-10});
  run.advance_to(0.1);
  Snapshot here = run.snapshot();
  REQUIRE(here.state.contacts[0].grip == Grip::held);
  run.restore(here);
  CHECK(run.snapshot().state.contacts[0].grip == Grip::held);
  here.state.v[0] = v;
  run.restore(here);
  CHECK(run.snapshot().state.v[0] == Approx(v));
  run.advance_to(1.0);
  const double slowing = g * std::cos(std::atan(0.5 * mu)) * 0.5 * mu;
  CHECK(run.state().q[0] - here.state.q[0] == Approx(0.5 * v * v / slowing).epsilon(1e-8));
  CHECK(run.state().v[0] == 0.0);
}

TEST_CASE("coulomb: a disc that bounces and spins: formulations agree, the ledger is closed") {
  Model m;
  const double r = 0.05;
  const Vec2 start(0.0, r + 0.02);
  const BodyId ball = m.add(Body{.name = "ball",
                                 .mass = 1.0,
                                 .inertia = 0.5 * r * r,
                                 .pose = {start, 0.0},
                                 .twist = {{0.3, 0.0}, 40.0}});
  m.add(Gravity{});
  m.add(DiscOnCurve{.name = "floor",
                    .disc = {ball, start, r},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = ContactLaw{PowerLaw{K, 1.5}, HuntCrossley{0.4}, Coulomb{0.3, 0.4}},
                    .reference_force = 100.0});
  const auto run = [&](const std::string& formulation, double rtol) {
    return simulate(
        m, {.until = 0.25, .relative_tolerance = rtol, .formulation = formulation, .samples = 26});
  };
  const Result best = run("arkode-projection", 1e-12);
  REQUIRE(best.summary.ok());
  CHECK(best.summary.energy_balance < 1e-9 * best.summary.energy_exchanged);
  CHECK(std::abs(best.final.v[0] - 0.3) > 0.1);
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    const double rtol = tolerance_of(f, 1e-9);
    const Result here = run(std::string(f.name), rtol);
    REQUIRE(here.summary.ok());
    CHECK(here.events.size() == best.events.size());
    CHECK(std::abs(here.final.q[0] - best.final.q[0]) < 1e3 * rtol);
    CHECK(std::abs(here.final.v[2] - best.final.v[2]) < 1e5 * rtol);
    CHECK(here.summary.energy_balance < 1e3 * rtol * here.summary.energy_exchanged);
  }
}

TEST_CASE("coulomb: a blow is more than friction holds; it slides on and stops") {
  const double mu = 0.3, speed = 0.7;
  Model m = block(dry(mu, mu), 0.0);
  const BodyId body = m.find_body("block");
  m.add(EventFunction{.name = "blow",
                      .function = [](const Motion& at) { return at.t - 0.1; },
                      .action =
                          [body, speed](const EventAction& e) {
                            e.impulse(body, {2.0 * speed, 0.0}, 0.0);
                          }});
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    const Result r = simulate(m, {.until = 1.0,
                                  .relative_tolerance = tolerance_of(f, 1e-9),
                                  .formulation = std::string(f.name),
                                  .samples = 11});
    REQUIRE(r.summary.ok());
    const double way = speed * speed / (2.0 * mu * g);
    CHECK(r.final.q[0] == Approx(way).epsilon(1e2 * tolerance_of(f, 1e-9)));
    REQUIRE(times_of(r, "stick").size() == 2);
    CHECK(times_of(r, "slip").size() == 1);
    CHECK(times_of(r, "stick")[1] == Approx(0.1 + speed / (mu * g)).epsilon(1e-6));
    CHECK(r.final.v[0] == 0.0);
  }
}

TEST_CASE("coulomb: a load that is set beyond what friction holds moves it at once") {
  const double mu = 0.3, limit = mu * 2.0 * g;
  Model m = block(dry(mu, mu), 0.0);
  m.add(AppliedForce{.name = "push", .body = m.find_body("block"), .value = Vec2(0.0, 0.0)});
  Simulation run(m, {.until = 1.0, .relative_tolerance = 1e-9});
  run.advance_to(0.2);
  run.set("push.fx", 0.9 * limit);
  run.advance_to(0.4);
  CHECK(run.state().q[0] == 0.0);
  CHECK(run.get("floor.friction_force_N") == Approx(0.9 * limit).epsilon(1e-9));
  run.set("push.fx", 1.5 * limit);
  run.advance_to(0.6);
  const double a = 0.5 * mu * g, x = 0.5 * a * 0.04, v = a * 0.2;
  CHECK(run.state().q[0] == Approx(x).epsilon(1e-8));
  run.set("push.fx", 0.0);
  run.advance_to(1.0);
  CHECK(run.state().q[0] == Approx(x + v * v / (2.0 * mu * g)).epsilon(1e-8));
  CHECK(run.state().v[0] == 0.0);
}

TEST_CASE("coulomb: wrong coefficients are named") {
  CHECK(message_of<ModelError>([] { dry(-0.1, 0.2); }).find("mu = -0.1") != std::string::npos);
  CHECK(message_of<ModelError>([] { dry(0.3, 0.2); }).find("mu_static = 0.2 must be at least") !=
        std::string::npos);
}

}  // namespace
