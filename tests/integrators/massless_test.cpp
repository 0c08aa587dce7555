// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Bodies without mass or inertia whose motion follows from the joints: runs in every formulation,
// impasses, what is refused.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <yoke/contact/laws/dissipative/kelvin_voigt.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/weld.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/wall.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

constexpr double crank_length = 0.1, rod_length = 0.3, slider_mass = 1.0;  // [m], [m], [kg]

double slider_at(double angle) {
  return crank_length * std::cos(angle) +
         std::sqrt(rod_length * rod_length - std::pow(crank_length * std::sin(angle), 2));
}

struct CrankStart {
  double angle = 1.2, speed = 0.5;  // [rad] of the crank, [m/s] of the slider
  double links = 0.0;               // [kg] of crank and rod each
};

/// A slider with a crank and a rod, no gravity.
Model free_slider_crank(const CrankStart& o = {}) {
  Model m;
  const Vec2 pin = rotate(o.angle, {crank_length, 0.0}), end(slider_at(o.angle), 0.0);
  const double rod_angle = std::atan2(end.y() - pin.y(), end.x() - pin.x());
  const auto rod_inertia = [&](double l) { return o.links * l * l / 12.0; };
  const double slope = -crank_length * std::sin(o.angle) -
                       crank_length * crank_length * std::sin(o.angle) * std::cos(o.angle) /
                           (rod_length * std::cos(rod_angle));
  const double rate = o.speed == 0.0 ? 0.0 : o.speed / slope;
  const double rod_rate =
      -crank_length * std::cos(o.angle) * rate / (rod_length * std::cos(rod_angle));
  const Vec2 pin_rate = rate * perp(pin);
  const auto crank = m.add(Body{.name = "crank",
                                .mass = o.links,
                                .inertia = rod_inertia(crank_length),
                                .pose = {0.5 * pin, o.angle},
                                .twist = {0.5 * pin_rate, rate}});
  const auto rod = m.add(Body{.name = "rod",
                              .mass = o.links,
                              .inertia = rod_inertia(rod_length),
                              .pose = {0.5 * (pin + end), rod_angle},
                              .twist = {0.5 * (pin_rate + Vec2(o.speed, 0.0)), rod_rate}});
  const auto slider = m.add(Body{.name = "slider",
                                 .mass = slider_mass,
                                 .inertia = 1e-4,
                                 .pose = {end, 0.0},
                                 .twist = {{o.speed, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "crank pin", .a = crank, .b = rod, .at = pin});
  m.add(Revolute{.name = "slider pin", .a = rod, .b = slider, .at = end});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  return m;
}

/// `count` point masses of 1 kg in a row from the origin, 1 m apart, each the end of a massless rod
/// with a frame of its own. The first is turned by `angle` from hanging, the others in line with it.
Model bobs_on_rods(int count, double angle) {
  Model m;
  BodyId last = ground;
  const Vec2 along = rotate(angle, {0.0, -1.0});
  for (int i = 0; i < count; ++i) {
    const std::string name = std::to_string(i);
    const BodyId rod = m.add(Body{.name = "rod " + name, .pose = {(i + 0.4) * along, angle}});
    const BodyId bob =
        m.add(Body{.name = "bob " + name, .mass = 1.0, .pose = {(i + 1.0) * along, 0.3}});
    m.add(Revolute{.name = "pin " + name, .a = last, .b = rod, .at = i * along});
    m.add(Weld{.name = "eye " + name, .a = rod, .b = bob});
    last = bob;
  }
  m.add(Gravity{.name = "gravity", .acceleration = {0.0, -9.81}});
  return m;
}

/// The same without massless bodies: the bobs have an inertia that plays no part and are tied by
/// distances.
Model bobs_on_distances(int count, double angle) {
  Model m;
  BodyId last = ground;
  const Vec2 along = rotate(angle, {0.0, -1.0});
  for (int i = 0; i < count; ++i) {
    const std::string name = std::to_string(i);
    const Vec2 from = i * along, to = (i + 1.0) * along;
    const BodyId bob =
        m.add(Body{.name = "bob " + name, .mass = 1.0, .inertia = 1.0, .pose = {to}});
    m.add(Distance{.name = "rod " + name, .a = last, .b = bob, .at_a = from, .at_b = to});
    last = bob;
  }
  m.add(Gravity{.name = "gravity", .acceleration = {0.0, -9.81}});
  return m;
}

Vec2 place_of(const Model& m, const Result& run, const std::string& body) {
  return run.final.q.segment<2>(3 * (m.find_body(body).index - 1));
}
double angle_of(const Model& m, const Result& run, const std::string& body) {
  return run.final.q[3 * (m.find_body(body).index - 1) + 2];
}
double rate_of_angle(const Model& m, const Result& run, const std::string& body) {
  return run.final.v[3 * (m.find_body(body).index - 1) + 2];
}
double speed_of(const Model& m, const Result& run, const std::string& body) {
  return run.final.v.segment<2>(3 * (m.find_body(body).index - 1)).norm();
}

std::string refusal(const Model& m) {
  return message_of([&] { simulate(m, {.until = 1.0}); });
}

double time_of_impasse(const std::string& reason) {
  const std::string words = "impasse at t = ";
  return reason.starts_with(words) ? std::stod(reason.substr(words.size())) : std::nan("");
}

// Of the tolerance; that of order 2 accumulates more.
double accuracy(const std::string& formulation, double tolerance) {
  return (formulation == "generalised-alpha" ? 1e4 : 1e3) * tolerance;
}

}  // namespace

TEST_CASE("a slider on massless links and a spring swings harmonically, in every formulation") {
  Model m = free_slider_crank({.angle = 1.2, .speed = 0.1});
  const double x0 = slider_at(1.2), k = 40.0, w = std::sqrt(k / slider_mass);
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = m.find_body("slider"),
                            .at_a = {x0 + 1.0, 0.0},
                            .at_b = {x0, 0.0},
                            .stiffness = k,
                            .free_length = 1.0});
  const double t = 3.0, x = x0 + 0.1 / w * std::sin(w * t);
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const double tolerance = formulation == "generalised-alpha" ? 1e-6 : 1e-9;
    const Result run =
        simulate(m, {.until = t, .relative_tolerance = tolerance, .formulation = formulation});
    REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
    CHECK(std::abs(place_of(m, run, "slider").x() - x) < accuracy(formulation, tolerance));
    CHECK(std::abs(slider_at(angle_of(m, run, "crank")) - place_of(m, run, "slider").x()) < 1e-8);
  }
}

TEST_CASE("a torque on a massless crank gives the slider all its work") {
  Model m = free_slider_crank({.angle = 0.4, .speed = -0.2});
  const double torque = 0.5;
  m.add(AppliedTorque{
      .name = "motor", .body = m.find_body("crank"), .torque = [](double) { return 0.5; }});
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const double tolerance = formulation == "generalised-alpha" ? 1e-6 : 1e-9;
    const Result run =
        simulate(m, {.until = 0.1, .relative_tolerance = tolerance, .formulation = formulation});
    REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
    const double turned = angle_of(m, run, "crank") - 0.4;
    CHECK(turned > 0.5);
    const double gained = 0.5 * slider_mass * (std::pow(speed_of(m, run, "slider"), 2) - 0.2 * 0.2);
    CHECK(std::abs(gained - torque * turned) < accuracy(formulation, tolerance));
  }
}

TEST_CASE("massless links are the limit of light ones") {
  const Model none = free_slider_crank();
  const SimulationOptions options{.until = 0.1, .relative_tolerance = 1e-11};
  const Result limit = simulate(none, options);
  REQUIRE_MESSAGE(limit.summary.ok(), limit.summary.reason);
  // Nothing but the slider has energy: its speed stays.
  CHECK(std::abs(place_of(none, limit, "slider").x() - slider_at(1.2) - 0.05) < 1e-10);
  double last = 0.0;
  for (const double mass : {1e-3, 1e-5, 1e-7}) {
    const Model light = free_slider_crank({.links = mass});
    const Result run = simulate(light, options);
    REQUIRE(run.summary.ok());
    const double off = std::abs(angle_of(light, run, "crank") - angle_of(none, limit, "crank"));
    if (last > 0.0) CHECK(off / last == doctest::Approx(1e-2).epsilon(0.1));
    last = off;
  }
}

TEST_CASE("massless links end at the dead centre: every formulation says where and who") {
  const Model m = free_slider_crank();
  const double dead = (crank_length + rod_length - slider_at(1.2)) / 0.5;
  for (const std::string& formulation : every_formulation)
    for (const double tolerance : {1e-3, 1e-6, 1e-10}) {
      INFO(formulation << " at " << tolerance);
      const Result run =
          simulate(m, {.until = 10.0, .relative_tolerance = tolerance, .formulation = formulation});
      CHECK(run.summary.stop == Stop::failed);
      CHECK_MESSAGE(std::abs(time_of_impasse(run.summary.reason) - dead) < 10.0 * tolerance,
                    run.summary.reason << " not " << dead);
      CHECK(
          contains(run.summary.reason,
                   "s: 'crank' and 'rod', which have no mass, could move without any mass moving; "
                   "the motion has no continuation"));
      CHECK(std::abs(speed_of(m, run, "slider") - 0.5) < 10.0 * tolerance);
      CHECK(run.summary.singular_positions.empty());
    }
}

TEST_CASE("light links are not taken for massless ones, nor is any other failure an impasse") {
  const Result whirl =
      simulate(free_slider_crank({.links = 1e-4}), {.until = 1.0, .relative_tolerance = 1e-8});
  CHECK_MESSAGE(whirl.summary.ok(), whirl.summary.reason);
  Model m = bobs_on_rods(1, 1.0);
  m.add(AppliedForce{.name = "pull",
                     .body = m.find_body("bob 0"),
                     .at = m.body(m.find_body("bob 0")).pose.position,
                     .force = [](double t) { return Vec2(std::sqrt(0.5 - t), 0.0); }});
  const Result run = simulate(m, {.until = 1.0});
  CHECK(run.summary.stop == Stop::failed);
  CHECK_MESSAGE(!contains(run.summary.reason, "impasse"), run.summary.reason);
}

TEST_CASE("a point mass on its pin has the period of the simple pendulum, in every formulation") {
  const double amplitude = 1.0, length = 0.7, g = 9.81;
  Model m;
  const Vec2 at = rotate(amplitude, {0.0, -length});
  const BodyId bob = m.add(Body{.name = "bob", .mass = 2.0, .pose = {at, 0.0}});
  m.add(Revolute{.name = "pin", .a = ground, .b = bob, .at = {0.0, 0.0}});
  m.add(Gravity{.name = "gravity", .acceleration = {0.0, -g}});
  const double period = 4.0 * std::sqrt(length / g) * std::comp_ellint_1(std::sin(0.5 * amplitude));
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const double tolerance = formulation == "generalised-alpha" ? 1e-6 : 1e-9;
    const Result run = simulate(
        m, {.until = 1.5 * period, .relative_tolerance = tolerance, .formulation = formulation});
    REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
    // The start pose has the angle zero; after three halves it rests on the other side.
    CHECK(std::abs(angle_of(m, run, "bob") + 2.0 * amplitude) < accuracy(formulation, tolerance));
    CHECK(std::abs(rate_of_angle(m, run, "bob")) < accuracy(formulation, tolerance));
  }
}

TEST_CASE("scales come from joints where a single point mass has none of its own") {
  for (const double unit : {1.0, 1e-6}) {
    Model m;
    const BodyId bob = m.add(Body{.name = "bob", .mass = 2.0, .pose = {{0.7 * unit, 0.0}, 0.0}});
    m.add(Revolute{.name = "pin", .a = ground, .b = bob, .at = {0.0, 0.0}});
    m.add(Gravity{.name = "gravity", .acceleration = {0.0, -9.81 * unit}});
    const Result run = simulate(m, {.until = 1.0});
    REQUIRE(run.summary.ok());
    CHECK(run.summary.length_scale == doctest::Approx(0.7 * unit / std::sqrt(2.0)).epsilon(1e-12));
  }
}

TEST_CASE("a double pendulum of massless rods and point masses moves as one of distances") {
  const Model rods = bobs_on_rods(2, 1.1), distances = bobs_on_distances(2, 1.1);
  const Result expected = simulate(distances, {.until = 2.0, .relative_tolerance = 1e-12});
  REQUIRE(expected.summary.ok());
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const double tolerance = formulation == "generalised-alpha" ? 1e-6 : 1e-10;
    const Result run =
        simulate(rods, {.until = 2.0, .relative_tolerance = tolerance, .formulation = formulation});
    REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
    for (const char* bob : {"bob 0", "bob 1"})
      CHECK((place_of(rods, run, bob) - place_of(distances, expected, bob)).norm() <
            10.0 * accuracy(formulation, tolerance));
  }
}

TEST_CASE("a four-bar with a massless coupler is the limit of one with a light coupler") {
  const auto four_bar = [](double mass) {
    Model m;
    const Vec2 a(0.0, 0.0), b(0.1, 0.2), c(0.5, 0.3), d(0.45, 0.0);
    const auto link = [&](const char* name, const Vec2& from, const Vec2& to, double kg) {
      const Vec2 way = to - from;
      return m.add(Body{.name = name,
                        .mass = kg,
                        .inertia = kg * way.squaredNorm() / 12.0,
                        .pose = {0.5 * (from + to), std::atan2(way.y(), way.x())}});
    };
    const BodyId crank = link("crank", a, b, 1.0), coupler = link("coupler", b, c, mass),
                 rocker = link("rocker", d, c, 0.7);
    m.add(Revolute{"A", ground, crank, a});
    m.add(Revolute{"B", crank, coupler, b});
    m.add(Revolute{"C", coupler, rocker, c});
    m.add(Revolute{"D", ground, rocker, d});
    m.add(Gravity{});
    return m;
  };
  const auto angle_after = [&](double mass, const std::string& formulation, double tolerance) {
    const Model m = four_bar(mass);
    const Result run =
        simulate(m, {.until = 0.6, .relative_tolerance = tolerance, .formulation = formulation});
    REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
    return angle_of(m, run, "crank");
  };
  const double limit = angle_after(0.0, "arkode-projection", 1e-12);
  const double off = angle_after(1e-4, "arkode-projection", 1e-12) - limit;
  CHECK(angle_after(1e-6, "arkode-projection", 1e-12) - limit ==
        doctest::Approx(1e-2 * off).epsilon(0.02));
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const double tolerance = formulation == "generalised-alpha" ? 1e-6 : 1e-9;
    CHECK(std::abs(angle_after(0.0, formulation, tolerance) - limit) <
          10.0 * accuracy(formulation, tolerance));
  }
}

TEST_CASE("massless bodies that drivers move need no mass at all") {
  Model m;
  const BodyId crank = m.add(Body{.name = "crank", .pose = {{0.1, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(0.0, 2.0)});
  m.add(TorsionalSpring{.name = "spring", .a = ground, .b = crank, .stiffness = 3.0});
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const Result run = simulate(m, {.until = 1.0, .formulation = formulation});
    REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
    CHECK(angle_of(m, run, "crank") == doctest::Approx(2.0).epsilon(1e-9));
    CHECK(run.final.energy[0] == doctest::Approx(0.5 * 3.0 * 4.0).epsilon(1e-6));
  }
}

TEST_CASE("what no joint determines is refused by name and with what it can do") {
  Model free;
  free.add(Body{.name = "bob", .mass = 1.0, .inertia = 1.0});
  free.add(Body{.name = "ghost", .pose = {{1.0, 0.0}, 0.0}});
  CHECK(refusal(free).starts_with("'ghost': no mass and free to turn and shift; "));

  Model pinned;
  const BodyId rod = pinned.add(Body{.name = "rod", .pose = {{0.31, 0.17}, 0.3}});
  pinned.add(Revolute{.name = "pin", .a = ground, .b = rod, .at = {0.0, 0.0}});
  CHECK(refusal(pinned) ==
        "'rod': no mass and free to turn; joints must tie what has no mass or inertia to what has, "
        "or drive it");

  Model point;
  const BodyId bob = point.add(Body{.name = "bob", .mass = 1.0, .pose = {{1.0, 0.0}, 0.0}});
  point.add(Distance{.name = "rod", .a = ground, .b = bob, .at_a = {0.0, 0.0}, .at_b = {1.0, 0.0}});
  CHECK(refusal(point).starts_with("'bob': no inertia and free to turn; "));

  Model wheel;
  wheel.add(Body{.name = "wheel", .inertia = 1.0});
  CHECK(refusal(wheel).starts_with("'wheel': no mass and free to shift; "));

  Model between;  // two massless rods between two pins of the ground that are not stretched
  const BodyId a = between.add(Body{.name = "a", .pose = {{0.5, 0.5}, 0.0}});
  const BodyId b = between.add(Body{.name = "b", .pose = {{1.5, 0.5}, 0.0}});
  const BodyId c = between.add(Body{.name = "c", .pose = {{2.0, 0.5}, 0.0}});
  between.add(Revolute{.name = "A", .a = ground, .b = a, .at = {0.0, 0.0}});
  between.add(Revolute{.name = "B", .a = a, .b = b, .at = {1.0, 1.0}});
  between.add(Revolute{.name = "C", .a = b, .b = c, .at = {2.0, 1.0}});
  between.add(Revolute{.name = "D", .a = ground, .b = c, .at = {2.2, 0.0}});
  CHECK(refusal(between).starts_with("'a', 'b' and 'c': no mass and free to move together; "));
}

TEST_CASE("a start at the dead centre of massless links is refused as an impasse") {
  Model m = free_slider_crank({.angle = 0.0, .speed = 0.0});
  CHECK(refusal(m) ==
        "the start is an impasse: 'crank' and 'rod', which have no mass, could move without any "
        "mass moving; start beside it");
}

TEST_CASE("a massless rod that meets a wall bounces with what it carries") {
  // A bob of 2 kg, 0.5 m from the pin; the tip of the rod, 0.8 m from it, meets the wall. With the
  // effective mass of the tip, a linear spring and Kelvin-Voigt's damper return e of the speed.
  Model m;
  const double omega = 2.0, e = 0.6;
  const BodyId rod =
      m.add(Body{.name = "rod", .pose = {{0.2, 0.0}, 0.0}, .twist = {{0.0, -0.2 * omega}, -omega}});
  const BodyId bob = m.add(Body{.name = "bob",
                                .mass = 2.0,
                                .pose = {{0.5, 0.0}, 0.0},
                                .twist = {{0.0, -0.5 * omega}, -omega}});
  m.add(Revolute{.name = "pin", .a = ground, .b = rod, .at = {0.0, 0.0}});
  m.add(Weld{.name = "eye", .a = rod, .b = bob});
  m.add(Wall{.name = "wall",
             .body = rod,
             .law = ContactLaw(PowerLaw{1e7, 1.0}, KelvinVoigt{e}),
             .height = -1e-3,
             .point = {0.6, 0.0}});
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const double tolerance = formulation == "generalised-alpha" ? 1e-6 : 1e-9;
    const Result run =
        simulate(m, {.until = 3e-3, .relative_tolerance = tolerance, .formulation = formulation});
    REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
    CHECK(run.final.contacts.front().phase == ContactPhase::apart);
    const double rate = rate_of_angle(m, run, "rod");
    CHECK(rate == doctest::Approx(e * omega).epsilon(1e-4));
    CHECK(run.final.energy[0] ==
          doctest::Approx(0.5 * 2.0 * 0.25 * (omega * omega - rate * rate)).epsilon(1e-4));
  }
}

TEST_CASE("a checkpoint of massless bodies is taken up bit for bit") {
  const Model m = bobs_on_rods(2, 1.1);
  const TemporaryFolder whole, cut;
  const auto options = [](const std::filesystem::path& folder) {
    return SimulationOptions{.until = 0.5,
                             .relative_tolerance = 1e-8,
                             .samples = 51,
                             .checkpoints = {.folder = folder, .every = 0.1}};
  };
  const Result reference = simulate(m, options(whole.path()));
  SimulationOptions interrupted = options(cut.path());
  interrupted.observer = [](const Progress& p) { return p.t < 0.27; };
  REQUIRE(simulate(m, interrupted).summary.stop == Stop::interrupted);
  const Result resumed = resume(m, cut.path());
  CHECK((resumed.final.q.array() == reference.final.q.array()).all());
  CHECK((resumed.final.v.array() == reference.final.v.array()).all());
}

TEST_CASE("a law that needs an effective mass is named where a driver holds the contact") {
  for (const double mass : {0.0, 1.0}) {
    Model m;
    const BodyId ram = m.add(Body{.name = "ram", .mass = mass, .inertia = mass});
    m.add(Prismatic{.name = "guide", .a = ground, .b = ram, .along = {0.0, 1.0}});
    m.add(DisplacementDriver{.name = "motor",
                             .body = ram,
                             .along = {0.0, 1.0},
                             .displacement = constant_speed(0.0, -1.0)});
    m.add(Wall{.name = "wall",
               .body = ram,
               .law = ContactLaw(PowerLaw{1e7, 1.5}, KelvinVoigt{0.6}),
               .height = -1e-3});
    const Result run = simulate(m, {.until = 2e-3});
    CHECK(run.summary.stop == Stop::failed);
    CHECK_MESSAGE(contains(run.summary.reason, "damps with the effective mass of the contact"),
                  run.summary.reason);
  }
}
