// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The impact pair (Figure 1 of the paper, after Dubowsky and Freudenstein): a mass with clearance
// between two stops of a carrier, which is shaken.
//
//      |  gap          gap  |
//      |<--->( mass )<----->|       carrier at A sin(w t + phi)
//      |____________________|
//
// The motion with two impacts in each period, a period apart on either side, with rigid stops of
// restitution e. The mass leaves the right stop at the phase phi with the velocity V and meets the
// left stop half a period later, where all is the same with the other sign:
//   A sin(phi) + gap + V pi/w = -(A sin(phi) + gap)           flight
//   V - A w cos(phi) = -e (-V - A w cos(phi))                 impact
// so with p = (pi/2) (1 + e)/(1 - e):
//   V = A w cos(phi) (1 + e)/(1 - e)     sin(phi) + p cos(phi) = -gap/A      cos(phi) < 0
//   relative speed of the impacts  -2 A w cos(phi) / (1 - e)
// It exists for gap/A < sqrt(1 + p^2). A disturbance is multiplied, from one impact to the next,
// by a matrix of determinant e^2 and trace 2 e + (1 - e^2) (pi/2) tan(phi): the motion is stable
// while |trace| < 1 + e^2.
#include <algorithm>
#include <cmath>

#include <yoke/cases/impacts/impact_laws.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/prismatic.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

/// The motion with two impacts in each period. Angles of the stable of the two solutions.
struct PeriodicImpacts {
  double e, ratio;  // ratio = gap/A

  double p() const { return 0.5 * pi * (1.0 + e) / (1.0 - e); }
  double largest_ratio() const { return std::hypot(1.0, p()); }
  bool exist() const { return e < 1.0 && ratio < largest_ratio() && std::cos(phase()) < 0.0; }
  double phase() const {
    return std::atan2(1.0, p()) + std::acos(std::max(-1.0, -ratio / largest_ratio()));
  }
  bool stable() const {
    return std::abs(2.0 * e + (1.0 - e * e) * 0.5 * pi * std::tan(phase())) < 1.0 + e * e;
  }
  double velocity() const { return std::cos(phase()) * (1.0 + e) / (1.0 - e); }  // V/(A w)
  double impact_speed() const { return -2.0 * std::cos(phase()) / (1.0 - e); }   // over A w
};

struct ImpactPair {
  double amplitude, gap;  // [m]
  double omega;           // [rad/s]
  double mass;            // [kg]
  double periods;
  bool periodic;  // starts on the periodic motion
  double restitution;
  static constexpr double radius = 10.0_mm;

  explicit ImpactPair(const Parameters& p)
      : amplitude(p.number("amplitude")),
        gap(p.number("gap")),
        omega(2.0 * pi * p.number("frequency")),
        mass(p.number("mass")),
        periods(p.number("periods")),
        periodic(p.word("start") == "periodic"),
        restitution(p.number("restitution")) {
    if (periodic && !motion().exist())
      throw ModelError(fmt::format(
          "impact_pair: start = periodic: gap = {:g} mm must be less than {:g} mm (and the "
          "restitution {:g} less than 1): with more there is no motion of two impacts in each "
          "period; start=centre has no such limit",
          1e3 * gap, restitution < 1.0 ? 1e3 * amplitude * motion().largest_ratio() : 0.0,
          restitution));
  }

  PeriodicImpacts motion() const { return {restitution, gap / amplitude}; }
  double phase() const { return periodic ? motion().phase() : 0.0; }
  double period() const { return 2.0 * pi / omega; }
};

Model impact_pair_model(const ImpactPair& c, const WallLaws& laws) {
  const double phi = c.phase(), A = c.amplitude, w = c.omega;
  const double at = A * std::sin(phi);
  const Vec2 mass_at(c.periodic ? at + c.gap : at, 0.0);
  Model m;
  const BodyId carrier = m.add(Body{.name = "carrier",
                                    .mass = 10.0 * c.mass,
                                    .inertia = c.mass * 1e-2,
                                    .pose = {{at, 0.0}, 0.0},
                                    .twist = {{A * w * std::cos(phi), 0.0}, 0.0}});
  const BodyId mass =
      m.add(Body{.name = "mass",
                 .mass = c.mass,
                 .inertia = 0.5 * c.mass * ImpactPair::radius * ImpactPair::radius,
                 .pose = {mass_at, 0.0},
                 .twist = {{A * w * (c.periodic ? c.motion().velocity() : 1.0), 0.0}, 0.0}});
  m.add(Prismatic{.name = "carrier guide", .a = ground, .b = carrier, .along = {1.0, 0.0}});
  m.add(Prismatic{.name = "mass guide", .a = ground, .b = mass, .along = {1.0, 0.0}});
  m.add(DisplacementDriver{.name = "shaker",
                           .body = carrier,
                           .at = {at, 0.0},
                           .along = {1.0, 0.0},
                           .from = Vec2(0.0, 0.0),
                           .displacement = [A, w, phi](double t) {
                             const double s = std::sin(w * t + phi), k = std::cos(w * t + phi);
                             return TimeValue{A * s, A * w * k, -A * w * w * s};
                           }});
  const double reach = c.gap + ImpactPair::radius;
  for (const double side : {-1.0, 1.0})
    m.add(DiscOnCurve{.name = side < 0.0 ? "left stop" : "right stop",
                      .disc = {mass, mass_at, ImpactPair::radius},
                      .body = carrier,
                      .curve = straight_line({at + side * reach, 0.0}, {0.0, 1.0}),
                      .side = side < 0.0 ? CurveSide::right : CurveSide::left,
                      .law = laws["stop"],
                      .reference_force = c.mass * A * w * w});
  return m;
}

/// Impacts of both stops in the order of time.
std::vector<Impact> impacts_of_pair(const Result& run) {
  std::vector<Impact> all = impacts_of(run, "left stop");
  for (const Impact& i : impacts_of(run, "right stop")) all.push_back(i);
  std::ranges::sort(all, {}, &Impact::start);
  return all;
}

/// The last ten periods beside the motion with rigid stops, if the run settled into it. A contact
/// lasts T in place of nothing: that shifts phases by up to w T, and speeds by as much of A w.
std::vector<Check> impact_pair_checks(const Parameters& p, const Model&, const Result& run) {
  const ImpactPair c(p);
  constexpr std::size_t last = 20;
  const std::vector<Impact> impacts = impacts_of_pair(run);
  std::vector<Check> checks;
  if (impacts.size() > last) {
    const std::vector<Impact> end(impacts.end() - last, impacts.end());
    double approach = 0.0, rebound = 0.0, low = 1e300, high = 0.0, longest = 0.0;
    for (const Impact& i : end) {
      approach += i.approach / last;
      rebound += i.rebound / last;
      low = std::min(low, i.approach);
      high = std::max(high, i.approach);
      longest = std::max(longest, i.end - i.start);
    }
    const PeriodicImpacts rigid{rebound / approach, c.gap / c.amplitude};
    const double settled = (high - low) / high;
    if (settled < 0.01 && rigid.exist() && rigid.stable()) {
      const double speed = c.amplitude * c.omega * rigid.impact_speed();
      checks.push_back(
          {.what = "speed of the last impacts",
           .value = approach,
           .expected = speed,
           .unit = "m/s",
           .tolerance = c.omega * longest * speed + (high - low),
           .remark = fmt::format("rigid stops of the e = {:.5g} that the law delivers", rigid.e)});
      checks.push_back({.what = "periods between every other of them",
                        .value = (end[last - 2].start - end[0].start) * c.omega /
                                 (pi * static_cast<double>(last - 2)),
                        .expected = 1.0,
                        .tolerance = 0.01 / static_cast<double>(last - 2),
                        .remark = "two impacts in each"});
    }
  }
  checks.push_back(energy_check(run));
  return checks;
}

std::vector<CaseParameter> impact_pair_parameters() {
  std::vector<CaseParameter> all = {
      {.name = "amplitude",
       .quantity = Quantity::length,
       .default_text = "1mm",
       .low = 0.001_mm,
       .high = 1000.0_mm,
       .description = "A of the carrier"},
      {.name = "frequency",
       .quantity = Quantity::number,
       .default_text = "20",
       .low = 1e-2,
       .high = 1e4,
       .description = "of the carrier, in Hz"},
      {.name = "gap",
       .quantity = Quantity::length,
       .default_text = "2mm",
       .low = 0.001_mm,
       .high = 1000.0_mm,
       .description = "on each side of the mass in the middle"},
      mass_parameter("mass", "1", "of the mass, in kg"),
      {.name = "start",
       .default_text = "periodic",
       .words = {"periodic", "centre"},
       .description =
           "on the periodic motion with rigid stops, or in the middle, as fast as the carrier"},
      {.name = "periods",
       .quantity = Quantity::number,
       .default_text = "40",
       .low = 0.1,
       .high = 1e5,
       .description = "of the carrier"}};
  for (CaseParameter& p : impact_parameters("1e10", "0.5")) all.push_back(std::move(p));
  return all;
}

}  // namespace

Case impact_pair_case() {
  return {.name = "impact_pair",
          .group = "impacts",
          .description = "a mass with clearance between the stops of a shaken carrier",
          .parameters = impact_pair_parameters(),
          .contact = impact_laws(
              [](const Parameters&) { return std::vector{flat_wall("stop", ImpactPair::radius)}; }),
          .default_output = "results/impact_pair",
          .model = [](const Parameters& p,
                      const WallLaws& laws) { return impact_pair_model(ImpactPair(p), laws); },
          .duration =
              [](const Parameters& p) {
                const ImpactPair c(p);
                return c.periods * c.period();
              },
          .checks = impact_pair_checks};
}

}  // namespace yoke::cases
