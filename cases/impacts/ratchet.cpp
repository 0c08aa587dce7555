// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A ratchet: an arm swings about the axis of a toothed wheel and pushes it on by a pawl; a second
// pawl, on the frame, lets the wheel turn one way and holds it the other way.
//
//        P (o)--.           P  pivot of a pawl: on the arm, or on the frame (opposite)
//                '--.       T  its round tip, pressed in by a spring
//      tooth   |\  T (o)|\  the face of the next tooth, radial, is pushed counter-clockwise
//       flank  | '-.____| '-.___
//
// In pitches 2 pi/teeth the arm swings from -1/4 to stroke - 1/4; faces are at whole numbers. While
// it goes forward its pawl pushes a face, from 0 on; the pawl of the frame slides up a flank and
// falls behind the next tooth. While it goes back the load turns the wheel back onto the pawl of the
// frame, and the arm's pawl slides over as many teeth. So each cycle gives as many whole pitches as
// there are in stroke - 1/4.
//
// The pivots lie outside the tangent at the tip, so that the push of a face draws the pawl in. The
// profile has fillets larger than the tips: a tip touches in one place only.
#include <algorithm>
#include <cmath>

#include <yoke/cases/impacts/impact_laws.hpp>
#include <yoke/cases/uniform_bar.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

struct Ratchet {
  int teeth;
  double stroke;     // in pitches
  double frequency;  // [Hz]
  double load;       // [N m] turns the wheel back
  double cycles;
  static constexpr double radius = 50.0_mm, depth = 6.0_mm, fillet = 1.5_mm, tip = 0.8_mm;
  static constexpr double reach = 25.0_mm, rise = 5.0_mm;  // of a pivot from its tip
  static constexpr double lift = 0.16;                     // [rad] of the pawls at the start

  explicit Ratchet(const Parameters& p)
      : teeth(p.whole("teeth")),
        stroke(p.number("stroke")),
        frequency(p.number("frequency")),
        load(p.number("load")),
        cycles(p.number("cycles")) {}

  double pitch() const { return 2.0 * pi / teeth; }
  double arm_start() const { return -0.25 * pitch(); }
  double root() const { return radius - depth; }

  Curve profile() const {
    std::vector<Vec2> points;
    for (int i = 0; i < teeth; ++i) {
      const Vec2 out = rotate(i * pitch(), {1.0, 0.0});
      points.push_back(root() * out);
      points.push_back(radius * out);
    }
    return polyline(points, {.fillet = fillet, .closed = true});
  }
  /// The middle of the fillet before the face at angle 0: where a tip lies with play all round.
  Vec2 seat() const {
    const Vec2 foot(root(), 0.0);
    const Vec2 along = (foot - rotate(-pitch(), {radius, 0.0})).normalized();
    const Vec2 out = -perp(along);
    return {root() + fillet * (1.0 + out.y()) / out.x(), -fillet};
  }
};

constexpr double spring_force = 4.0;  // [N] of a pawl, at its tip

struct Pawl {
  std::string name;
  BodyId on;
  double at;  // [rad] where its pivot is turned to, from the tooth at angle 0
};

void add_pawl(Model& m, const Ratchet& c, const Pawl& pawl, BodyId wheel, const ContactLaw& law) {
  const Vec2 seat = c.seat(), pivot_0 = seat + Vec2(Ratchet::rise, -Ratchet::reach);
  const Vec2 pivot = rotate(pawl.at, pivot_0);
  const Vec2 tip = pivot + rotate(pawl.at - Ratchet::lift, seat - pivot_0);
  constexpr double mass = 0.03;  // [kg]
  const BodyId body =
      m.add(uniform_bar({.name = pawl.name, .mass = mass, .from = pivot, .to = tip}));
  m.add(Revolute{.name = pawl.name + " pivot", .a = pawl.on, .b = body, .at = pivot});
  // Pressed in by 0.1 N m in its seat, a little more on the tops of the teeth.
  const double angle = m.body(body).pose.angle - m.body(pawl.on).pose.angle;
  m.add(TorsionalSpring{.name = pawl.name + " spring",
                        .a = pawl.on,
                        .b = body,
                        .stiffness = 0.1,
                        .damping = 2e-4,
                        .free_angle = angle + Ratchet::lift + 1.0});
  m.add(DiscOnCurve{.name = pawl.name + " tip",
                    .disc = {body, tip, Ratchet::tip},
                    .body = wheel,
                    .curve = c.profile(),
                    .side = CurveSide::right,
                    .law = law,
                    .reference_force = 10.0});
}

/// A tip that gives as much as its radius finds no hold in the teeth.
void require_hold(const Ratchet& c, const ContactLaw& law) {
  const double force = c.load / c.root() + spring_force;
  const double give = law.elastic.penetration_at(force), most = 0.25 * Ratchet::tip;
  if (!(give < most))
    throw ModelError(fmt::format(
        "ratchet: under the {:.3g} N of load and spring the tip of a pawl would give by {:.3g} mm; "
        "accepted is less than {:g} mm, a quarter of its radius: with a greater stiffness, a "
        "smaller exponent, another law or a smaller load",
        force, 1e3 * give, 1e3 * most));
}

Model ratchet_model(const Ratchet& c, const WallLaws& laws) {
  require_hold(c, laws["tip"]);
  Model m;
  const Vec2 axis(0.0, 0.0);
  const BodyId wheel = m.add(Body{.name = "wheel", .mass = 0.5, .inertia = 6e-4});
  const BodyId arm =
      m.add(Body{.name = "arm", .mass = 0.2, .inertia = 2e-4, .pose = {axis, c.arm_start()}});
  m.add(Revolute{.name = "wheel bearing", .a = ground, .b = wheel, .at = axis});
  m.add(Revolute{.name = "arm bearing", .a = ground, .b = arm, .at = axis});
  const double middle = (0.5 * c.stroke - 0.25) * c.pitch(), half = 0.5 * c.stroke * c.pitch(),
               w = 2.0 * pi * c.frequency;
  m.add(AngleDriver{.name = "drive", .body = arm, .angle = [=](double t) {
                      const double k = half * std::cos(w * t), s = half * std::sin(w * t);
                      return TimeValue{middle - k, w * s, w * w * k};
                    }});
  m.add(AppliedTorque{
      .name = "load", .body = wheel, .torque = [load = c.load](double) { return -load; }});
  m.add(TorsionalSpring{.name = "friction of the wheel", .a = ground, .b = wheel, .damping = 0.02});
  add_pawl(m, c, {"driving pawl", arm, c.arm_start()}, wheel, laws["tip"]);
  add_pawl(m, c, {"holding pawl", ground, c.pitch() * (c.teeth / 2)}, wheel, laws["tip"]);
  return m;
}

/// [rad] The wheel at the ends of the cycles, when it lies on the holding pawl.
std::vector<double> wheel_after_cycles(const Ratchet& c, const Result& run) {
  const Eigen::VectorXd t = run["t_s"], angle = run["wheel.angle_rad"];
  const Eigen::VectorXd omega = run["wheel.omega_rad_per_s"];
  std::vector<double> angles;
  for (int k = 1; k <= c.cycles + 1e-9; ++k) {
    const double end = k / c.frequency;
    const auto after = std::lower_bound(t.begin(), t.end(), end - 1e-9) - t.begin();
    const auto i = std::clamp<Eigen::Index>(after, 1, t.size() - 1), before = i - 1;
    const double h = t[i] - t[before], s = std::min(1.0, (end - t[before]) / h);
    const double mean = (angle[i] - angle[before]) / h;
    angles.push_back(
        angle[before] +
        h * s * (mean + (1.0 - s) * ((1.0 - s) * (omega[before] - mean) - s * (omega[i] - mean))));
  }
  return angles;
}

std::vector<Check> ratchet_checks(const Parameters& p, const Model&, const Result& run) {
  const Ratchet c(p);
  std::vector<Check> checks;
  const std::vector<double> angles = wheel_after_cycles(c, run);
  // Within 0.1 above a whole number the plays decide, which are the fillets'.
  const double indexed = std::floor(c.stroke - 0.25);
  double worst = indexed;
  for (std::size_t i = 1; i < angles.size(); ++i) {
    const double pitches = (angles[i] - angles[i - 1]) / c.pitch();
    if (std::abs(pitches - indexed) > std::abs(worst - indexed)) worst = pitches;
  }
  if (angles.size() > 1 && c.stroke - 0.25 - indexed > 0.1)
    checks.push_back({.what = "pitches per cycle",
                      .value = worst,
                      .expected = indexed,
                      .tolerance = 1e-3,
                      .remark = fmt::format("the worst of {} cycles", angles.size() - 1)});
  checks.push_back(energy_check(run));
  return checks;
}

std::vector<CaseParameter> ratchet_parameters() {
  std::vector<CaseParameter> all = {{.name = "teeth",
                                     .quantity = Quantity::number,
                                     .default_text = "12",
                                     .low = 8,
                                     .high = 20,
                                     .whole = true,
                                     .description = "of the wheel"},
                                    {.name = "stroke",
                                     .quantity = Quantity::number,
                                     .default_text = "1.5",
                                     .low = 0.3,
                                     .high = 3.2,
                                     .description = "of the arm, in pitches of the teeth"},
                                    {.name = "frequency",
                                     .quantity = Quantity::number,
                                     .default_text = "2",
                                     .low = 0.05,
                                     .high = 10,
                                     .description = "of the arm, in Hz"},
                                    {.name = "load",
                                     .quantity = Quantity::number,
                                     .default_text = "0.5",
                                     .low = 0.0,
                                     .high = 5.0,
                                     .description = "that turns the wheel back, in N m"},
                                    {.name = "cycles",
                                     .quantity = Quantity::number,
                                     .default_text = "3",
                                     .low = 0.1,
                                     .high = 1000,
                                     .description = "of the arm"}};
  for (CaseParameter& p : impact_parameters("1e9", "0.4")) all.push_back(std::move(p));
  return all;
}

/// Without the law that loses nothing: its pawls would rattle for ever.
ContactChoice ratchet_laws() {
  ContactChoice contact =
      impact_laws([](const Parameters&) { return std::vector{flat_wall("tip", Ratchet::tip)}; });
  contact.laws.pop_back();
  contact.base = "hunt-crossley";
  std::swap(contact.laws[0], contact.laws[1]);
  return contact;
}

}  // namespace

Case ratchet_case() {
  return {
      .name = "ratchet",
      .group = "impacts",
      .description = "a pawl pushes a toothed wheel on, another holds it",
      .parameters = ratchet_parameters(),
      .contact = ratchet_laws(),
      .default_output = "results/ratchet",
      .model = [](const Parameters& p,
                  const WallLaws& laws) { return ratchet_model(Ratchet(p), laws); },
      .duration = [](const Parameters& p) { return p.number("cycles") / p.number("frequency"); },
      .checks = ratchet_checks};
}

}  // namespace yoke::cases
