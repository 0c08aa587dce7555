// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A disc cam lifts a follower with a roller, which a spring presses on it.
//
//        |/\/\/|  spring: stiffness k, preload F_0 at the lowest place
//        [     ]  follower, mass m, guided along y
//         (   )   roller, radius r_r
//        .-'-'-.
//       ( cam + ) Omega     lift s(theta): dwell, rise, dwell, return
//        '-...-'            base radius r_b
//
// Without contact mechanics y = s(Omega t). The follower pushes on the cam, along y, with
//   F = m Omega^2 s'' + k s + F_0
// and leaves it where F would be < 0: from the jump speed on,
//   Omega_j^2 = least (k s + F_0)/(-m s'') over all angles with s'' < 0
//
// What should happen. Below the jump speed the follower stays on the cam and the contact gives by
// micrometres. Above, it flies over the top of the rise and comes down beside the law: impacts, bounces.
#include <algorithm>
#include <cmath>

#include <yoke/cases/case.hpp>
#include <yoke/cases/slots/machine_laws.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/motion_curves.hpp>
#include <yoke/core/motion_laws.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/point_on_curve.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

constexpr double spring_length = 0.1;  // [m] at the lowest place

/// The laws of motion that start and end at rest, by their names in the library.
struct CamLaw {
  const char* name;
  const MotionLaw& law;
};
constexpr CamLaw cam_laws[] = {
    {"simple_harmonic", simple_harmonic}, {"cycloidal", cycloidal},
    {"modified_sine", modified_sine},     {"modified_trapezoid", modified_trapezoid},
    {"polynomial_345", polynomial_345},   {"polynomial_4567", polynomial_4567}};

std::vector<std::string> cam_law_names() {
  std::vector<std::string> names;
  for (const CamLaw& law : cam_laws) names.emplace_back(law.name);
  return names;
}

MotionLaw cam_law(const std::string& name) {
  return std::ranges::find(cam_laws, name, &CamLaw::name)->law;
}

struct CamFollower {
  bool ideal;
  double base, roller;              // [m]
  double mass, stiffness, preload;  // [kg], [N/m], [N]
  double omega, turns;              // [rad/s]
  MotionChain lift;

  explicit CamFollower(const Parameters& p)
      : ideal(p.word("joint") == "ideal"),
        base(p.number("base")),
        roller(p.number("roller")),
        mass(p.number("mass")),
        stiffness(p.number("stiffness")),
        preload(p.number("preload")),
        omega(p.number("speed") * pi / 30.0),
        turns(p.number("turns")),
        lift(lift_of(p)) {}

  static MotionChain lift_of(const Parameters& p) {
    const double rise = p.number("rise"), top = p.number("top"), fall = p.number("return");
    const double rest = 2.0 * pi - rise - top - fall;
    if (!(rest > 0.01 * pi))
      throw ModelError(fmt::format(
          "cam_follower: rise, top and return = {:g} deg together must be less than 358.2 deg, to "
          "leave a rest",
          (rise + top + fall) * 180.0 / pi));
    const MotionLaw law = cam_law(p.word("law"));
    return motion({{dwell, rest}, {law, rise, p.number("lift")}, {dwell, top}, {law, fall, 0.0}},
                  {.repeat = Repeat::periodic});
  }

  DiscCam cam() const {
    return {.direction = 0.5 * pi, .base_radius = base, .roller_radius = roller};
  }
  /// [N] along y, that the ideal follower needs from the cam.
  double force(double angle) const {
    const MotionValue s = lift(angle);
    return mass * omega * omega * s.second + stiffness * s.value + preload;
  }
  double jump_speed() const;
  double steadiness() const;
};

/// Omega_j [rad/s].
double CamFollower::jump_speed() const {
  constexpr int parts = 40000;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < parts; ++k) {
    const MotionValue s = lift(2.0 * pi * (k + 0.5) / parts);
    if (s.second < 0.0)
      least = std::min(least, (stiffness * s.value + preload) / (-mass * s.second));
  }
  return std::sqrt(least);
}

/// The least force of a turn over the largest.
double CamFollower::steadiness() const {
  constexpr int parts = 4000;
  double least = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (int k = 0; k < parts; ++k) {
    const double F = force(2.0 * pi * (k + 0.5) / parts);
    least = std::min(least, F);
    largest = std::max(largest, F);
  }
  return least / largest;
}

/// The cam as asked for, or a message that names the parameters that make it.
Curve cam_curve(const CamFollower& c) {
  try {
    return c.ideal ? cam_pitch_curve(c.lift, c.cam()) : cam_profile(c.lift, c.cam());
  } catch (const ModelError& error) {
    throw ModelError(fmt::format(
        "cam_follower: base = {:g} mm and roller = {:g} mm do not suit lift, rise and return: {}",
        1e3 * c.base, 1e3 * c.roller, error.what()));
  }
}

Model cam_follower_model(const CamFollower& c, const WallLaws& laws) {
  Vec2 at(0.0, c.base + c.roller);
  if (!c.ideal) at.y() -= laws["cam"].elastic.penetration_at(c.preload);
  Model m;
  const BodyId cam =
      m.add(Body{.name = "cam", .mass = 1.0, .inertia = 1e-3, .twist = {{0.0, 0.0}, c.omega}});
  const BodyId follower =
      m.add(Body{.name = "follower", .mass = c.mass, .inertia = 1e-4 * c.mass, .pose = {at, 0.0}});
  m.add(Revolute{.name = "bearing", .a = ground, .b = cam, .at = {0.0, 0.0}});
  m.add(AngleDriver{.name = "motor", .body = cam, .angle = constant_speed(0.0, c.omega)});
  m.add(Prismatic{.name = "guide", .a = ground, .b = follower, .along = {0.0, 1.0}});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = follower,
                            .at_a = at + Vec2(0.0, spring_length),
                            .at_b = at,
                            .stiffness = c.stiffness,
                            .free_length = spring_length + c.preload / c.stiffness});
  if (c.ideal)
    m.add(
        PointOnCurve{.name = "contact", .a = follower, .at = at, .b = cam, .curve = cam_curve(c)});
  else
    m.add(DiscOnCurve{.name = "contact",
                      .disc = {follower, at, c.roller},
                      .body = cam,
                      .curve = cam_curve(c),
                      .law = laws["cam"]});
  return m;
}

std::vector<Check> cam_follower_checks(const CamFollower& c, const Result& run) {
  const Eigen::VectorXd t = run["t_s"], y = run["follower.y_m"];
  const auto angle = [&](std::size_t i) { return c.omega * t[static_cast<Eigen::Index>(i)]; };
  std::vector<Check> checks;
  const auto lift = [&](std::size_t i) { return c.base + c.roller + c.lift(angle(i)).value; };
  const double jump = c.jump_speed(), part = c.omega / jump;
  const std::string remark = fmt::format("jump speed {:.6g} rpm", jump * 30.0 / pi);
  if (c.ideal) {
    checks.push_back(deviation_check("lift off by", run, "follower.y_m", "m", "closed form", lift));
    checks.push_back(deviation_check("force of the cam off by", run, "contact.fy_N", "N",
                                     "closed form; " + remark,
                                     [&](std::size_t i) { return c.force(angle(i)); }));
    checks.push_back(energy_check(run));
    return checks;
  }
  const auto lost =
      std::ranges::count_if(run.events, [](const EventRecord& e) { return e.kind == "release"; });
  // Close to the jump speed the contact's own vibration decides, and where the force that is left at
  // the lowest is small beside the largest, which the vibration is of.
  const bool stays = part < 0.9 && c.steadiness() > 0.01, flies = part > 1.1 && c.turns >= 1.0;
  if (stays || flies)
    checks.push_back({.what = "follower leaves the cam (1: yes)",
                      .value = lost > 0 ? 1.0 : 0.0,
                      .expected = flies ? 1.0 : 0.0,
                      .remark = remark});
  double under = 0.0, over = 0.0;
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    const double off = y[i] - lift(static_cast<std::size_t>(i));
    under = std::max(under, -off);
    over = std::max(over, off);
  }
  const double deepest = run["contact.penetration_m"].maxCoeff();
  checks.push_back({.what = "follower below its law by",
                    .value = 1e6 * under,
                    .unit = "um",
                    .tolerance = 1.5e6 * deepest,
                    .remark = "1.5 times the deepest penetration, as walls are inclined"});
  if (stays)
    checks.push_back({.what = "follower above its law by",
                      .value = 1e6 * over,
                      .unit = "um",
                      .tolerance = 1e-3,
                      .remark = "it stays on the cam"});
  checks.push_back(energy_check(run));
  return checks;
}

CaseParameter angle_of(const char* name, const char* value, const char* description) {
  return {.name = name,
          .quantity = Quantity::angle,
          .default_text = value,
          .low = 5.0_deg,
          .high = 340.0_deg,
          .description = description};
}

}  // namespace

Case cam_follower_case() {
  return {
      .name = "cam_follower",
      .group = "slots and cams",
      .description = "disc cam and roller follower with a spring: the speed at which it jumps",
      .parameters = {{.name = "joint",
                      .default_text = "contact",
                      .words = {"ideal", "contact"},
                      .description =
                          "roller on the profile, or its centre held on the pitch curve"},
                     {.name = "law",
                      .default_text = "cycloidal",
                      .words = cam_law_names(),
                      .description = "of rise and return"},
                     {.name = "lift",
                      .quantity = Quantity::length,
                      .default_text = "10mm",
                      .low = 0.1_mm,
                      .high = 1000.0_mm,
                      .description = "of the follower"},
                     angle_of("rise", "90deg", "of the cam, for the rise"),
                     angle_of("top", "60deg", "for the dwell at the top"),
                     angle_of("return", "90deg",
                              "for the return; a dwell at the bottom takes the rest"),
                     {.name = "base",
                      .quantity = Quantity::length,
                      .default_text = "30mm",
                      .low = 1.0_mm,
                      .high = 1000.0_mm,
                      .description = "radius of the profile where the lift is 0"},
                     {.name = "roller",
                      .quantity = Quantity::length,
                      .default_text = "8mm",
                      .low = 0.5_mm,
                      .high = 500.0_mm,
                      .description = "radius"},
                     {.name = "mass",
                      .quantity = Quantity::number,
                      .default_text = "0.5",
                      .low = 1e-3,
                      .high = 1000.0,
                      .description = "of the follower, in kg"},
                     {.name = "stiffness",
                      .quantity = Quantity::number,
                      .default_text = "5000",
                      .low = 1.0,
                      .high = 1e7,
                      .description = "of the spring, in N/m"},
                     {.name = "preload",
                      .quantity = Quantity::number,
                      .default_text = "100",
                      .low = 0.1,
                      .high = 1e6,
                      .description = "of the spring at the lowest place, in N"},
                     {.name = "speed",
                      .quantity = Quantity::number,
                      .default_text = "1200",
                      .low = 1.0,
                      .high = 1e5,
                      .description = "of the cam, in revolutions per minute"},
                     {.name = "turns",
                      .quantity = Quantity::number,
                      .default_text = "3",
                      .low = 0.01,
                      .high = 10000.0,
                      .description = "of the cam"}},
      .contact = machine_laws([](const Parameters& p) {
        if (p.word("joint") == "ideal") return std::vector<Wall>{};
        return std::vector<Wall>{
            {.name = "cam",
             .pair = {.pin_radius = p.number("roller"), .wall_radius = p.number("base")},
             .length = 10.0_mm}};
      }),
      .default_output = "results/cam_follower",
      .model = [](const Parameters& p,
                  const WallLaws& laws) { return cam_follower_model(CamFollower(p), laws); },
      .duration = [](const Parameters& p) { return p.number("turns") * 60.0 / p.number("speed"); },
      .checks = [](const Parameters& p, const Model&,
                   const Result& run) { return cam_follower_checks(CamFollower(p), run); }};
}

}  // namespace yoke::cases
