// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The same mechanism written in other units, or built at another size: the same events, the same
// digits. Nothing in the engine may know what a metre, a kilogram or a second is.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/dissipative/lankarani_nikravesh_1994.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/revolute.hpp>

namespace {

using namespace yoke;

/// One metre, kilogram and second of the model, in those it is written in.
struct Units {
  double length = 1.0, mass = 1.0, time = 1.0;
  double speed() const { return length / time; }
  double force() const { return mass * length / (time * time); }
  double of_power_law(double n) const { return force() / std::pow(length, n); }
};

enum class Law { elastic, damped, dented };

ContactLaw law_of(Law law, double n, const Units& u) {
  const PowerLaw elastic{(n == 1.0 ? 3e5 : 2e8) * u.of_power_law(n), n};
  if (law == Law::damped) return {elastic, HuntCrossley{0.4 / u.speed()}};
  if (law == Law::dented) return {elastic, LankaraniNikravesh1994{0.8}};
  return {elastic};
}

/// A marble that bounces along a curved slot.
Model marble(const Units& u, Law law, double n) {
  const double m = u.length;
  const Vec2 start(0.3 * std::sin(0.7) * m, -0.3 * std::cos(0.7) * m);  // on the centreline
  Model model;
  const BodyId disc = model.add(Body{.name = "marble",
                                     .mass = 0.2 * u.mass,
                                     .inertia = 5e-6 * u.mass * m * m,
                                     .pose = {start, 0.0},
                                     .twist = {{0.5 * u.speed(), 0.8 * u.speed()}, 1.0 / u.time}});
  model.add(Gravity{.acceleration = {0.0, -9.81 * m / (u.time * u.time)}});
  model.add(PinInSlot{.name = "slot",
                      .pin = {disc, start, 7e-3 * m},
                      .slot = {ground, arc_slot({.radius = 0.3 * m,
                                                 .direction = -0.5 * pi,
                                                 .angle = 2.4,
                                                 .half_width = 9e-3 * m})},
                      .law = law_of(law, n, u),
                      .reference_force = 100.0 * u.force()});
  return model;
}

Result run(const Model& model, const Units& u, const std::string& formulation, double until,
           double rtol) {
  return simulate(model, {.until = until * u.time,
                          .relative_tolerance = rtol,
                          .formulation = formulation,
                          .samples = 11});
}

/// Of the end of a run, in the units of the model.
struct End {
  std::vector<double> numbers;
  std::vector<std::string> kinds;
  long steps = 0;
};

End end_of(const Result& result, const Units& u) {
  End end;
  for (Eigen::Index i = 0; i < result.final.q.size(); ++i) {
    const double size = i % 3 == 2 ? 1.0 : u.length;
    end.numbers.push_back(result.final.q[i] / size);
    end.numbers.push_back(result.final.v[i] / size * u.time);
  }
  for (const EventRecord& e : result.events) {
    end.kinds.push_back(e.kind + e.region);
    end.numbers.push_back(e.t / u.time);
  }
  end.steps = result.summary.steps;
  return end;
}

double largest_difference(const End& a, const End& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.numbers.size(); ++i)
    largest = std::max(largest, std::abs(a.numbers[i] - b.numbers[i]));
  return largest;
}

const std::vector<std::string> every_formulation = {
    "arkode-projection", "arkode-baumgarte", "ida-ggl",          "ida-baumgarte",
    "cvode-projection",  "adams-baumgarte",  "generalised-alpha"};

}  // namespace

TEST_CASE("a marble in a curved slot: units that are powers of two change no bit") {
  for (const std::string& formulation : every_formulation) {
    for (const Law law : {Law::elastic, Law::damped, Law::dented}) {
      const double until = 0.6, rtol = formulation == "generalised-alpha" ? 1e-6 : 1e-9;
      const Units si;
      const Result here = run(marble(si, law, 1.0), si, formulation, until, rtol);
      REQUIRE(here.summary.ok());
      REQUIRE(here.events.size() > 10);
      const End expected = end_of(here, si);
      for (const Units& u :
           {Units{0x1p-20, 1.0, 1.0}, Units{0x1p20, 1.0, 1.0}, Units{1.0, 0x1p-30, 1.0},
            Units{1.0, 0x1p30, 1.0}, Units{1.0, 1.0, 0x1p-20}, Units{1.0, 1.0, 0x1p10},
            Units{0x1p-20, 0x1p-30, 0x1p-20}, Units{0x1p20, 0x1p30, 0x1p10}}) {
        INFO(formulation, " law ", static_cast<int>(law), ": ", u.length, " ", u.mass, " ", u.time);
        const End end = end_of(run(marble(u, law, 1.0), u, formulation, until, rtol), u);
        CHECK(end.kinds == expected.kinds);
        REQUIRE(end.numbers.size() == expected.numbers.size());
        CHECK(largest_difference(end, expected) == 0.0);
        CHECK(end.steps == expected.steps);
      }
    }
  }
}

TEST_CASE("a marble in a curved slot: any units give the same events and digits") {
  for (const std::string& formulation : every_formulation) {
    for (const Law law : {Law::elastic, Law::damped, Law::dented}) {
      const double until = 0.3, rtol = formulation == "generalised-alpha" ? 1e-6 : 1e-11;
      const Units si;
      const Result here = run(marble(si, law, 1.5), si, formulation, until, rtol);
      REQUIRE(here.summary.ok());
      REQUIRE(here.events.size() > 5);
      const End expected = end_of(here, si);
      for (const Units& u : {Units{1e-6, 1.0, 1.0}, Units{1.0, 1e9, 1.0}, Units{1.0, 1.0, 1e-6},
                             Units{1e6, 1e-9, 1e3}}) {
        INFO(formulation, " law ", static_cast<int>(law), ": ", u.length, " ", u.mass, " ", u.time);
        const End end = end_of(run(marble(u, law, 1.5), u, formulation, until, rtol), u);
        CHECK(end.kinds == expected.kinds);
        REQUIRE(end.numbers.size() == expected.numbers.size());
        // Where factors are no powers of two the numbers are rounded otherwise. The first step after
        // an event is chosen from what is rounding, so the steps differ, and their errors, of some
        // hundred tolerances each after the bounces.
        CHECK(largest_difference(end, expected) < 5000.0 * rtol);
      }
    }
  }
}

TEST_CASE("a micromechanism has the events of the machine it is a copy of") {
  // A slot 0.3 um long with 1 nm of clearance, in seconds and in its own time.
  const Units si;
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "generalised-alpha"}) {
    const double rtol = formulation == "generalised-alpha" ? 1e-6 : 1e-9;
    const End expected = end_of(run(marble(si, Law::damped, 1.5), si, formulation, 0.3, rtol), si);
    for (const Units& micro : {Units{1e-6, 1e-18, 1.0}, Units{1e-6, 1e-18, 1e-3}}) {
      INFO(formulation, " ", micro.time);
      const Result result = run(marble(micro, Law::damped, 1.5), micro, formulation, 0.3, rtol);
      REQUIRE(result.summary.ok());
      const End end = end_of(result, micro);
      CHECK(end.kinds == expected.kinds);
      REQUIRE(end.numbers.size() == expected.numbers.size());
      CHECK(largest_difference(end, expected) < 5000.0 * rtol);
    }
  }
}

TEST_CASE("a flight that begins exactly at the wall and ends beyond the other one meets it") {
  // Generalised-alpha flies freely in one step: from a release at zero penetration it passed
  // through the opposite wall, which it had left no longer than its event function was zero.
  const Units u{1e6, 1.0, 1.0};
  Model model = marble(u, Law::elastic, 1.5);
  State state = model.start_state();
  const Vec2 outwards = Vec2(state.q[0], state.q[1]).normalized();
  for (const double share : {0.0, 1e-17, -1e-17}) {
    State start = state;
    start.q.head<2>() += (2e-3 * u.length * (1.0 + share)) * outwards;
    start.v.head<2>() = -5.0 * u.speed() * outwards;
    for (const std::string& formulation : every_formulation) {
      INFO(formulation, " ", share);
      const Result result = simulate(
          model, start,
          {.until = 0.02, .relative_tolerance = 1e-5, .formulation = formulation, .samples = 2});
      REQUIRE(result.summary.ok());
      CHECK(result.events.size() > 20);
    }
  }
}
