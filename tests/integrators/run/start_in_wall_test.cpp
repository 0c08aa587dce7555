// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Runs that begin with a body inside a wall: the impact that would have led there goes on.
#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <string>

#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/forms/proportional_damping.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/revolute.hpp>

#include <yoke/tests/integrators/wall.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

constexpr double mass = 1.3, deep = 1e-3;  // [kg, m]

double exponent_for(const std::string& law) {  // some laws are meant for a linear spring
  return law == "lee-wang-2" || law == "kelvin-voigt" ? 1.0 : 1.5;
}

bool leaves_a_dent(const std::string& law) {
  return law == "lankarani-nikravesh-1994" || law == "gharib-hurmuzlu-2";
}

ContactLaw law_of(const std::string& name, double n, double e) {
  return {PowerLaw{n == 1.0 ? 3e6 : 1e8, n}, make_dissipative(name, {.restitution = e})};
}

/// A ball `depth` inside the floor without any load.
Model pressed_ball(const ContactLaw& law, double depth, double rate) {
  Model m;
  const BodyId ball = m.add(Body{.name = "ball",
                                 .mass = mass,
                                 .inertia = 1.0,
                                 .pose = {{0.0, -depth}, 0.0},
                                 .twist = {{0.0, -rate}, 0.0}});
  m.add(Wall{.name = "floor", .body = ball, .law = law});
  return m;
}

Result run_until_free(const Model& model, const std::string& formulation = "automatic") {
  return simulate(
      model, {.until = 0.1, .relative_tolerance = 1e-10, .formulation = formulation, .samples = 3});
}

}  // namespace

TEST_CASE("a ball at rest deep in the floor leaves it as after the impact that led there") {
  for (const DissipativeNote& note : dissipative_catalog()) {
    const double n = exponent_for(note.name);
    for (const double e : {0.9, 0.5}) {
      INFO(note.name, " e = ", e);
      const Model model = pressed_ball(law_of(note.name, n, e), deep, 0.0);
      const Result run = run_until_free(model);
      REQUIRE(run.summary.ok());
      CHECK(run.summary.steps < 500);  // 186 000 with the damping of the slowest approach
      CHECK(run.final.contacts[0].phase == ContactPhase::apart);
      if (leaves_a_dent(note.name)) {  // the line of unloading returns e^2 of what was stored there
        const double U = law_of(note.name, n, e).elastic.response(deep).energy;
        CHECK(run.final.v[1] == Approx(e * std::sqrt(2.0 * U / mass)).epsilon(1e-7));
        continue;
      }
      const double v_i = run.final.contacts[0].approach_velocity;
      CHECK(v_i > 0.0);
      if (const std::optional<double> expected =
              closed_form_restitution(note.name, {.restitution = e}, n, v_i))
        CHECK(run.final.v[1] == Approx(*expected * v_i).epsilon(1e-7));
    }
  }
}

TEST_CASE("the approach that is assumed has the closed form of damping in proportion") {
  for (const double e : {0.95, 0.7, 0.3, 0.05}) {
    INFO("e = ", e);
    const double X = damping_for_restitution(e);
    const ContactLaw law = law_of("gonthier", 1.5, e);
    const Result run = run_until_free(pressed_ball(law, deep, 0.0));
    REQUIRE(run.summary.ok());
    // m v^2 u du/(1 + X u) = -F dd from u = 1 at the touch to u = 0 at the depth.
    const double U = law.elastic.response(deep).energy;
    const double v_i = std::sqrt(U / mass / ((X - std::log1p(X)) / (X * X)));
    CHECK(run.final.contacts[0].approach_velocity == Approx(v_i).epsilon(1e-9));
    CHECK(run.final.v[1] == Approx(e * v_i).epsilon(1e-7));
  }
  // Without dissipation it is that of the energy, whatever the present rate.
  for (const double rate : {-1.0, 0.0, 2.0}) {
    const ContactLaw law{PowerLaw{1e8, 1.5}};
    const Result run = run_until_free(pressed_ball(law, deep, rate));
    const double U = law.elastic.response(deep).energy;
    CHECK(run.final.contacts[0].approach_velocity ==
          Approx(std::sqrt(rate * rate + 2.0 * U / mass)).epsilon(1e-9));
  }
}

TEST_CASE("a run that takes up an impact anywhere, without its memory, ends as an impact does") {
  for (const DissipativeNote& note : dissipative_catalog()) {
    if (leaves_a_dent(note.name)) continue;  // known to the memory alone
    const double v_i = 0.7;
    const ContactLaw law = law_of(note.name, exponent_for(note.name), 0.6);
    const auto thrown = [&](double speed, double until) {
      const Result run = simulate(pressed_ball(law, -1e-6, speed),
                                  {.until = until, .relative_tolerance = 1e-11, .samples = 2});
      REQUIRE(run.summary.ok());
      return run;
    };
    const Result whole = thrown(v_i, 0.02);
    const double onset = whole.events.front().t, release = whole.events.back().t;
    for (const double share : {0.2, 0.4, 0.6, 0.8}) {
      INFO(note.name, " at ", share);
      const Result part = thrown(v_i, onset + share * (release - onset));
      const double depth = -part.final.q[1], rate = -part.final.v[1];
      const Result rest = run_until_free(pressed_ball(law, depth, rate));
      REQUIRE(rest.summary.ok());
      const double found = rest.final.contacts[0].approach_velocity;
      if (rate >= 0.0) {
        CHECK(found == Approx(v_i).epsilon(1e-7));
        CHECK(rest.final.v[1] == Approx(whole.final.v[1]).epsilon(1e-7));
      }
      // On the way out more than one impact may pass there. The one taken does.
      CHECK(rest.final.v[1] == Approx(thrown(found, 0.02).final.v[1]).epsilon(1e-6));
    }
  }
}

TEST_CASE("a run says once that it has assumed an approach, and only then") {
  const ContactLaw law = law_of("flores", 1.5, 0.5);
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "generalised-alpha"}) {
    INFO(formulation);
    const Result run = simulate(
        pressed_ball(law, deep, 0.0),
        {.until = 0.1, .relative_tolerance = 1e-6, .formulation = formulation, .samples = 3});
    REQUIRE(run.summary.ok());
    REQUIRE(run.summary.notes.size() == 1);
    CHECK(run.summary.notes[0].starts_with(
        "'floor': starts 0.001 m deep in the wall at a rate of 0 m/s; its approach velocity is "
        "taken to be "));
    CHECK(to_json(run.summary).find("deep in the wall") != std::string::npos);
  }
  CHECK(run_until_free(pressed_ball(law, -1e-6, 0.3)).summary.notes.empty());
}
