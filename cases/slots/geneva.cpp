// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// An external Geneva drive: the pin of a driver that turns at constant speed enters a slot of the
// wheel, turns it by one n-th of a turn and leaves. In between a disc on the driver locks the wheel.
//
//                    ___  o tip             D   axis of the driver, origin
//       driver  .-'''   \ /                 W   axis of the wheel, at C = r/sin(pi/n)
//             .'  disc   ) lobe             P   pin at r, enters a slot along it: no jump of speed
//            |    D(+)   )     slot ====W(+)
//             '. R_l     )                  alpha  of the pin, from the line D-W
//               '-.___  / \                 the pin is in a slot for |alpha| < alpha_0
//                 P(o)   o tip              alpha_0 = pi/2 - pi/n
//
// The wheel, while the pin is in a slot, x = r/C = sin(pi/n):
//   beta    = atan2(x sin(alpha), 1 - x cos(alpha)),  against the driver
//   beta'   = (x cos(alpha) - x^2)/(1 + x^2 - 2 x cos(alpha)) Omega
// Contacts: the pin in each of n slots, round at the root, open at the rim; the two tips of each lobe
// on the driver's disc; the two ends of the disc's rim on the hollow of each lobe. The disc is cut away for
// |alpha| < alpha_0 about the pin, so that its rim ends on the line D-W when the pin enters: one end
// holds the wheel until then, and the other end from when the pin leaves. Ends and tips are rounded.
//
// The first entry finds the wheel at rest in the middle of its play. The pin goes aside by
// r (1 - cos(e)) in the angle e after alpha_0, until it has crossed the clearance c:
//   impact at  cos(e) = 1 - c/r,  with the speed r Omega sin(e) = Omega sqrt(2 r c - c^2)
//
// What should happen. Exactly one index for each turn, and the wheel within its play in between. In
// the middle of the index the wheel is slowed down, and the pin goes over to the other wall.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include <yoke/cases/case.hpp>
#include <yoke/cases/slots/machine_laws.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/contact/geometry/curve_slot.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

constexpr double rounding = 0.5_mm;  // radius of tips, of the ends of the disc, of the slots' edges

struct Geneva {
  bool ideal;
  int slots, turns;
  double crank, pin, clearance, lock_gap;  // [m]
  double omega, inertia, drag;             // [rad/s], [kg m^2], [N m s/rad]

  explicit Geneva(const Parameters& p)
      : ideal(p.word("joint") == "ideal"),
        slots(p.whole("slots")),
        turns(p.whole("turns")),
        crank(p.number("crank")),
        pin(p.number("pin")),
        clearance(p.number("clearance")),
        lock_gap(p.number("lock_gap")),
        omega(p.number("speed") * pi / 30.0),
        inertia(p.number("inertia")),
        drag(p.number("drag")) {
    if (!(pin <= 0.15 * crank))
      throw ModelError(
          fmt::format("geneva: pin = {:g} mm is too large for crank = {:g} mm; accepted is up to "
                      "0.15 times the crank, {:g} mm",
                      1e3 * pin, 1e3 * crank, 150.0 * crank));
    for (const auto& [name, gap] : {std::pair{"clearance", clearance}, {"lock_gap", lock_gap}})
      if (!(gap <= 0.2 * pin))
        throw ModelError(
            fmt::format("geneva: {} = {:g} mm is too large for pin = {:g} mm; accepted is up to "
                        "0.2 times the pin, {:g} mm",
                        name, 1e3 * gap, 1e3 * pin, 200.0 * pin));
  }

  double share() const { return pi / slots; }                   // half an index
  double engaged() const { return 0.5 * pi - share(); }         // alpha_0
  double centres() const { return crank / std::sin(share()); }  // C
  double rim() const { return crank / std::tan(share()); }      // [m] of the wheel's slots
  double half_width() const { return pin + clearance; }
  double root() const { return centres() - 1.02 * crank - 2.0 * clearance; }  // [m] of a slot
  Vec2 wheel_axis() const { return {centres(), 0.0}; }
  /// A point of the wheel that points away from the driver in direction 0.
  Vec2 on_wheel(double radius, double direction) const {
    return wheel_axis() + rotate(direction, {radius, 0.0});
  }

  // The lobe between two slots, seen from its middle, which points at the driver: its tips.
  double tip_angle() const { return share() - std::asin((half_width() + 3.0 * rounding) / rim()); }
  double disc_radius() const {  // R_l
    const Vec2 tip = on_wheel(rim(), pi - tip_angle());
    return tip.norm() - lock_gap - rounding;
  }
  /// [m] by which a tip comes nearer to the driver for a small turn of the wheel [rad].
  double lever() const {
    const Vec2 tip = on_wheel(rim(), pi - tip_angle());
    return centres() * tip.y() / tip.norm();
  }
  /// [rad] the wheel may turn to each side while it is locked.
  double play() const { return lock_gap / lever(); }

  double wheel_angle(double alpha) const {
    const double x = std::sin(share());
    return -std::atan2(x * std::sin(alpha), 1.0 - x * std::cos(alpha));
  }
  std::optional<double> crossing_speed() const;
  double wheel_speed(double alpha) const {
    const double x = std::sin(share()), c = std::cos(alpha);
    return -(x * c - x * x) / (1.0 + x * x - 2.0 * x * c) * omega;
  }
};

/// [m/s] At which the pin hits the other wall after the middle of the index. On a wall the pin is c
/// beside the middle of the slot, and the wheel at the angle B(alpha) = wheel_angle + asin(c/a), a
/// the distance of the pin from its axis; on the other at wheel_angle - asin(c/a). It lets go where
/// J B'' + c_d B' = 0, and the wheel coasts, slowed down by its drag c_d, to the other. None if the
/// drag is so strong that it never does.
std::optional<double> Geneva::crossing_speed() const {
  const auto arm = [&](double alpha) {
    return (rotate(alpha, {crank, 0.0}) - wheel_axis()).norm();
  };
  const auto on_wall = [&](double alpha, double side) {
    return wheel_angle(alpha) + side * std::asin(clearance / arm(alpha));
  };
  const auto speed_on = [&](double alpha, double side) {
    constexpr double h = 1e-5;
    return (on_wall(alpha + h, side) - on_wall(alpha - h, side)) / (2.0 * h) * omega;
  };
  const auto load = [&](double alpha) {
    constexpr double h = 1e-4;
    return (on_wall(alpha + h, 1.0) - 2.0 * on_wall(alpha, 1.0) + on_wall(alpha - h, 1.0)) /
               (h * h) * omega * omega +
           drag / inertia * speed_on(alpha, 1.0);
  };
  constexpr int parts = 20000;
  const double step = engaged() / parts, rate = drag / inertia;
  for (int k = -parts / 4; k < parts; ++k) {
    const double letting_go = k * step;
    if (!(load(letting_go) > 0.0)) continue;
    const double angle = on_wall(letting_go, 1.0), speed = speed_on(letting_go, 1.0);
    for (double alpha = letting_go; alpha < engaged(); alpha += 0.05 * step) {
      const double t = (alpha - letting_go) / omega, slowed = std::exp(-rate * t);
      const double coasting = angle + speed * (rate > 0.0 ? (1.0 - slowed) / rate : t);
      if (coasting <= on_wall(alpha, -1.0))
        return arm(alpha) * (speed_on(alpha, -1.0) - speed * slowed);
    }
    break;
  }
  return {};
}

/// The mass that gives a disc of the radius of the rim this moment of inertia.
double disc_mass(const Geneva& c) { return 2.0 * c.inertia / (c.rim() * c.rim()); }

void add_slots(Model& m, const Geneva& c, const WallLaws& laws, BodyId driver, const Vec2& pin,
               BodyId wheel) {
  for (int k = 0; k < c.slots; ++k) {
    const double direction = pi + c.share() * (2 * k + 1);
    m.add(PinInSlot{
        .name = fmt::format("slot {}", k + 1),
        .pin = {driver, pin, c.pin},
        .slot = {wheel, curve_slot({.centreline = line_segment(c.on_wheel(c.root(), direction),
                                                               c.on_wheel(c.rim(), direction)),
                                    .half_width = c.half_width(),
                                    .end = SlotEnd::open,
                                    .edge_radius = rounding})},
        .law = laws["slot"]});
  }
}

/// The driver's pin points at the angle `phi`.
void add_lock(Model& m, const Geneva& c, const WallLaws& laws, BodyId driver, double phi,
              BodyId wheel) {
  const double R = c.disc_radius(), cut = c.engaged();
  const Curve rim = circular_arc({.radius = R, .start = phi + cut, .angle = 2.0 * (pi - cut)});
  // The hollow of a lobe is an arc about D, from tip to tip.
  const Vec2 tip = c.on_wheel(c.rim(), pi - c.tip_angle());
  const double half = std::atan2(tip.y(), tip.x());
  const Curve hollow =
      circular_arc({.radius = R + c.lock_gap, .start = -half, .angle = 2.0 * half});
  for (int k = 0; k < c.slots; ++k) {
    const double turn = 2.0 * c.share() * k;
    for (const double side : {1.0, -1.0}) {
      m.add(DiscOnCurve{
          .name = fmt::format("tip {} {}", k + 1, side > 0.0 ? "a" : "b"),
          .disc = {wheel, c.on_wheel(c.rim(), pi - side * c.tip_angle() + turn), rounding},
          .body = driver,
          .curve = rim,
          .side = CurveSide::right,
          .law = laws["lock"],
          .thickness = c.pin});
      m.add(DiscOnCurve{.name = fmt::format("end {} {}", k + 1, side > 0.0 ? "a" : "b"),
                        .disc = {driver, rotate(phi + side * cut, {R - rounding, 0.0}), rounding},
                        .body = wheel,
                        .curve = hollow.moved(turn, c.wheel_axis() - rotate(turn, c.wheel_axis())),
                        .side = CurveSide::left,
                        .law = laws["lock"],
                        .thickness = c.pin});
    }
  }
}

/// The wheel as it is drawn: hollow lobes with a slot between each two.
std::vector<Vec2> wheel_outline(const Geneva& c) {
  constexpr int parts = 24;
  const Vec2 tip = c.on_wheel(c.rim(), pi - c.tip_angle());
  const double half = std::atan2(tip.y(), tip.x()), h = c.half_width();
  std::vector<Vec2> outline;
  for (int k = 0; k < c.slots; ++k) {
    const double turn = 2.0 * c.share() * k;
    for (int i = 0; i <= parts; ++i) {
      const Vec2 hollow =
          rotate(half * (1.0 - 2.0 * i / parts), {c.disc_radius() + c.lock_gap, 0.0});
      outline.push_back(rotate(turn, hollow - c.wheel_axis()));
    }
    const Vec2 out = rotate(pi + c.share() + turn, {1.0, 0.0});
    outline.push_back(c.rim() * out - h * perp(out));
    for (int i = 0; i <= parts; ++i)
      outline.push_back(c.root() * out - rotate(-pi * i / parts, h * perp(out)));
    outline.push_back(c.rim() * out + h * perp(out));
  }
  for (Vec2& p : outline) p += c.wheel_axis();
  return outline;
}

/// The driver as it is drawn, its pin at the angle `phi`: the disc, cut away about an arm to the pin.
std::vector<Vec2> driver_outline(const Geneva& c, double phi) {
  constexpr int parts = 72;
  const double R = c.disc_radius(), cut = c.engaged(), hub = 0.3 * R;
  std::vector<Vec2> outline;
  for (int i = 0; i <= parts; ++i)
    outline.push_back(rotate(cut + 2.0 * (pi - cut) * i / parts, {R, 0.0}));
  for (const Vec2& p :
       {Vec2(hub, -c.pin), Vec2(c.crank, -c.pin), Vec2(c.crank, c.pin), Vec2(hub, c.pin)})
    outline.push_back(p);
  for (Vec2& p : outline) p = rotate(phi, p);
  return outline;
}

Model geneva_model(const Geneva& c, const WallLaws& laws) {
  // With clearance the pin starts on the far side; without, where it enters a slot.
  const double phi = c.ideal ? -c.engaged() : pi;
  const Vec2 pin = rotate(phi, {c.crank, 0.0});
  Model m;
  const BodyId driver = m.add(Body{.name = "driver",
                                   .mass = 1.0,
                                   .inertia = 1e-3,
                                   .pose = {{0.0, 0.0}, phi},
                                   .twist = {{0.0, 0.0}, c.omega},
                                   .outline = driver_outline(c, phi)});
  const BodyId wheel = m.add(Body{.name = "wheel",
                                  .mass = disc_mass(c),
                                  .inertia = c.inertia,
                                  .pose = {c.wheel_axis(), 0.0},
                                  .outline = wheel_outline(c)});
  m.add(Revolute{.name = "driver bearing", .a = ground, .b = driver, .at = {0.0, 0.0}});
  m.add(Revolute{.name = "wheel bearing", .a = ground, .b = wheel, .at = c.wheel_axis()});
  m.add(AngleDriver{.name = "motor", .body = driver, .angle = constant_speed(phi, c.omega)});
  m.add(TorsionalSpring{.name = "drag", .a = ground, .b = wheel, .damping = c.drag});
  if (c.ideal) {
    m.add(PointOnLine{.name = "slot",
                      .a = driver,
                      .at = pin,
                      .b = wheel,
                      .through = c.wheel_axis(),
                      .along = pin - c.wheel_axis()});
    return m;
  }
  add_slots(m, c, laws, driver, pin, wheel);
  add_lock(m, c, laws, driver, phi, wheel);
  return m;
}

double geneva_duration(const Geneva& c) {
  return (c.ideal ? 2.0 * c.engaged() : 2.0 * pi * c.turns) / c.omega;
}

std::vector<Check> ideal_checks(const Geneva& c, const Result& run) {
  const Eigen::VectorXd t = run["t_s"];
  const auto alpha = [&](std::size_t i) {
    return -c.engaged() + c.omega * t[static_cast<Eigen::Index>(i)];
  };
  return {deviation_check("angle of the wheel off by", run, "wheel.angle_rad", "rad", "closed form",
                          [&](std::size_t i) { return c.wheel_angle(alpha(i)) - c.share(); }),
          deviation_check("speed of the wheel off by", run, "wheel.omega_rad_per_s", "rad/s",
                          "closed form", [&](std::size_t i) { return c.wheel_speed(alpha(i)); }),
          energy_check(run)};
}

/// The wheel from its place, at the worst [rad], while the rim of the disc covers a whole lobe.
double worst_of_rest(const Geneva& c, const Result& run) {
  const Vec2 tip = c.on_wheel(c.rim(), pi - c.tip_angle());
  const double from = c.engaged() + std::atan2(tip.y(), tip.x());
  const Eigen::VectorXd driver = run["driver.angle_rad"], wheel = run["wheel.angle_rad"];
  double worst = 0.0;
  for (Eigen::Index i = 0; i < driver.size(); ++i) {
    const double turns = driver[i] / (2.0 * pi);
    if (2.0 * pi * std::abs(turns - std::round(turns)) > from)
      worst = std::max(worst, std::abs(wheel[i] + 2.0 * c.share() * std::floor(turns)));
  }
  return worst;
}

std::vector<Check> geneva_checks(const Geneva& c, const Result& run) {
  if (c.ideal) return ideal_checks(c, run);
  const Eigen::VectorXd wheel = run["wheel.angle_rad"];
  const double last = wheel[wheel.size() - 1];
  // Contacts give: what they do shows in the deepest penetration of a tip or an end of the rim.
  double give = 0.0;
  for (int k = 1; k <= c.slots; ++k)
    for (const char* kind : {"tip", "end"})
      for (const char* side : {"a", "b"})
        give = std::max(give, run[fmt::format("{} {} {}.penetration_m", kind, k, side)].maxCoeff());
  const double play = (c.lock_gap + give) / c.lever();
  std::vector<Check> checks = {
      {.what = "indexes",
       .value = std::round(-last / (2.0 * c.share())),
       .expected = static_cast<double>(c.turns),
       .remark = "one in each turn"},
      {.what = "wheel off its place at the end by",
       .value = std::abs(last + 2.0 * c.share() * c.turns),
       .unit = "rad",
       .tolerance = play,
       .remark = "play of the lock"},
      {.what = "wheel off its place while a whole lobe is held, at the worst by",
       .value = worst_of_rest(c, run),
       .unit = "rad",
       .tolerance = 1.05 * play,
       .remark = "play of the lock"}};
  const auto first =
      std::ranges::find_if(run.events, [](const EventRecord& e) { return is_onset(e, "slot"); });
  if (first != run.events.end() && first->region != "edge")  // of the mouth, which is wider
    checks.push_back({.what = "speed of the first impact",
                      .value = first->speed,
                      .expected = c.omega * std::sqrt(c.clearance * (2.0 * c.crank - c.clearance)),
                      .unit = "m/s",
                      .tolerance = 1e-6 * c.omega * c.crank,
                      .remark = "closed form"});
  // The pin changes walls in the middle of an index: compared if it lay still on the one before.
  const auto left = std::ranges::find_if(
      run.events, [](const EventRecord& e) { return is_onset(e, "slot 1") && e.region == "left"; });
  const std::optional<double> crossing = c.crossing_speed();
  for (int k = 1; k <= c.slots; ++k)
    give = std::max(give, run[fmt::format("slot {}.penetration_m", k)].maxCoeff());
  if (left != run.events.end() && left != run.events.begin() && crossing &&
      std::prev(left)->kind == "release" && std::abs(std::prev(left)->speed) < 0.05 * *crossing)
    checks.push_back({.what = "speed of the first impact on the other wall",
                      .value = left->speed,
                      .expected = *crossing,
                      .unit = "m/s",
                      .tolerance = (0.02 + give / c.clearance) * *crossing,
                      .remark = "rigid walls"});
  checks.push_back(energy_check(run));
  return checks;
}

}  // namespace

Case geneva_case() {
  return {
      .name = "geneva",
      .group = "slots and cams",
      .description = "Geneva drive: a pin indexes a wheel with slots, a disc locks it in between",
      .parameters = {{.name = "joint",
                      .default_text = "clearance",
                      .words = {"ideal", "clearance"},
                      .description = "all contacts, or the pin held in one slot for one index"},
                     {.name = "slots",
                      .quantity = Quantity::number,
                      .default_text = "4",
                      .low = 3,
                      .high = 12,
                      .whole = true,
                      .description = "of the wheel, n"},
                     {.name = "crank",
                      .quantity = Quantity::length,
                      .default_text = "50mm",
                      .low = 20.0_mm,
                      .high = 1000.0_mm,
                      .description = "r, axis of the driver to the pin"},
                     {.name = "pin",
                      .quantity = Quantity::length,
                      .default_text = "5mm",
                      .low = 1.0_mm,
                      .high = 100.0_mm,
                      .description = "radius"},
                     {.name = "clearance",
                      .quantity = Quantity::length,
                      .default_text = "0.05mm",
                      .low = 0.001_mm,
                      .high = 10.0_mm,
                      .description = "c, of the pin in a slot, to each side"},
                     {.name = "lock_gap",
                      .quantity = Quantity::length,
                      .default_text = "0.05mm",
                      .low = 0.001_mm,
                      .high = 10.0_mm,
                      .description = "between the disc and the hollow of a lobe"},
                     {.name = "speed",
                      .quantity = Quantity::number,
                      .default_text = "120",
                      .low = 1.0,
                      .high = 1e4,
                      .description = "of the driver, in revolutions per minute"},
                     {.name = "inertia",
                      .quantity = Quantity::number,
                      .default_text = "0.001",
                      .low = 1e-6,
                      .high = 100.0,
                      .description = "of the wheel and what it turns, in kg m^2"},
                     {.name = "drag",
                      .quantity = Quantity::number,
                      .default_text = "0.01",
                      .low = 0.0,
                      .high = 1000.0,
                      .description = "of the wheel's bearing, in N m s/rad"},
                     {.name = "turns",
                      .quantity = Quantity::number,
                      .default_text = "2",
                      .low = 1,
                      .high = 10000,
                      .whole = true,
                      .description = "of the driver, joint = clearance"}},
      .contact = machine_laws([](const Parameters& p) {
        const Geneva c(p);
        if (c.ideal) return std::vector<Wall>{};
        return std::vector<Wall>{nearly_flat_wall("slot", c.pin),
                                 nearly_flat_wall("lock", rounding)};
      }),
      .default_output = "results/geneva",
      .model = [](const Parameters& p,
                  const WallLaws& laws) { return geneva_model(Geneva(p), laws); },
      .duration = [](const Parameters& p) { return geneva_duration(Geneva(p)); },
      .checks = [](const Parameters& p, const Model&,
                   const Result& run) { return geneva_checks(Geneva(p), run); }};
}

}  // namespace yoke::cases
