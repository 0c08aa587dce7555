// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The state machine of a contact, on the plainest geometry there is: a mass on the x axis and a
// wall.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <yoke/contact/contact_element.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>

#include <yoke/tests/contact/laws/test_laws.hpp>
#include <yoke/tests/contact/scene.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;
using Event = ContactElement::Event;

namespace {

/// Penetration x_a - x_b; two regions, left of y_a = 0 and above it, both with the same wall.
class Wall final : public ContactGeometry {
 public:
  std::vector<std::string> region_names() const override { return {"low", "high"}; }
  int nearest(const Motion& m) const override { return m[BodyId{1}].y < 0.0 ? 0 : 1; }
  double penetration(const Motion& m, int) const override {
    return m[BodyId{1}].x - m[BodyId{2}].x;
  }
  void calc_kinematics(const Motion& m, int region, bool, ContactKinematics& out) const override {
    out = {};
    out.penetration = penetration(m, region);
    out.gradient[0] = 1.0;
    out.gradient[3] = -1.0;
  }
  ContactPlace calc_place(const Motion&, int) const override { return {}; }
  double boundary(const Motion& m, int region) const override {
    return region == 0 ? m[BodyId{1}].y : -m[BodyId{1}].y;
  }
  int successor(const Motion&, int region) const override { return 1 - region; }
};

const PowerLaw hertzian{2.7e9, 1.5};
const PowerLaw linear{3.1e7, 1.0};
constexpr double mass = 0.83;                              // [kg], as the scene's effective mass
const double touch = touch_tolerance(0.1, 100.0 / 3.1e7);  // [m] of the scene's scales

Scene wall_scene(const ContactLaw& low, const ContactLaw& high) {
  Scene scene;
  scene.element = std::make_unique<ContactElement>(
      "wall", BodyId{1}, BodyId{2}, std::make_unique<Wall>(), std::vector{low, high}, 100.0);
  return scene;
}

void put(Scene& scene, double d, double rate, double acceleration = 0.0, double y = -0.1) {
  scene.set({d, y, 0.0, 0.0, 0.0, 0.0}, {rate, 0.0, 0.0, 0.0, 0.0, 0.0});
  scene.acceleration = {acceleration};
}

/// A mass against the wall under a force of its own, by Runge-Kutta steps and located events: what
/// an integrator does with the element, in thirty lines. Keeps the energy ledger.
class Run {
 public:
  Run(Scene& scene, double d, double rate, std::function<double(double)> load)
      : scene_(scene), load_(std::move(load)), now_{d, rate, 0.0, 0.0} {
    show(now_);
    scene_.acceleration = {load_(scene_.t) / mass};
    scene_.initialise();
    start_ = energy();
  }

  void advance(double until, double step) {
    while (scene_.t < until - 1e-15) {
      const std::vector<double> before = scene_.event_functions();
      const double t = scene_.t;
      const Point from = now_;
      double h = std::min(step, until - t);
      const auto reach = [&](double share) {
        scene_.t = t;
        show(now_ = advanced(from, share));
        scene_.t = t + share;
      };
      reach(h);
      if (crossed(before) >= 0) {
        double low = 0.0;
        for (int i = 0; i < 70; ++i) {
          const double middle = 0.5 * (low + h);
          reach(middle);
          (crossed(before) >= 0 ? h : low) = middle;
        }
        reach(h);
        const int event = crossed(before);
        REQUIRE(event >= 0);
        if (disturb) disturb(now_.d);
        show(now_);
        scene_.acceleration = {slope(now_).rate};
        scene_.handle(event);
        ++events;
        REQUIRE(events < 2000);
      }
      deepest = std::max(deepest, now_.d);
      lowest_power = std::min(lowest_power, scene_.energy().dissipated_power);
    }
  }

  double d() const { return now_.d; }
  double rate() const { return now_.rate; }
  double dissipated() const { return now_.dissipated; }
  double ledger_error() const { return energy() - start_; }

  int events = 0;
  double deepest = -1.0, lowest_power = 0.0;
  std::function<void(double&)> disturb;  // rounding of the state at an event

 private:
  struct Point {
    double d, rate, dissipated, work;
  };
  void show(const Point& p) {
    scene_.set({p.d, -0.1, 0.0, 0.0, 0.0, 0.0}, {p.rate, 0.0, 0.0, 0.0, 0.0, 0.0});
  }
  Point slope(const Point& p) {
    show(p);
    const double load = load_(scene_.t);
    return {p.rate, (scene_.Q()[0] + load) / mass, scene_.energy().dissipated_power, load * p.rate};
  }
  static Point along(const Point& p, double h, const Point& s) {
    return {p.d + h * s.d, p.rate + h * s.rate, p.dissipated + h * s.dissipated,
            p.work + h * s.work};
  }
  Point advanced(const Point& p, double h) {
    const double t = scene_.t;
    const Point k1 = slope(p);
    scene_.t = t + 0.5 * h;
    const Point k2 = slope(along(p, 0.5 * h, k1)), k3 = slope(along(p, 0.5 * h, k2));
    scene_.t = t + h;
    const Point k4 = slope(along(p, h, k3));
    return along(along(along(along(p, h / 6.0, k1), h / 3.0, k2), h / 3.0, k3), h / 6.0, k4);
  }
  int crossed(const std::vector<double>& before) const {
    const std::vector<double> after = scene_.event_functions();
    for (std::size_t i = 0; i < after.size(); ++i)
      if (before[i] < 0.0 && after[i] >= 0.0) return static_cast<int>(i);
    return -1;
  }
  double energy() const {
    return 0.5 * mass * now_.rate * now_.rate + scene_.energy().stored + now_.dissipated -
           now_.work;
  }

  Scene& scene_;
  std::function<double(double)> load_;
  Point now_;
  double start_ = 0.0;
};

double no_load(double) { return 0.0; }

std::string kinds(const Scene& scene) {
  std::string text;
  for (const EventRecord& e : scene.records) text += (text.empty() ? "" : " ") + e.kind;
  return text;
}

}  // namespace

TEST_CASE("an onset records what the laws will ask for") {
  Scene scene = wall_scene({linear}, {hertzian});
  put(scene, -1e-4, 0.19);
  scene.initialise();
  CHECK(scene.memory == ContactMemory{});
  CHECK(scene.event_functions()[Event::onset] == Approx(-1e-4));
  scene.t = 0.37;
  put(scene, 1e-17, 0.19, 0.0, 0.1);
  scene.handle(Event::onset);
  CHECK(scene.memory.phase == ContactPhase::compressing);
  CHECK(scene.memory.region == 1);
  CHECK(scene.memory.onset_time == 0.37);
  CHECK(scene.memory.approach_velocity == 0.19);
  CHECK(scene.memory.effective_mass == 0.83);
  REQUIRE(scene.records.size() == 1);
  CHECK(scene.records[0].kind == "onset");
  CHECK(scene.records[0].region == "high");
  CHECK(scene.records[0].speed == 0.19);
}

TEST_CASE("a run may start apart, touching or pressed") {
  const auto phase_of = [](double d, double rate, double acceleration) {
    Scene scene = wall_scene({linear}, {linear});
    put(scene, d, rate, acceleration);
    scene.initialise();
    return scene.memory.phase;
  };
  CHECK(phase_of(-1e-6, 0.2, 50.0) == ContactPhase::apart);
  CHECK(phase_of(2e-5, -0.2, 50.0) == ContactPhase::compressing);
  CHECK(phase_of(1e-16, 0.2, -50.0) == ContactPhase::compressing);
  CHECK(phase_of(-1e-16, 0.2, -50.0) == ContactPhase::compressing);
  CHECK(phase_of(1e-16, -0.2, 50.0) == ContactPhase::apart);
  CHECK(phase_of(-1e-16, -0.2, 50.0) == ContactPhase::apart);
}

TEST_CASE("a contact that starts at rest presses as soon as it is loaded, and not before") {
  for (const double rounding : {0.0, 1e-16, -1e-16}) {
    Scene scene = wall_scene({linear, HuntCrossley{0.32}}, {linear});
    Run run(scene, rounding, 0.0, [](double t) { return t > 1e-3 ? 400.0 : 0.0; });
    run.advance(1e-3, 1e-5);
    CHECK(kinds(scene) == "");
    run.advance(3e-3, 1e-6);
    CHECK(kinds(scene) == "onset");
    CHECK(run.deepest == Approx(2.0 * 400.0 / 3.1e7).epsilon(0.01));
  }
}

TEST_CASE("a snapshot taken in contact goes on; one whose bodies were moved apart starts afresh") {
  Scene scene = wall_scene({linear}, {linear});
  put(scene, 2e-5, 0.1);
  scene.memory = {.phase = ContactPhase::compressing, .onset_time = 0.4, .approach_velocity = 0.17};
  const ContactMemory snapshot = scene.memory;
  scene.initialise();
  CHECK(scene.memory == snapshot);
  CHECK(scene.records.empty());
  put(scene, -1e-3, 0.1);
  scene.initialise();
  CHECK(scene.memory == ContactMemory{});
  scene.memory = {.phase = ContactPhase::apart, .region = 1, .onset_time = 0.4};
  put(scene, 1e-5, 0.1);
  scene.initialise();
  CHECK(scene.memory.phase == ContactPhase::compressing);
}

TEST_CASE("an impact closes the energy ledger and returns its closed form, law by law") {
  struct Case {
    ContactLaw law;
    double restitution;
    std::string events;
  };
  const std::vector<Case> cases = {
      {{hertzian}, 1.0, "onset release"},
      {{hertzian, hunt_crossley_restitution(0.5)}, 0.6629622000, "onset release"},
      {{linear, KelvinVoigt{0.5}}, 0.5, "onset release"},
      {{linear, KelvinVoigt{0.5, TensilePhase::clamp}}, 0.5502831696, "onset release"},
      {{hertzian, Tsuji{0.5, TensilePhase::clamp}}, 0.5502831696, "onset release"},
      {{hertzian, PermanentSet{0.7}}, 0.7, "onset turn release"}};
  for (const Case& each : cases) {
    CAPTURE(each.law.name());
    CAPTURE(each.restitution);
    Scene scene = wall_scene(each.law, each.law);
    Run run(scene, -1e-5, 0.19, no_load);
    run.advance(2.5e-3, 2e-7);
    CHECK(kinds(scene) == each.events);
    CHECK(scene.memory.release_penetration < 0.01 * touch);
    CHECK(-run.rate() / 0.19 == Approx(each.restitution).epsilon(1e-5));
    const double kinetic = 0.5 * mass * 0.19 * 0.19;
    CHECK(std::abs(run.ledger_error()) < 1e-7 * kinetic);
    // By itself: what is missing in the speed is what was counted as dissipated.
    CHECK(run.dissipated() ==
          Approx(kinetic * (1.0 - each.restitution * each.restitution)).epsilon(2e-5).scale(1e-4));
    CHECK(run.lowest_power >= 0.0);
  }
}

TEST_CASE(
    "a third body may pull: the contact lets go at zero force, relaxes, and may press again") {
  // 1/chi = 0.042 m/s for this alpha; the pull is strong enough to exceed it.
  Scene scene = wall_scene({linear, HuntCrossley{16.0}}, {linear, HuntCrossley{16.0}});
  Run run(scene, 3e-5, 0.0, [](double t) {
    return t < 1e-4 ? 800.0 : t < 1.3e-4 ? -2500.0 : 4000.0;
  });
  double least_force = 0.0;
  bool was_lifted = false;
  for (int i = 1; i <= 200; ++i) {
    run.advance(1e-6 * i, 5e-8);
    least_force = std::min(least_force, scene.channel_values()[2]);
    if (scene.memory.release_penetration > 1e-6) {
      was_lifted = true;
      CHECK(scene.channel_values()[3] == 0.0);
      CHECK(scene.channel_values()[2] == 0.0);
    }
  }
  CHECK(was_lifted);
  CHECK(kinds(scene) == "onset release onset");
  CHECK(scene.records[1].penetration > 1e-6);
  CHECK(scene.records[2].penetration < scene.records[1].penetration);
  CHECK(scene.records[2].penetration > 1e-6);
  CHECK(least_force == 0.0);
  CHECK(run.lowest_power >= 0.0);
  CHECK(scene.memory.onset_time == 0.0);  // the same contact
  CHECK(std::abs(run.ledger_error()) < 1e-8);
}

TEST_CASE("an onset that creeps in is put off once, wherever beside its place it was located") {
  constexpr double creeping = 1e-6;  // [m/s] may turn within the band of rounding
  for (const double beside : {-1.5, -0.6, 0.0, 0.4}) {
    CAPTURE(beside);
    Scene scene = wall_scene({hertzian}, {hertzian});
    put(scene, 0.0, creeping);
    scene.handle(Event::onset);
    CHECK(scene.memory.phase == ContactPhase::apart);
    CHECK(scene.memory.release_penetration == Approx(touch));
    put(scene, (1.0 + beside) * touch, creeping);
    scene.handle(Event::onset);
    CHECK(scene.memory.phase == ContactPhase::compressing);
    CHECK(kinds(scene) == "onset");
  }
}

TEST_CASE("a pull that goes on ends a lifted contact at zero penetration, with nothing stored") {
  Scene scene = wall_scene({linear, HuntCrossley{16.0}}, {linear});
  Run run(scene, 3e-5, 0.0, [](double) { return -2500.0; });
  run.advance(5e-4, 5e-8);
  CHECK(run.d() < 0.0);
  CHECK(kinds(scene) == "onset release");
  CHECK(scene.memory.phase == ContactPhase::apart);
  // No memory but the margin above rounding.
  CHECK(scene.memory.release_penetration < 0.01 * touch);
  CHECK(scene.energy().stored == 0.0);
  CHECK(std::abs(run.ledger_error()) < 1e-8);
}

TEST_CASE("a dent is met again at its bottom, on the unloading line, until it is forgotten") {
  const ContactLaw law{hertzian, PermanentSet{0.7}};
  Scene scene = wall_scene(law, law);
  // Thrown in: it comes to rest at d_m, lets go at d_m (1 - e^2) and keeps the dent in memory.
  Run run(scene, 0.0, 0.19, no_load);
  while (scene.records.size() < 3) run.advance(scene.t + 1e-6, 2e-7);
  CHECK(kinds(scene) == "onset turn release");
  const double set = scene.memory.permanent_set;
  CHECK(set == Approx(scene.records[1].penetration * (1.0 - 0.49)).epsilon(1e-9));
  CHECK(scene.memory.release_penetration >= set);
  CHECK(scene.memory.release_penetration < set + 0.01 * touch);

  // Thrown back from within the dent: met at its bottom, and all of the speed returns.
  Run again(scene, 0.6 * set, 0.11, no_load);
  again.advance(scene.t + 6e-4, 2e-7);
  CHECK(kinds(scene) == "onset turn release onset release");
  CHECK(scene.records[3].penetration == Approx(set));
  CHECK(scene.records[4].penetration == Approx(set));
  CHECK(scene.records[4].speed == Approx(-0.11).epsilon(1e-6));
  CHECK(scene.memory.onset_time == 0.0);
  CHECK(std::abs(again.ledger_error()) < 1e-9);

  // Out of the dent, all is forgotten.
  again.advance(scene.t + 4e-4, 2e-7);
  CHECK(again.d() < 0.0);
  CHECK(scene.memory.permanent_set == 0.0);
  CHECK(std::abs(scene.event_functions()[Event::onset] - again.d()) < 0.01 * touch);
}

TEST_CASE("a reload beyond the largest penetration is compression again, with a new end") {
  const ContactLaw law{hertzian, PermanentSet{0.7}};
  Scene scene = wall_scene(law, law);
  Run run(scene, 0.0, 0.19, [](double t) { return t < 4.5e-4 ? 0.0 : 4000.0; });
  run.advance(1.2e-3, 1e-7);
  CHECK(kinds(scene).find("onset turn reload turn") == 0);
  REQUIRE(scene.records.size() >= 4);
  CHECK(scene.records[2].penetration == Approx(scene.records[1].penetration).epsilon(1e-5));
  CHECK(scene.records[3].penetration > scene.records[2].penetration);
  CHECK(scene.memory.largest_penetration >= scene.records[3].penetration);
  CHECK(std::abs(run.ledger_error()) < 1e-8);
}

TEST_CASE("a mass dropped on the wall comes to rest in contact, however its state is rounded") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> rounding(-1e-14, 1e-14);
  for (const double size : {0.0, 1.0}) {
    Scene scene = wall_scene({linear, HuntCrossley{60.0}}, {linear});
    Run run(scene, -1e-6, 0.0, [](double) { return 50.0 * mass; });
    run.disturb = [&](double& d) { d += size * rounding(random); };
    run.advance(0.03, 2e-6);
    CHECK(scene.memory.phase == ContactPhase::compressing);
    CHECK(run.d() == Approx(50.0 * mass / 3.1e7).epsilon(0.3));
    CHECK(run.events < 60);
  }
}

TEST_CASE("undamped bouncing on the edge of contact neither chatters, sticks nor falls through") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> rounding(-1e-14, 1e-14);
  Scene scene = wall_scene({linear}, {linear});
  // Let go at touch without speed: returns to zero penetration with zero speed, again and again.
  Run run(scene, 0.0, 0.0, [](double) { return 400.0; });
  run.disturb = [&](double& d) { d += rounding(random); };
  const double period = 2.0 * pi * std::sqrt(mass / 3.1e7);
  run.advance(20.0 * period, period / 400.0);
  CHECK(run.deepest == Approx(2.0 * 400.0 / 3.1e7).epsilon(1e-3));
  CHECK(run.d() > -1e-9);
  CHECK(run.events < 3 * 20 + 5);
}

TEST_CASE("a grazing touch within rounding is no contact and cannot stick") {
  Scene scene = wall_scene({linear}, {linear});
  for (const double d : {1e-16, 0.0, -1e-16}) {
    scene.memory = {};
    put(scene, d, 1e-9, -100.0);
    scene.handle(Event::onset);
    CHECK(scene.memory.phase == ContactPhase::apart);
    CHECK(scene.event_functions()[Event::onset] < -0.9 * touch);
  }
  CHECK(scene.records.empty());
  // A load that presses after all is caught by the margin.
  put(scene, 1.1 * touch, 1e-7, 100.0);
  CHECK(scene.event_functions()[Event::onset] > 0.0);
  scene.handle(Event::onset);
  CHECK(scene.memory.phase == ContactPhase::compressing);
  CHECK(scene.event_functions()[Event::release] < 0.0);
}

TEST_CASE("a release leaves the contact apart and its onset armed, whatever the rounding") {
  for (const double d : {1e-16, 0.0, -1e-16}) {
    for (const double rate : {-0.1, -1e-12, 1e-15}) {
      Scene scene = wall_scene({linear}, {linear});
      scene.memory = {.phase = ContactPhase::compressing, .approach_velocity = 0.1};
      put(scene, d, rate, 1000.0);
      scene.handle(Event::release);
      CHECK(scene.memory.phase == ContactPhase::apart);
      // At once: a function that is zero would not be seen to cross zero in the step that follows.
      CHECK(scene.event_functions()[Event::onset] < 0.0);
      put(scene, d + std::min(rate, 0.0) * 1e-9, rate);
      CHECK(scene.event_functions()[Event::onset] < 0.0);
    }
  }
}

TEST_CASE("the end of compression is watched only for laws that need it") {
  const ContactLaw dented{hertzian, PermanentSet{0.7}}, damped{hertzian, HuntCrossley{0.3}};
  Scene scene = wall_scene(dented, damped);
  put(scene, 2e-5, -0.1);
  scene.memory = {.phase = ContactPhase::compressing, .region = 0};
  CHECK(scene.event_functions()[Event::turn] == Approx(0.1));
  scene.memory.region = 1;
  CHECK(scene.event_functions()[Event::turn] == -1.0);
  CHECK(scene.event_functions()[Event::reload] == -1.0);
}

TEST_CASE("passing into a region with another kind of law brings the memory to what it needs") {
  const ContactLaw dented{hertzian, PermanentSet{0.7}}, damped{hertzian, HuntCrossley{0.3}};
  Scene scene = wall_scene(dented, damped);
  put(scene, 2e-5, -0.1, 0.0, -1e-6);
  scene.memory = {.phase = ContactPhase::compressing, .region = 1};
  scene.handle(Event::region_end);
  CHECK(scene.memory.region == 0);
  CHECK(scene.memory.phase == ContactPhase::restituting);
  CHECK(scene.memory.largest_penetration == 2e-5);
  CHECK(scene.memory.permanent_set == Approx(2e-5 * 0.51));
  scene.handle(Event::region_end);
  CHECK(scene.memory.region == 1);
  CHECK(scene.memory.phase == ContactPhase::compressing);
  CHECK(scene.memory.permanent_set == 0.0);
}

TEST_CASE("of two events at one instant the second finds the contact changed and does nothing") {
  Scene scene = wall_scene({linear}, {linear});
  put(scene, -1e-17, -0.2, 0.0, 1e-9);
  scene.memory = {.phase = ContactPhase::compressing, .region = 0};
  scene.handle(Event::release);
  const ContactMemory after = scene.memory;
  scene.handle(Event::region_end);
  scene.handle(Event::turn);
  scene.handle(Event::pull_off);
  scene.handle(Event::forget);
  CHECK(scene.memory == after);
  CHECK(kinds(scene) == "release");
}

TEST_CASE("the number of laws must be the number of regions") {
  CHECK_THROWS_WITH(ContactElement("wall", BodyId{1}, BodyId{2}, std::make_unique<Wall>(),
                                   {ContactLaw{linear}}, 100.0),
                    "contact 'wall': 1 laws are given for 2 regions");
}

TEST_CASE("the corner of a law's formula is passed at an event, either way, and remembered") {
  const LeeWang2 law{.e = 0.5, .q = 3.0, .epsilon = 0.2, .tensile = TensilePhase::clamp};
  Scene scene = wall_scene({linear, law}, {linear, law});
  const double v = 0.2, eps = 0.2 * v / std::sqrt(linear.K / mass);
  put(scene, 0.0, v);
  scene.initialise();
  REQUIRE(scene.memory.phase == ContactPhase::compressing);
  CHECK_FALSE(scene.memory.past_kink);
  for (const bool past : {false, true}) {
    put(scene, 0.999 * eps, v);
    CHECK((scene.event_functions()[Event::kink] < 0.0) == !past);
    put(scene, 1.001 * eps, v);
    CHECK((scene.event_functions()[Event::kink] < 0.0) == past);
    scene.handle(Event::kink);
    CHECK(scene.memory.past_kink == !past);
  }
  // A law without one has no such event.
  Scene plain = wall_scene({linear, HuntCrossley{0.1}}, {linear, HuntCrossley{0.1}});
  put(plain, 0.0, v);
  plain.initialise();
  put(plain, eps, v);
  CHECK(plain.event_functions()[Event::kink] == -1.0);
}

TEST_CASE("lifted, the largest force over the penetration is watched: it may press in between") {
  const LeeWang2 law{.e = 0.1, .q = 3.0, .epsilon = 0.1, .tensile = TensilePhase::clamp};
  Scene scene = wall_scene({linear, law}, {linear, law});
  const double v = 0.2, eps = 0.1 * v / std::sqrt(linear.K / mass);
  put(scene, 0.0, v);
  scene.initialise();
  put(scene, 2.0 * eps, -0.15);
  scene.handle(Event::kink);
  scene.handle(Event::pull_off);
  REQUIRE(scene.memory.phase == ContactPhase::apart);
  REQUIRE(scene.records.back().kind == "release");
  // On the way out the force that is not there pulls, would press, and pulls again before d = 0;
  // between the last two the watch has fired.
  const auto at = [&](double d) {
    put(scene, d, -0.15);
    return scene.event_functions();
  };
  CHECK(at(0.99 * eps)[Event::onset] < 0.0);
  CHECK(at(0.99 * eps)[Event::fullest] < 0.0);
  double pressing = 0.0, fired = 0.0;
  for (double d = 0.99 * eps; d > 0.0; d -= 1e-3 * eps) {
    const std::vector<double> g = at(d);
    if (pressing == 0.0 && g[Event::onset] > 0.0) pressing = d;
    if (fired == 0.0 && g[Event::fullest] > 0.0) fired = d;
  }
  CHECK(pressing > fired);
  CHECK(fired > 0.0);
  CHECK(at(fired)[Event::onset] > 0.0);
  CHECK(at(1e-6 * eps)[Event::onset] < 0.0);
}
