// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the shape of a slot costs: the paper's scotch-yoke with its circular slot as arc_slot, and
// the same slot as a curve: one arc, a chain of eight arcs, a spline through 200 points. All follow
// the same motion. And what friction costs in it. They are run in turn; the counters are medians over
// the rounds:
//   ratio             time per evaluation of the equations, that of arc_slot is 1
//   run_ratio         time of the run
//   evaluations       of the run
//   step_ratio        steps under Coulomb's law over those of the law rounded off at 1e-3 m/s
// aims: one arc 1.1, eight arcs 1.3, spline 1.5; friction without a state 1.2; step_ratio 1
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/geometry/curve_slot.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/friction/brown_mcphee.hpp>
#include <yoke/contact/laws/friction/coulomb.hpp>
#include <yoke/contact/laws/friction/lugre.hpp>
#include <yoke/contact/laws/friction/regularised_coulomb.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/curves/smooth_curves.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

namespace {

using namespace yoke;
using Clock = std::chrono::steady_clock;

constexpr double r = 0.045, R = 0.060, half_width = 8e-3, opening = 2.0 * pi / 3.0;
constexpr double omega = 24.0 * pi, start = -31.0 * pi / 180.0;
constexpr int rounds = 15;

/// From the angle `from` over the whole slot, about the centre.
Vec2 on_arc(const Vec2& center, double share) {
  const double a = pi - 0.5 * opening + share * opening;
  return center + R * Vec2(std::cos(a), std::sin(a));
}

Slot as_arc_slot(const Vec2& center) {
  return arc_slot(
      {.center = center, .radius = R, .direction = pi, .angle = opening, .half_width = half_width});
}
Slot as_arcs(const Vec2& center, int pieces) {
  std::vector<Curve> arcs;
  for (int i = 0; i < pieces; ++i)
    arcs.push_back(circular_arc({.center = center,
                                 .radius = R,
                                 .start = pi - 0.5 * opening + opening * i / pieces,
                                 .angle = opening / pieces}));
  return curve_slot({.centreline = chain(arcs), .half_width = half_width});
}
Slot as_spline(const Vec2& center) {
  std::vector<Vec2> points;
  for (int i = 0; i < 200; ++i) points.push_back(on_arc(center, i / 199.0));
  return curve_slot({.centreline = curve_through(points), .half_width = half_width});
}

Model yoke_with(const std::function<Slot(const Vec2&)>& slot, const FrictionLaw& friction = {}) {
  const double root = std::sqrt(R * R - std::pow(r * std::sin(start), 2));
  const double x = r * std::cos(start) + root;
  const double v = -r * std::sin(start) * (1.0 + r * std::cos(start) / root) * omega;
  Model m;
  const BodyId crank = m.add({.name = "crank",
                              .mass = 0.105,
                              .inertia = 3.04e-5,
                              .pose = {{0.0, 0.0}, start},
                              .twist = {{0.0, 0.0}, omega}});
  const BodyId slider = m.add({.name = "slider",
                               .mass = 2.353,
                               .inertia = 3.4956e-3,
                               .pose = {{x, 0.0}, 0.0},
                               .twist = {{v, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(start, omega)});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
  m.add(PinInSlot{.name = "slot",
                  .pin = {crank, rotate(start, Vec2(r, 0.0)), 7.9e-3},
                  .slot = {slider, slot({x, 0.0})},
                  .law = ContactLaw{per_mm(4.907e4, 1.10), HuntCrossley{0.32}, friction}});
  return m;
}

struct Timed {
  double seconds = 0.0;
  long evaluations = 0;
};
Timed timed_run(const Model& model) {
  const auto began = Clock::now();
  const Result run =
      simulate(model, {.until = 4.0 * pi / omega, .relative_tolerance = 1e-8, .samples = 2});
  return {std::chrono::duration<double>(Clock::now() - began).count(), run.summary.evaluations};
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

void compare(benchmark::State& state, const Model& model) {
  const Model reference = yoke_with(as_arc_slot);
  std::vector<double> per_evaluation, per_run;
  long evaluations = 0;
  for (auto _ : state)
    for (int i = 0; i < rounds; ++i) {
      const Timed a = timed_run(reference), b = timed_run(model);
      per_evaluation.push_back(b.seconds / static_cast<double>(b.evaluations) /
                               (a.seconds / static_cast<double>(a.evaluations)));
      per_run.push_back(b.seconds / a.seconds);
      evaluations = b.evaluations;
    }
  state.counters["ratio"] = median(per_evaluation);
  state.counters["run_ratio"] = median(per_run);
  state.counters["evaluations"] = static_cast<double>(evaluations);
}

void slot_shape(benchmark::State& state, const std::function<Slot(const Vec2&)>& slot) {
  compare(state, yoke_with(slot));
}
void friction(benchmark::State& state, const FrictionLaw& law) {
  compare(state, yoke_with(as_arc_slot, law));
}

/// A block pulled by a spring on a belt that moves: it sticks and slips, or creeps to rest.
Model on_belt(double belt, const FrictionLaw& friction) {
  constexpr double g = 9.81, height = 0.05;
  const double depth = std::pow(g / 1e8, 2.0 / 3.0);
  Model m;
  const BodyId block =
      m.add({.name = "block", .mass = 1.0, .inertia = 0.01, .pose = {{0.03, height - depth}, 0.0}});
  m.add(AngleDriver{.name = "upright", .body = block, .angle = constant(0.0)});
  m.add(Gravity{});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = block,
                            .at_a = {-0.5, height - depth},
                            .at_b = {0.03, height - depth},
                            .stiffness = 100.0,
                            .free_length = 0.5});
  m.add(DiscOnCurve{.name = "belt",
                    .disc = {block, {0.03, -depth}, 0.0},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = ContactLaw{PowerLaw{1e8, 1.5}, HuntCrossley{10.0}, friction},
                    .surface_speed = belt,
                    .reference_force = g});
  return m;
}
void dry_friction(benchmark::State& state, const std::function<Model(const FrictionLaw&)>& model,
                  double until) {
  const auto steps = [&](const FrictionLaw& law) {
    const SimulationOptions options{.until = until, .relative_tolerance = 1e-8, .samples = 2};
    return static_cast<double>(simulate(model(law), options).summary.steps);
  };
  double dry = 0.0, smooth = 1.0;
  for (auto _ : state) {
    dry = steps(Coulomb{.mu = 0.2, .mu_static = 0.2});
    smooth = steps(RegularisedCoulomb{.mu = 0.2, .threshold = 1e-3});
  }
  state.counters["steps"] = dry;
  state.counters["step_ratio"] = dry / smooth;
}

BENCHMARK_CAPTURE(slot_shape, arc_slot, as_arc_slot)->Iterations(1);
BENCHMARK_CAPTURE(slot_shape, one_arc, [](const Vec2& c) { return as_arcs(c, 1); })->Iterations(1);
BENCHMARK_CAPTURE(slot_shape, eight_arcs, [](const Vec2& c) {
  return as_arcs(c, 8);
})->Iterations(1);
BENCHMARK_CAPTURE(slot_shape, spline_200, as_spline)->Iterations(1);
BENCHMARK_CAPTURE(friction, coulomb, Coulomb{.mu = 0.1, .mu_static = 0.1})->Iterations(1);
BENCHMARK_CAPTURE(friction, regularised_coulomb, RegularisedCoulomb{.mu = 0.1})->Iterations(1);
BENCHMARK_CAPTURE(friction, brown_mcphee, BrownMcPhee{.mu = 0.1, .mu_static = 0.12})->Iterations(1);
BENCHMARK_CAPTURE(friction, lugre, LuGre{.mu = 0.1, .mu_static = 0.12, .stiffness = 1e6})
    ->Iterations(1);
BENCHMARK_CAPTURE(
    dry_friction, scotch_yoke, [](const FrictionLaw& f) { return yoke_with(as_arc_slot, f); },
    4.0 * pi / omega)
    ->Iterations(1);
BENCHMARK_CAPTURE(
    dry_friction, oscillator_at_rest, [](const FrictionLaw& f) { return on_belt(0.0, f); }, 5.0)
    ->Iterations(1);
BENCHMARK_CAPTURE(
    dry_friction, oscillator_on_belt, [](const FrictionLaw& f) { return on_belt(0.1, f); }, 5.0)
    ->Iterations(1);

}  // namespace
