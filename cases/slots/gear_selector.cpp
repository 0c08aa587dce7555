// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The selector of a gearbox: a drum turns, its groove moves the pin of a shift fork from one gear to
// the next, and a spring-loaded ball holds the fork in its notch.
//
//      groove, unrolled, moves to the left        fork          ball
//      ___________                               |  |--.    ___
//                 '.       dwell, rise, dwell    |  |   )--(___)/\/\/\|  spring: preload F_0, k
//        pin (o)    '._______                    |  |--'        notches: depth h, one shift apart
//                                                |  |   )
//
// The drum, radius R, turns at constant speed; unrolled, its groove g moves at R Omega. Without
// clearance the fork follows y = g(Omega t). The centre of the ball then moves by X(y), parallel to
// the notched edge, and the pin needs
//   F = m y'' + (F_0 + k (X - X_0) + c X' + m_b X'') dX/dy        (' = d/dt)
//
// What should happen. The ball opposes the shift until half-way and helps in the second half. With
// clearance the pin changes walls there, and the ball throws the fork ahead into its notch.
#include <algorithm>
#include <cmath>

#include <yoke/cases/case.hpp>
#include <yoke/cases/slots/machine_laws.hpp>
#include <yoke/contact/clearance.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/motion_curves.hpp>
#include <yoke/core/curves/smooth_curves.hpp>
#include <yoke/core/motion_laws.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/point_on_curve.hpp>
#include <yoke/joints/prismatic.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

constexpr double pin_radius = 4.0_mm, edge_at = 30.0_mm, spring_room = 40.0_mm;
constexpr double ball_damping = 20.0;                    // [N s/m] of its spring
constexpr double notches_from = -1.6, notches_to = 0.6;  // along the fork, in shifts
constexpr double lead = 20.0_deg;  // of the dwells, left out at both ends of the run

struct GearSelector {
  double shift, drum, angle;                        // [m], [m], [rad] of the rise
  double clearance, depth, ball;                    // [m]
  double preload, stiffness, fork_mass, ball_mass;  // [N], [N/m], [kg]
  double omega;                                     // [rad/s] of the drum
  MotionChain groove;

  explicit GearSelector(const Parameters& p)
      : shift(p.number("shift")),
        drum(p.number("drum")),
        angle(p.number("angle")),
        clearance(p.number("clearance")),
        depth(p.number("depth")),
        ball(p.number("ball")),
        preload(p.number("preload")),
        stiffness(p.number("stiffness")),
        fork_mass(p.number("mass")),
        ball_mass(0.01),
        omega(p.number("speed") * pi / 30.0),
        groove(motion({{dwell, 60.0_deg}, {cycloidal, angle, shift}, {dwell, 60.0_deg}})) {
    const double hollow = 1.0 / (0.5 * depth * std::pow(2.0 * pi / shift, 2));
    if (!(ball < 0.95 * hollow))
      throw ModelError(fmt::format(
          "gear_selector: ball = {:g} mm does not fit into notches of depth = {:g} mm, one shift = "
          "{:g} mm apart; accepted is below {:g} mm",
          1e3 * ball, 1e3 * depth, 1e3 * shift, 950.0 * hollow));
  }

  bool real() const { return clearance > 0.0; }
  double turned(double t) const { return lead + omega * t; }  // of the drum, under the pin
  double duration() const { return (groove.end() - 2.0 * lead) / omega; }
  MotionValue fork(double t) const {
    const MotionValue g = groove(turned(t));
    return {g.value, omega * g.first, omega * omega * g.second};
  }

  /// The notched edge at eta along the fork: x, and derivatives by eta.
  struct Edge {
    double x, first, second;
  };
  Edge edge(double eta) const {
    const double k = 2.0 * pi / shift, half = 0.5 * depth;
    return {edge_at - half * (1.0 + std::cos(k * eta)), half * k * std::sin(k * eta),
            half * k * k * std::cos(k * eta)};
  }
  double force(const MotionValue& y) const;
};

/// F [N], see above.
double GearSelector::force(const MotionValue& y) const {
  // The ball, at -y along the fork, touches the edge at eta; its centre is a radius from there.
  double eta = -y.value;
  for (int i = 0; i < 50; ++i) {
    const Edge e = edge(eta);
    const double root = std::hypot(1.0, e.first), slope = 1.0 - ball * e.second / std::pow(root, 3);
    eta -= (eta - ball * e.first / root + y.value) / slope;
  }
  const Edge e = edge(eta);
  const double root = std::hypot(1.0, e.first), slope = 1.0 - ball * e.second / std::pow(root, 3);
  const double X = e.x + ball / root, X0 = edge_at - depth + ball;
  const double X_y = -e.first, X_yy = e.second / slope;
  const double push = preload + stiffness * (X - X0) + ball_damping * X_y * y.first +
                      ball_mass * (X_y * y.second + X_yy * y.first * y.first);
  return fork_mass * y.second + push * X_y;
}

/// The drum as it is drawn, unrolled: around its groove, down to its guide at `guide`.
std::vector<Vec2> drum_outline(const GearSelector& c, double guide) {
  const double rim = 2.0 * pin_radius + c.clearance;
  const double left = -c.drum * lead - rim, right = c.drum * (c.groove.end() - lead) + rim,
               bottom = guide - pin_radius, top = c.shift + rim;
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

/// The fork as it is drawn: an arm from its pin to the plate with the notches.
std::vector<Vec2> fork_outline(const GearSelector& c) {
  constexpr int parts = 96;
  const double half = 0.6 * pin_radius, back = edge_at - c.depth - 2.0 * half,
               low = notches_from * c.shift, high = notches_to * c.shift;
  std::vector<Vec2> outline = {{-half, -half}, {back, -half}, {back, low}};
  for (int i = 0; i <= parts; ++i) {
    const double eta = low + (high - low) * i / parts;
    outline.emplace_back(c.edge(eta).x, eta);
  }
  for (const Vec2& p : {Vec2(back, high), Vec2(back, half), Vec2(-half, half)})
    outline.push_back(p);
  return outline;
}

Model gear_selector_model(const GearSelector& c, const WallLaws& laws) {
  const ContactLaw& detent = laws["detent"];
  const Vec2 pin(0.0, 0.0);
  constexpr double guide = -50.0_mm;  // [m] height of the drum's
  const Vec2 seat(edge_at - c.depth + c.ball - detent.elastic.penetration_at(c.preload), 0.0);
  Model m;
  const BodyId drum = m.add(Body{.name = "drum",
                                 .mass = 1.0,
                                 .inertia = 1e-3,
                                 .pose = {{0.0, guide}, 0.0},
                                 .twist = {{-c.drum * c.omega, 0.0}, 0.0},
                                 .outline = drum_outline(c, guide)});
  const BodyId fork = m.add(Body{.name = "fork",
                                 .mass = c.fork_mass,
                                 .inertia = 1e-4,
                                 .pose = {pin, 0.0},
                                 .outline = fork_outline(c)});
  const BodyId ball = m.add(Body{.name = "ball",
                                 .mass = c.ball_mass,
                                 .inertia = 0.4 * c.ball_mass * c.ball * c.ball,
                                 .pose = {seat, 0.0}});
  m.add(Prismatic{.name = "drum guide", .a = ground, .b = drum, .along = {1.0, 0.0}});
  m.add(Prismatic{.name = "fork guide", .a = ground, .b = fork, .along = {0.0, 1.0}});
  m.add(Prismatic{.name = "ball guide", .a = ground, .b = ball, .along = {1.0, 0.0}});
  m.add(DisplacementDriver{.name = "motor",
                           .body = drum,
                           .at = {0.0, guide},
                           .displacement = constant_speed(0.0, -c.drum * c.omega)});
  PointOnCurve groove{
      .name = "groove",
      .a = fork,
      .at = pin,
      .b = drum,
      .curve = developed_groove(c.groove, {.origin = {-c.drum * lead, 0.0}, .scale = c.drum})};
  if (c.real())
    groove.clearance =
        SlotClearance{.pin_radius = pin_radius, .radial = c.clearance, .law = laws["groove"]};
  try {
    m.add(groove);
  } catch (const ModelError& error) {
    throw ModelError(fmt::format(
        "gear_selector: drum = {:g} mm and angle = {:g} deg do not suit shift = {:g} mm: {}",
        1e3 * c.drum, c.angle * 180.0 / pi, 1e3 * c.shift, error.what()));
  }
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = ball,
                            .at_a = seat + Vec2(spring_room, 0.0),
                            .at_b = seat,
                            .stiffness = c.stiffness,
                            .damping = ball_damping,
                            .free_length = spring_room + c.preload / c.stiffness});
  m.add(DiscOnCurve{.name = "detent",
                    .disc = {ball, seat, c.ball},
                    .body = fork,
                    .curve = curve_of([&](double eta) { return Vec2(c.edge(eta).x, eta); },
                                      notches_from * c.shift, notches_to * c.shift),
                    .side = CurveSide::right,
                    .law = detent});
  return m;
}

std::vector<Check> gear_selector_checks(const GearSelector& c, const Result& run) {
  const Eigen::VectorXd t = run["t_s"], y = run["fork.y_m"];
  std::vector<Check> checks;
  if (!c.real()) {
    const auto at = [&](std::size_t i) { return c.fork(t[static_cast<Eigen::Index>(i)]).value; };
    checks.push_back(deviation_check("fork off by", run, "fork.y_m", "m", "closed form", at));
    double expected = 0.0;
    for (Eigen::Index i = 0; i < t.size(); ++i)
      expected = std::max(expected, c.force(c.fork(t[i])));
    checks.push_back({.what = "largest force of the shift",
                      .value = run["groove.fy_N"].maxCoeff(),
                      .expected = expected,
                      .unit = "N",
                      .tolerance = 0.02 * expected,
                      .remark = "closed form for a rigid ball"});
  } else {
    const double give = std::max(0.0, run["groove.penetration_m"].maxCoeff());
    const double play = c.clearance + give;
    double beyond = 0.0;
    for (Eigen::Index i = 0; i < t.size(); ++i) {
      const MotionValue g = c.groove(c.turned(t[i]));
      // Along y the slot is wider where the groove is inclined; and the pin touches beside the foot.
      const double along = play * std::hypot(1.0, g.first / c.drum);
      beyond = std::max(beyond, std::abs(y[i] - g.value) - along);
    }
    checks.push_back(
        {.what = "fork farther from the groove than the play, by",
         .value = 1e6 * beyond,
         .unit = "um",
         .tolerance = 1e3 * play,
         .remark = fmt::format("clearance and deepest penetration {:.1f} um", 1e6 * play)});
    checks.push_back({.what = "fork beyond its gear by",
                      .value = 1e6 * std::max(0.0, y.maxCoeff() - c.shift),
                      .unit = "um",
                      .tolerance = 1e6 * play,
                      .remark = "overshoot; the play"});
  }
  checks.push_back({.what = "fork at the end",
                    .value = 1e3 * y[y.size() - 1],
                    .expected = 1e3 * c.shift,
                    .unit = "mm",
                    .tolerance = 1e3 * (c.clearance + 1e-6 * c.shift),
                    .remark = "in its notch"});
  checks.push_back(energy_check(run));
  return checks;
}

}  // namespace

Case gear_selector_case() {
  return {
      .name = "gear_selector",
      .group = "slots and cams",
      .description = "selector drum of a gearbox: groove, fork, and a ball that holds the gear",
      .parameters = {{.name = "clearance",
                      .quantity = Quantity::length,
                      .default_text = "0.1mm",
                      .low = 0.0,
                      .high = 1.0_mm,
                      .description =
                          "of a pin of 4 mm in the groove, to each side; 0: held in its middle"},
                     {.name = "shift",
                      .quantity = Quantity::length,
                      .default_text = "10mm",
                      .low = 1.0_mm,
                      .high = 100.0_mm,
                      .description = "from gear to gear, also of the notches"},
                     {.name = "drum",
                      .quantity = Quantity::length,
                      .default_text = "25mm",
                      .low = 5.0_mm,
                      .high = 500.0_mm,
                      .description = "radius"},
                     {.name = "angle",
                      .quantity = Quantity::angle,
                      .default_text = "60deg",
                      .low = 10.0_deg,
                      .high = 180.0_deg,
                      .description = "of the drum for the shift"},
                     {.name = "depth",
                      .quantity = Quantity::length,
                      .default_text = "1.5mm",
                      .low = 0.01_mm,
                      .high = 50.0_mm,
                      .description = "of the notches"},
                     {.name = "ball",
                      .quantity = Quantity::length,
                      .default_text = "2.5mm",
                      .low = 0.1_mm,
                      .high = 100.0_mm,
                      .description = "radius, less than that of the notches"},
                     {.name = "preload",
                      .quantity = Quantity::number,
                      .default_text = "40",
                      .low = 0.01,
                      .high = 1e5,
                      .description = "of the ball in a notch, in N"},
                     {.name = "stiffness",
                      .quantity = Quantity::number,
                      .default_text = "5000",
                      .low = 1.0,
                      .high = 1e6,
                      .description = "of the ball's spring, in N/m"},
                     {.name = "mass",
                      .quantity = Quantity::number,
                      .default_text = "0.3",
                      .low = 1e-3,
                      .high = 100.0,
                      .description = "of the fork, in kg; the ball has 10 g"},
                     {.name = "speed",
                      .quantity = Quantity::number,
                      .default_text = "100",
                      .low = 2.0,
                      .high = 1e4,
                      .description = "of the drum, in revolutions per minute"}},
      .contact = machine_laws([](const Parameters& p) {
        const GearSelector c(p);
        std::vector<Wall> walls = {nearly_flat_wall("detent", c.ball)};
        if (c.real()) walls.push_back(nearly_flat_wall("groove", pin_radius));
        return walls;
      }),
      .default_output = "results/gear_selector",
      .model = [](const Parameters& p,
                  const WallLaws& laws) { return gear_selector_model(GearSelector(p), laws); },
      .duration = [](const Parameters& p) { return GearSelector(p).duration(); },
      .checks = [](const Parameters& p, const Model&,
                   const Result& run) { return gear_selector_checks(GearSelector(p), run); }};
}

}  // namespace yoke::cases
