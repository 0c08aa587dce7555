// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A free roller in a circular slot, let go beside the lowest place: it rolls on the outer wall, skids, or
// first the one and then the other.
//
//     A = R + clearance, the circle of its centre;  angle theta from below;  I = kappa m r^2
//     s = A theta' + r w                       slip on the outer wall
//     m A theta'' = -m g sin(theta) - T,  I w' = -T r,  N = m (g cos(theta) + A theta'^2)
//     rolls: T = -m g sin(theta) kappa/(1 + kappa) while |T| <= mu_s N;  skids: T = mu N sgn(s)
#include <array>
#include <cmath>

#include <yoke/cases/friction/friction_laws.hpp>
#include <yoke/cases/impacts/impact_laws.hpp>
#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/forces/gravity.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

constexpr double slot_opening = 176.0_deg;

struct SlotRoller {
  static constexpr double g = 9.81;                    // [m/s^2]
  double path, radius, clearance, mass, kappa, start;  // [m, m, m, kg, 1, rad]
  double mu, mu_static;

  explicit SlotRoller(const Parameters& p)
      : path(p.number("path")),
        radius(p.number("roller")),
        clearance(p.number("clearance")),
        mass(p.number("mass")),
        kappa(p.number("inertia")),
        start(p.number("start")),
        mu(p.number("mu")),
        mu_static(p.number("mu_static")) {
    if (!(path > 2.0 * (radius + clearance)))
      throw ModelError(fmt::format(
          "slot_roller: path = {:g} mm must be more than twice the half-width of the slot, {:g} mm",
          1e3 * path, 1e3 * (radius + clearance)));
  }
  double weight() const { return mass * g; }
  double inertia() const { return kappa * mass * radius * radius; }
};

Model slot_roller_model(const SlotRoller& c, const WallLaws& laws) {
  Model m;
  const ContactLaw& law = laws["slot"];
  const double depth = law.elastic.penetration_at(c.weight() * std::cos(c.start));
  const double way = c.path + c.clearance + depth;
  const Vec2 centre = way * Vec2(std::sin(c.start), -std::cos(c.start));
  const BodyId roller =
      m.add(Body{.name = "roller", .mass = c.mass, .inertia = c.inertia(), .pose = {centre, 0.0}});
  m.add(Gravity{.acceleration = {0.0, -SlotRoller::g}});
  m.add(PinInSlot{.name = "slot",
                  .pin = {roller, centre, c.radius},
                  .slot = {ground, arc_slot({.radius = c.path,
                                             .direction = -0.5 * pi,
                                             .angle = slot_opening,
                                             .half_width = c.radius + c.clearance})},
                  .law = law,
                  .reference_force = c.weight()});
  return m;
}

/// The rigid roller under Coulomb's law.
class RigidRoller {
 public:
  explicit RigidRoller(const SlotRoller& c)
      : c_(c), A_(c.path + c.clearance), y_{c.start, 0.0, 0.0} {
    rolls_or_skids();
  }
  double angle() const { return y_[0]; }
  double spin() const { return y_[2]; }
  /// Small steps of Runge and Kutta's method; one in which the roller begins or ceases to skid is halved.
  void advance(double time, int steps) {
    for (int i = 0; i < steps; ++i) take(time / steps, halvings);
  }

 private:
  using State = std::array<double, 3>;  // theta, theta', spin
  // A skid begins with a slip that grows as the square of the time: in shorter steps its sign is rounding.
  static constexpr int halvings = 6;

  double normal_force(const State& y) const {
    return c_.mass * (SlotRoller::g * std::cos(y[0]) + A_ * y[1] * y[1]);
  }
  double slip(const State& y) const { return A_ * y[1] + c_.radius * y[2]; }
  double rolling_force(const State& y) const {
    return -c_.weight() * std::sin(y[0]) * c_.kappa / (1.0 + c_.kappa);
  }
  bool holds(const State& y) const {
    return std::abs(rolling_force(y)) <= c_.mu_static * normal_force(y);
  }
  void rolls_or_skids() { skids_ = holds(y_) ? 0.0 : y_[0] > 0.0 ? -1.0 : 1.0; }

  State rate(const State& y) const {
    const double T = skids_ == 0.0 ? rolling_force(y) : skids_ * c_.mu * normal_force(y);
    return {y[1], -(SlotRoller::g * std::sin(y[0]) + T / c_.mass) / A_,
            -T * c_.radius / c_.inertia()};
  }
  State after(double h) const {
    const auto moved = [&](const State& k, double by) {
      State y = y_;
      for (std::size_t i = 0; i < y.size(); ++i) y[i] += by * k[i];
      return y;
    };
    const State a = rate(y_), b = rate(moved(a, 0.5 * h)), c = rate(moved(b, 0.5 * h)),
                d = rate(moved(c, h));
    State y = y_;
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
    return y;
  }
  void take(double h, int left) {
    const State next = after(h);
    const bool changes = skids_ == 0.0 ? !holds(next) : skids_ * slip(next) < 0.0;
    if (changes && left > 0) {
      take(0.5 * h, left - 1);
      take(0.5 * h, left - 1);
      return;
    }
    y_ = next;
    if (changes) rolls_or_skids();
  }

  const SlotRoller& c_;
  double A_;
  State y_;
  double skids_ = 0.0;  // 0: rolls; else the sign of the slip
};

std::vector<Check> slot_roller_checks(const Parameters& p, const WallLaws& laws,
                                      const Result& run) {
  const SlotRoller c(p);
  const ContactLaw& law = laws["slot"];
  const double depth = law.elastic.penetration_at(3.0 * c.weight());  // at the bottom of a swing
  std::vector<Check> checks;
  if (law.friction.holds()) {
    const Eigen::VectorXd t = run["t_s"], x = run["roller.x_m"], y = run["roller.y_m"];
    const Eigen::VectorXd spin = run["roller.omega_rad_per_s"];
    RigidRoller rigid(c);
    double off = 0.0, spin_off = 0.0;
    for (Eigen::Index i = 0; i < t.size(); ++i) {
      off = std::max(off, std::abs(std::atan2(x[i], -y[i]) - rigid.angle()));
      spin_off = std::max(spin_off, std::abs(spin[i] - rigid.spin()));
      if (i + 1 < t.size()) rigid.advance(t[i + 1] - t[i], 20);
    }
    const double share = 50.0 * depth / c.path;
    checks.push_back({.what = "angle differs from a rigid roller's by up to",
                      .value = off,
                      .unit = "rad",
                      .tolerance = share + tolerance_of(run, 1.0),
                      .remark = "rolling and skidding, another integrator"});
    const double fastest = std::sqrt(SlotRoller::g * c.path) / c.radius;
    checks.push_back({.what = "spin differs from it by up to",
                      .value = spin_off,
                      .unit = "rad/s",
                      .tolerance = (share + tolerance_of(run, 1.0)) * fastest,
                      .remark = "likewise"});
  }
  checks.push_back(energy_check(run, c.weight() * depth));
  return checks;
}

}  // namespace

Case slot_roller_case() {
  std::vector<CaseParameter> parameters = {
      {.name = "path",
       .quantity = Quantity::length,
       .default_text = "100mm",
       .low = 1.0_mm,
       .high = 10.0,
       .description = "radius of the centreline of the slot"},
      {.name = "roller",
       .quantity = Quantity::length,
       .default_text = "10mm",
       .low = 0.1_mm,
       .high = 1.0,
       .description = "radius of the roller"},
      {.name = "clearance",
       .quantity = Quantity::length,
       .default_text = "0.2mm",
       .low = 1e-6,
       .high = 0.1,
       .description = "between roller and slot, to each side"},
      mass_parameter("mass", "0.1", "of the roller, in kg"),
      {.name = "inertia",
       .quantity = Quantity::number,
       .default_text = "0.5",
       .low = 0.01,
       .high = 1.0,
       .description = "kappa of I = kappa m r^2; 0.5 is a uniform disc, 1 a hoop"},
      {.name = "start",
       .quantity = Quantity::angle,
       .default_text = "70deg",
       .low = 0.1_deg,
       .high = 80.0_deg,
       .description = "from the lowest place of the slot, where it is let go"},
      {.name = "duration",
       .quantity = Quantity::time,
       .default_text = "1s",
       .low = 1e-3,
       .high = 1000.0,
       .description = "of the run"}};
  for (CaseParameter& p : friction_parameters("0.2", "0.2")) parameters.push_back(std::move(p));
  return {
      .name = "slot_roller",
      .group = "friction",
      .description = "a free roller in a circular slot: it rolls, skids, or both",
      .parameters = std::move(parameters),
      .contact = friction_laws(
          [](const Parameters& p) { return std::vector{flat_wall("slot", p.number("roller"))}; },
          [](const Parameters& p) {
            const SlotRoller c(p);
            return Pressed{c.mass, c.weight()};
          }),
      .default_output = "results/slot_roller",
      .model = [](const Parameters& p,
                  const WallLaws& laws) { return slot_roller_model(SlotRoller(p), laws); },
      .duration = [](const Parameters& p) { return p.number("duration"); },
      .checks_hold_with_friction = true,
      .law_checks = slot_roller_checks};
}

}  // namespace yoke::cases
