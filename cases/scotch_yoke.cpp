// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A crank turns at constant speed. Its pin runs with clearance in the circular slot of a slider
// that is guided along x, so the slider hammers between the two walls of the slot.
//
//                    1 kg
//                  .-(o)
//               .-' .-'            o   crank pivot, origin
//             .'  .'               P   pin, radius 7.9 mm, at r = crank_length from the pivot
//            /   /                 C   centre of the slot's arc, fixed in the slider: its x is what
//           |   | P                    the results call slider_x_m, its y is 0
//    o------+-(#)+ - - - C
//     phi   |   |    R_m           R_m 60 mm to the middle of the slot; walls at 52 mm (inner) and
//            \   \                     68 mm (outer, the far one from C), over 120 deg, caps 8 mm
//             '.  '.               slider: 0.353 kg and 1 kg at each end of the slot
//               '-. '-.            24 pi rad/s, no gravity, no friction
//                  '-(o)
//                    1 kg          without clearance X = r cos(phi) + sqrt(R_m^2 - r^2 sin^2(phi))
//
// What should happen. The slider follows X(phi) within the gap of 0.1 mm. It is pushed to +x by the
// inner wall and to -x by the outer wall; the sides change where X'' = 0, for r = 45 mm at phi
// = 63.6 and 296.4 deg. There the pin crosses the gap in 12 to 14 deg of free flight, lands at
// about 0.19 m/s and bounces, every time a little lower, until the contact is continuous. Without
// the bounces the force would stay below 1.05 kN.
//
// What the paper does not say and the motion depends on is a parameter below. What it does not say
// and the motion does not depend on, because the crank's speed is imposed and the slider cannot
// turn: the centre of mass of the crank (here half-way between pivot and pin) and of the slider
// without its end masses (here the centroid of the slot's centreline). They do show in the
// reactions.
#include <yoke/cases/scotch_yoke.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/geometry/curve_slot.hpp>
#include <yoke/contact/laws/catalog/table11.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/curves/smooth_curves.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/time_function.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/point_on_curve.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

using namespace scotch_yoke_data;

namespace {

/// The slot's centreline about its centre [m], counter-clockwise: the inner wall is on the left.
Curve centreline(const Vec2& centre) {
  return circular_arc(
      {.center = centre, .radius = arc_radius, .start = pi - 0.5 * arc_angle, .angle = arc_angle});
}

/// A spline through points of it, both ends among them.
Curve spline_through_arc(const Vec2& centre, int points) {
  std::vector<Vec2> all;
  for (int i = 0; i < points; ++i)
    all.push_back(centre + rotate(pi + arc_angle * (static_cast<double>(i) / (points - 1) - 0.5),
                                  {arc_radius, 0.0}));
  return curve_through(all);
}

constexpr int spline_points = 200;

/// The pin in the slot: contacts, or without clearance and laws a joint.
void add_slot(Model& m, const ScotchYoke& choices, BodyId pin, const Vec2& tip, BodyId slider,
              const Vec2& centre, const std::optional<SlotLaws>& laws) {
  if (choices.slot == ScotchYoke::Slot::ideal) {
    m.add(PointOnCurve{
        .name = "slot", .a = pin, .at = tip, .b = slider, .curve = centreline(centre)});
    return;
  }
  const Slot slot = choices.slot == ScotchYoke::Slot::arc
                        ? arc_slot({.center = centre,
                                    .radius = arc_radius,
                                    .direction = pi,
                                    .angle = arc_angle,
                                    .half_width = half_width})
                        : curve_slot({.centreline = spline_through_arc(centre, spline_points),
                                      .half_width = half_width});
  m.add(PinInSlot{
      .name = "slot", .pin = {pin, tip, pin_radius}, .slot = {slider, slot}, .law = *laws});
}

}  // namespace

Model scotch_yoke(const ScotchYoke& choices, const std::optional<SlotLaws>& laws) {
  const double r = choices.crank_length, phi = choices.start_angle;
  const TimeFunction turning = smooth_ramp(phi, speed, choices.spin_up);
  const double omega = turning(0.0).rate;
  const Vec2 origin{0.0, 0.0}, tip = rotate(phi, {r, 0.0});
  const IdealMotion slide = ideal_scotch_yoke(r, phi, omega, arc_radius + choices.pin_offset);
  const double slider_v = choices.consistent ? slide.v : 0.0;
  const auto on_arc = [&](double radius, double direction) {  // seen from C, the slot bulges to -x
    return Vec2{slide.x - radius * std::cos(direction), radius * std::sin(direction)};
  };
  const double half = arc_angle / 2.0;

  Body crank{.name = "crank",
             .mass = crank_mass,
             .inertia = crank_inertia,
             .pose = {tip / 2.0, phi},
             .twist = {omega * perp(tip / 2.0), omega}};
  Body slider{.name = "slider",
              .mass = slider_mass,
              .inertia = slider_inertia,
              .pose = {on_arc(arc_radius * std::sin(half) / half, 0.0), 0.0},
              .twist = {{slider_v, 0.0}, 0.0}};
  slider = with_point_mass(slider, end_mass, on_arc(arc_radius, half));
  slider = with_point_mass(slider, end_mass, on_arc(arc_radius, -half));
  if (!choices.rolling) crank = with_point_mass(crank, pin_mass, tip);

  Model m;
  const BodyId crank_id = m.add(crank), slider_id = m.add(slider);
  BodyId pin_id = crank_id;
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank_id, .at = origin});
  m.add(AngleDriver{.name = "motor", .body = crank_id, .angle = turning});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider_id, .along = {1.0, 0.0}});
  if (choices.rolling) {
    pin_id = m.add(Body{.name = "pin",
                        .mass = pin_mass,
                        .inertia = pin_inertia,
                        .pose = {tip, 0.0},
                        .twist = {omega * perp(tip), 0.0}});
    m.add(Revolute{.name = "pin_joint", .a = crank_id, .b = pin_id, .at = tip});
  }
  add_slot(m, choices, pin_id, tip, slider_id, {slide.x, 0.0}, laws);
  return m;
}

IdealMotion ideal_scotch_yoke(double r, double angle, double omega, double R) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double root = std::sqrt(R * R - r * r * s * s);
  // root^2 = R^2 - r^2 s^2, so root' = -r^2 s c / root and root'' = -(r^2 (c^2 - s^2) +
  // root'^2)/root.
  const double root_1 = -r * r * s * c / root;
  const double root_2 = -(r * r * (c * c - s * s) + root_1 * root_1) / root;
  IdealMotion m{
      .x = r * c + root, .v = omega * (-r * s + root_1), .a = omega * omega * (-r * c + root_2)};
  // The normal from C to the pin has the x component -root/R; the pin pushes the outer wall along
  // it.
  m.force = -moving_mass * m.a * R / root;
  return m;
}

double arc_centre_offset(const Model& model, const ScotchYoke& choices) {
  const double R = arc_radius + choices.pin_offset;
  const Vec2 centre{ideal_scotch_yoke(choices.crank_length, choices.start_angle, 0.0, R).x, 0.0};
  return model.to_local(model.find_body("slider"), centre).x();
}

// ---- laws ----

namespace {

constexpr double printed_length = 1.0_mm;  // Table 11 is a force per millimetre
constexpr std::string_view ten_mm = "-10mm";

/// The slot's walls and caps as the pin meets them.
std::vector<Wall> walls_of(const ScotchYoke& choices) {
  const double length = choices.contact_length > 0.0 ? choices.contact_length : printed_length;
  const auto wall = [&](const char* name, double radius, Conformity conformity) {
    return Wall{.name = name,
                .pair = {.pin_radius = pin_radius, .wall_radius = radius, .conformity = conformity},
                .length = length};
  };
  return {wall("inner", arc_radius - half_width, Conformity::external),
          wall("outer", arc_radius + half_width, Conformity::internal),
          wall("cap", half_width, Conformity::internal)};
}

/// A law of the case by its name, for any of the walls.
ContactLaw named_law(const ScotchYoke& choices, const Wall& wall, std::string_view name) {
  const HuntCrossley damping{choices.alpha};
  double length = wall.length;
  if (name.ends_with(ten_mm)) {
    name.remove_suffix(ten_mm.size());
    length = 10.0_mm;
  }
  if (name == "johnson") return {johnson(wall.pair, length), damping};
  const Table11 k = table11(name, length / printed_length);
  return {wall.name == "inner" ? k.inner : wall.name == "outer" ? k.outer : k.cap, damping};
}

ContactChoice contact_choice() {
  ContactChoice contact{.walls =
                            [](const Parameters& p) {
                              const ScotchYoke choices(p);
                              return choices.slot == ScotchYoke::Slot::ideal ? std::vector<Wall>{}
                                                                             : walls_of(choices);
                            },
                        .base = "johnson"};
  for (const auto& [name, description] : {
           std::pair{"table11-lankarani-nikravesh",
                     "Table 11 as printed, Lankarani and Nikravesh: n = 1.5"},
           {"table11-radzimovsky", "Table 11 as printed, fit of Radzimovsky's law"},
           {"table11-johnson", "Table 11 as printed, fit of Johnson's law"},
           {"table11-goldsmith", "Table 11 as printed, fit of Goldsmith's law"},
           {"table11-esdu-78035", "Table 11 as printed, fit of ESDU 78035"},
           {"johnson", "Johnson's law itself, L = contact_length (as_printed: 1 mm)"},
           {"table11-johnson-10mm",
            "Table 11's fit of Johnson's law, K times 10 whatever contact_length"},
           {"johnson-10mm", "Johnson's law itself, L = 10 mm, the pin's real length"},
       })
    contact.laws.push_back(
        {name, description, [law = std::string(name)](const Parameters& p, const Wall& wall) {
           return named_law(ScotchYoke(p), wall, law);
         }});
  return contact;
}

SlotLaws slot_laws(const ScotchYoke& choices, const WallLaws& laws) {
  return {laws[choices.one_wall_law ? "outer" : "inner"], laws["outer"], laws["cap"]};
}

}  // namespace

SlotLaws scotch_yoke_laws(const ScotchYoke& choices, std::string_view name) {
  WallLaws laws;
  for (const Wall& wall : walls_of(choices)) laws.set(wall.name, named_law(choices, wall, name));
  return slot_laws(choices, laws);
}

// ---- parameters ----

namespace {

std::vector<CaseParameter> parameters() {
  return {
      {.name = "crank_length",
       .quantity = Quantity::length,
       .default_text = "45mm",
       .low = 1.0_mm,
       .high = 51.9_mm,
       .description =
           "pivot to pin; above 60 mm sin(60 deg) = 51.96 mm the pin would leave the slot"},
      {.name = "start_angle",
       .quantity = Quantity::angle,
       .default_text = "-31deg",
       .low = -360.0_deg,
       .high = 360.0_deg,
       .description = "crank at the start, from +x; relative crank angles count from here"},
      {.name = "spin_up",
       .quantity = Quantity::time,
       .default_text = "0s",
       .low = 0.0,
       .high = 10.0,
       .description = "duration of a smooth ramp of the crank's speed; 0s: full speed at once"},
      {.name = "slider_start",
       .default_text = "consistent",
       .words = {"rest", "consistent"},
       .description = "slider at rest, or as fast as the mechanism without clearance"},
      {.name = "pin_offset",
       .quantity = Quantity::length,
       .default_text = "0mm",
       .low = -gap,
       .high = gap,
       .description = "pin from the middle of the slot at the start; > 0 towards the outer wall"},
      {.name = "pin",
       .default_text = "fixed",
       .words = {"fixed", "rolling"},
       .description = "part of the crank, or a body that turns on it"},
      {.name = "alpha",
       .quantity = Quantity::time_per_length,
       .default_text = "0.32s/m",
       .low = 0.0,
       .high = 1000.0,
       .description = "damping of Hunt and Crossley: F = F_e (1 + 1.5 alpha d')"},
      {.name = "contact_length",
       .quantity = Quantity::length,
       .default_text = "as_printed",
       .low = 0.01_mm,
       .high = 1000.0_mm,
       .words = {"as_printed"},
       .description = "Table 11's K per mm of it; as_printed: K is the total force constant"},
      {.name = "revolutions",
       .quantity = Quantity::number,
       .default_text = "2",
       .low = 0.01,
       .high = 10000.0,
       .description = "of the crank; the last one is plotted"},
      {.name = "walls",
       .default_text = "own",
       .words = {"own", "one"},
       .description = "each wall its own law, or the outer wall's for both"},
      {.name = "slot",
       .default_text = "arc",
       .words = {"arc", "spline", "ideal"},
       .description = "an arc, a spline through 200 points of it, or the arc without clearance"},
  };
}

}  // namespace

ScotchYoke::ScotchYoke(const Parameters& p)
    : crank_length(p.number("crank_length")),
      start_angle(p.number("start_angle")),
      spin_up(p.number("spin_up")),
      consistent(p.word("slider_start") == "consistent"),
      pin_offset(p.number("pin_offset")),
      rolling(p.word("pin") == "rolling"),
      slot(p.word("slot") == "arc"      ? Slot::arc
           : p.word("slot") == "spline" ? Slot::spline
                                        : Slot::ideal),
      alpha(p.number("alpha")),
      contact_length(p.is_word("contact_length") ? 0.0 : p.number("contact_length")),
      revolutions(p.number("revolutions")),
      one_wall_law(p.word("walls") == "one") {
  if (slot == Slot::ideal && pin_offset != 0.0)
    throw ModelError(
        fmt::format("pin_offset = {:g} mm must be 0 mm with slot=ideal: the pin has no "
                    "room beside the middle of the slot",
                    1e3 * pin_offset));
  const double period = 2.0 * pi / speed;
  if (revolutions * period < 0.5 * spin_up)
    throw ModelError(
        fmt::format("spin_up: during {:g} s the crank turns {:g} revolutions, more than "
                    "the {:g} asked for; give more revolutions or a shorter spin_up",
                    spin_up, 0.5 * spin_up / period, revolutions));
}

// The ramp ends half its duration behind a crank that has full speed at once.
double ScotchYoke::end_time() const { return revolutions * 2.0 * pi / speed + 0.5 * spin_up; }

double ScotchYoke::last_revolution_start() const {
  return std::max(0.0, end_time() - 2.0 * pi / speed);
}

// ---- results ----

namespace {

/// motion.csv in the words of the paper: angles also from the start, slider_x at the centre of the
/// slot's arc.
std::vector<MotionColumn> motion_columns(const ScotchYoke& choices, const Model& model) {
  std::vector<MotionColumn> columns = {
      {"t", "s", "t_s"},
      {"crank_angle", "rad", "crank.angle_rad"},
      {"crank_angle_relative", "rad", "crank.angle_rad", -choices.start_angle},
      {"crank_speed", "rad/s", "crank.omega_rad_per_s"},
      {"slider_x", "m", "slider.x_m", arc_centre_offset(model, choices)},
      {"slider_v", "m/s", "slider.vx_m_per_s"},
      {"slider_a", "m/s^2", "slider.ax_m_per_s2"},
      {"pivot_fx", "N", "pivot.fx_N"},
      {"pivot_fy", "N", "pivot.fy_N"},
      {"guide_fy", "N", "guide.fy_N"},
      {"guide_moment", "N m", "guide.moment_N_m"},
      {"motor_torque", "N m", "motor.moment_N_m"},
  };
  const std::vector<MotionColumn> contact = {
      {"penetration", "m", "slot.penetration_m"},
      {"penetration_rate", "m/s", "slot.penetration_rate_m_per_s"},
      {"normal_force", "N", "slot.normal_force_N"},
      {"region", "", "slot.region"}};
  const std::vector<MotionColumn> joint = {{"slot_fx", "N", "slot.fx_N"},
                                           {"slot_fy", "N", "slot.fy_N"}};
  const std::vector<MotionColumn>& slot = choices.slot == ScotchYoke::Slot::ideal ? joint : contact;
  columns.insert(columns.begin() + 7, slot.begin(), slot.end());
  if (choices.rolling)
    columns.insert(columns.end(), {{"pin_joint_fx", "N", "pin_joint.fx_N"},
                                   {"pin_joint_fy", "N", "pin_joint.fy_N"},
                                   {"pin_speed", "rad/s", "pin.omega_rad_per_s"}});
  for (const char* energy : {"kinetic", "stored", "dissipated", "work", "balance"})
    columns.push_back({energy, "J", std::string(energy) + "_J"});
  return columns;
}

/// How far a spline through points of the arc is from it, and how far its normal turns off, for
/// pins about the slot's middle.
struct SplineError {
  double gap = 0.0;     // [m]
  double normal = 0.0;  // [rad]
};
SplineError spline_error(int points) {
  const Vec2 centre{0.0, 0.0};
  const Curve spline = spline_through_arc(centre, points);
  SplineError worst;
  for (int i = 0; i <= 1000; ++i)
    for (const double across : {-gap, 0.0, gap}) {
      const Vec2 away = rotate(pi + arc_angle * (i / 1000.0 - 0.5), {1.0, 0.0});
      const CurveOffset seen = spline.offset(centre + (arc_radius + across) * away);
      worst.gap = std::max(worst.gap, std::abs(seen.distance + across));
      worst.normal = std::max(worst.normal, std::abs(cross(seen.normal, away)));
    }
  return worst;
}

/// The spline slot against the arc slot. The order is that of a coarse one: 200 points are at
/// rounding.
std::vector<Check> spline_checks() {
  const SplineError at_200 = spline_error(spline_points), coarse = spline_error(13),
                    fine = spline_error(25);
  const auto order = [](double h, double half) { return std::log2(h / half); };
  return {{.what = "gap of the spline's slot off the arc's by",
           .value = 1e6 * at_200.gap,
           .unit = "um",
           .tolerance = 1e6 * 1e-8 * gap,
           .remark = "1e-8 of the gap"},
          {.what = "normal of the spline off the arc's by",
           .value = at_200.normal,
           .unit = "rad",
           .tolerance = 1e-8},
          {.what = "order of the gap's convergence, 12 to 24 intervals",
           .value = order(coarse.gap, fine.gap),
           .expected = 6.0,
           .tolerance = 0.8,
           .remark = "degree 5"},
          {.what = "order of the normal's convergence",
           .value = order(coarse.normal, fine.normal),
           .expected = 5.0,
           .tolerance = 0.8,
           .remark = "degree 5"}};
}

/// Without clearance the closed form holds for every row.
std::vector<Check> ideal_checks(const ScotchYoke& choices, const Model& model, const Result& run) {
  const double shift = arc_centre_offset(model, choices);
  const Eigen::VectorXd angle = run["crank.angle_rad"];
  return {deviation_check("place of the slider off by", run, "slider.x_m", "m", "closed form",
                          [&](std::size_t i) {
                            return ideal_scotch_yoke(choices.crank_length,
                                                     angle[static_cast<Eigen::Index>(i)], speed)
                                       .x -
                                   shift;
                          }),
          energy_check(run)};
}

/// The slider stays within what the gap and the deepest penetration allow around the mechanism
/// without clearance: X with R_m longer or shorter by both.
std::vector<Check> scotch_yoke_checks(const ScotchYoke& choices, const Model& model,
                                      const Result& run) {
  if (choices.slot == ScotchYoke::Slot::ideal) return ideal_checks(choices, model, run);
  const double play = gap + std::max(0.0, run["slot.penetration_m"].maxCoeff());
  const double shift = arc_centre_offset(model, choices);
  const Eigen::VectorXd angle = run["crank.angle_rad"], x = run["slider.x_m"];
  double beyond = 0.0;
  for (Eigen::Index i = 0; i < angle.size(); ++i) {
    const auto ideal = [&](double radius) {
      return ideal_scotch_yoke(choices.crank_length, angle[i], speed, radius).x;
    };
    const double at = x[i] + shift;
    beyond = std::max({beyond, at - ideal(arc_radius + play), ideal(arc_radius - play) - at});
  }
  std::vector<Check> checks = {
      {.what = "slider farther from the mechanism without clearance than the play, by",
       .value = 1e6 * beyond,
       .unit = "um",
       .tolerance = 1e-3,
       .remark = fmt::format("closed form; gap and deepest penetration {:.1f} um", 1e6 * play)},
      energy_check(run)};
  if (choices.slot == ScotchYoke::Slot::spline)
    for (Check& check : spline_checks()) checks.push_back(std::move(check));
  return checks;
}

}  // namespace

namespace {

/// What the paper's Figures 11 to 16 show, at the angles of their axes.
std::vector<ReportView> paper_views(const ScotchYoke& choices) {
  if (choices.slot == ScotchYoke::Slot::ideal) return {};
  const double start = choices.last_revolution_start(), degree = (choices.end_time() - start) / 360;
  const auto at = [&](double angle) { return start + angle * degree; };
  const std::string force = "slot.normal_force", depth = "slot.penetration";
  std::vector<ReportView> views = {
      {"Figure 11: contact force over one revolution", at(0), at(360), {force}},
      {"Figure 12: penetration over one revolution", at(0), at(360), {depth}},
      {"Figure 13: penetration after the landing on the inner wall", at(90), at(180), {depth}},
      {"Figure 14: contact force in the impact section", at(0), at(100), {force}},
      {"Figure 15: one contact and rebound, on the outer wall", at(330), at(350), {force}},
      {"Figure 16: position of the slider", at(0), at(360), {"slider.x"}},
      {"Figure 16: velocity of the slider", at(0), at(360), {"slider.vx"}},
      {"Figure 16: acceleration of the slider", at(0), at(360), {"slider.ax"}}};
  views[4].over_penetration = true;
  return views;
}

}  // namespace

Case scotch_yoke_case() {
  return {.name = "scotch_yoke",
          .group = "joints with clearance",
          .description = "scotch-yoke with a circular slot and clearance, under many contact laws",
          .parameters = parameters(),
          .contact = contact_choice(),
          .default_output = "results/scotch_yoke",
          .model =
              [](const Parameters& p, const WallLaws& laws) {
                const ScotchYoke choices(p);
                if (choices.slot == ScotchYoke::Slot::ideal) return scotch_yoke(choices, {});
                return scotch_yoke(choices, slot_laws(choices, laws));
              },
          .duration = [](const Parameters& p) { return ScotchYoke(p).end_time(); },
          .columns = [](const Parameters& p,
                        const Model& model) { return motion_columns(ScotchYoke(p), model); },
          .checks = [](const Parameters& p, const Model& model,
                       const Result& run) { return scotch_yoke_checks(ScotchYoke(p), model, run); },
          .views = [](const Parameters& p) { return paper_views(ScotchYoke(p)); }};
}

}  // namespace yoke::cases
