// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A mass on a spring and a damper, driven by a harmonic force, that strikes a stop.
//
//    |          k, c     ____
//    |--/\/\/\/--|  |---|    |   gap   |  stop
//    |                  | m  |---------|
//                       |____|  -> x       F cos(w t)
//
//   m x'' + c x' + k x = F cos(w t),  x < gap;  at the stop contact law, restitution e
//
// Without impacts the steady state is x = A cos(w t - p),
//   A = F / sqrt((k - m w^2)^2 + (c w)^2),   tan p = c w / (k - m w^2)
// which reaches the stop where A = gap: it grazes, and from there on the motion is another. In the limit of
// a rigid stop there are motions with one impact in n periods in closed form (forced_impacts.hpp): between
// impacts x = A cos(w t - p) + exp(-z t) (B cos + C sin), with x = gap at both ends, x' = v_in before and
// -e v_in after.
#include <algorithm>
#include <cmath>

#include <yoke/cases/impacts/forced_impacts.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/prismatic.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

ImpactOscillator oscillator_of(const Parameters& p) {
  const ImpactOscillator c{.mass = p.number("mass"),
                           .spring = p.number("spring"),
                           .damping = p.number("damping"),
                           .force = p.number("force"),
                           .frequency = p.number("frequency"),
                           .gap = p.number("gap"),
                           .restitution = p.number("restitution")};
  const double critical = 2.0 * std::sqrt(c.spring * c.mass);
  if (!(c.damping < critical))
    throw ModelError(
        fmt::format("impact_oscillator: damping = {:g} must be less than the critical {:g} N s/m",
                    c.damping, critical));
  if (p.number("start") > c.gap)
    throw ModelError(fmt::format("impact_oscillator: start = {:g} mm must be at most gap = {:g} mm",
                                 1e3 * p.number("start"), 1e3 * c.gap));
  return c;
}

/// [m] From the fixed end of the spring to the mass at rest: farther than it ever comes.
double spring_length(const ImpactOscillator& c, const Parameters& p) {
  const double w0 = std::sqrt(c.spring / c.mass);
  const double resonance = c.damping > 0.0 ? c.force / (c.damping * w0) : 0.0;
  return 5.0 * (c.gap + std::abs(p.number("start")) + std::abs(p.number("start_speed")) / w0 +
                std::max(c.amplitude(), resonance));
}

Model impact_oscillator_model(const Parameters& p, const WallLaws& laws) {
  const ImpactOscillator c = oscillator_of(p);
  const double length = spring_length(c, p);
  Model m;
  const BodyId mass = m.add(Body{.name = "mass",
                                 .mass = c.mass,
                                 .inertia = 1e-4 * c.mass,
                                 .pose = {{p.number("start"), 0.0}, 0.0},
                                 .twist = {{p.number("start_speed"), 0.0}, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = mass});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = mass,
                            .at_a = {-length, 0.0},
                            .at_b = {p.number("start"), 0.0},
                            .stiffness = c.spring,
                            .damping = c.damping,
                            .free_length = length});
  m.add(AppliedForce{
      .name = "force",
      .body = mass,
      .at = {p.number("start"), 0.0},
      .force = [f = c.force, w = c.omega()](double t) { return Vec2(f * std::cos(w * t), 0.0); }});
  // The stop is a line upwards: the mass is on its left.
  m.add(DiscOnCurve{.name = "stop",
                    .disc = {mass, {p.number("start"), 0.0}, 0.0},
                    .body = ground,
                    .curve = straight_line({c.gap, 0.0}, {0.0, 1.0}),
                    .law = laws["stop"],
                    .reference_force = c.spring * c.gap + c.force});
  return m;
}

std::vector<Check> impact_oscillator_checks(const Parameters& p, const Model&, const Result& run) {
  const ImpactOscillator c = oscillator_of(p);
  std::vector<Check> checks;
  const Eigen::VectorXd t = run["t_s"], x = run["mass.x_m"];
  const bool touched =
      std::ranges::any_of(run.events, [](const EventRecord& e) { return e.kind == "onset"; });
  if (!touched)
    checks.push_back(deviation_check(
        "position off by", run, "mass.x_m", "m", "closed form, no impact", [&](std::size_t i) {
          return c.free_motion(p.number("start"), p.number("start_speed"),
                               t[static_cast<Eigen::Index>(i)]);
        }));
  checks.push_back(energy_check(run));
  return checks;
}

std::vector<CaseParameter> impact_oscillator_parameters() {
  std::vector<CaseParameter> all = {
      mass_parameter("mass", "1", "in kg"),
      {.name = "spring",
       .default_text = "1",
       .low = 1e-6,
       .high = 1e9,
       .description = "stiffness k in N/m"},
      {.name = "damping",
       .default_text = "0.2",
       .low = 0.0,
       .high = 1e6,
       .description = "c in N s/m"},
      {.name = "force", .default_text = "0.3", .low = 0.0, .high = 1e6, .description = "F in N"},
      {.name = "frequency",
       .default_text = "0.3",
       .low = 1e-3,
       .high = 1e4,
       .description = "of the force, in Hz"},
      {.name = "gap",
       .quantity = Quantity::length,
       .default_text = "100mm",
       .low = 0.001_mm,
       .high = 10000.0_mm,
       .description = "from the relaxed spring to the stop"},
      {.name = "start",
       .quantity = Quantity::length,
       .default_text = "0mm",
       .low = -10000.0_mm,
       .high = 10000.0_mm,
       .description = "x at the start, not beyond the gap"},
      {.name = "start_speed",
       .default_text = "0",
       .low = -1e3,
       .high = 1e3,
       .description = "x' at the start, in m/s"},
      {.name = "periods",
       .default_text = "20",
       .low = 0.1,
       .high = 100000.0,
       .description = "of the force, that the run lasts"}};
  for (CaseParameter& p : impact_parameters("1e6", "0.8")) all.push_back(std::move(p));
  return all;
}

}  // namespace

Case impact_oscillator_case() {
  return {
      .name = "impact_oscillator",
      .group = "impacts",
      .description = "a driven mass on a spring strikes a stop: grazing, period doubling, chaos",
      .parameters = impact_oscillator_parameters(),
      .contact =
          impact_laws([](const Parameters&) { return std::vector{flat_wall("stop", 10.0_mm)}; }),
      .default_output = "results/impact_oscillator",
      .model = impact_oscillator_model,
      .duration = [](const Parameters& p) { return p.number("periods") / p.number("frequency"); },
      .checks = impact_oscillator_checks};
}

}  // namespace yoke::cases
