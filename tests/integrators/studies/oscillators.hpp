// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Oscillators whose orbits are known in closed form.
#pragma once

#include <cmath>

#include <yoke/yoke.hpp>

namespace yoke::tests {

using namespace yoke::literals;

/// 1 kg on a spring and a damper, driven by F cos(omega t).
struct ForcedOscillator {
  double stiffness = 100.0, damping = 0.8, force = 3.0, omega = 7.0;

  Model model() const {
    Model m;
    const BodyId mass = m.add({.name = "mass", .mass = 1.0, .inertia = 1.0});
    m.add(Prismatic{.name = "guide", .a = ground, .b = mass});
    m.add(TranslationalSpring{.name = "spring",
                              .a = ground,
                              .b = mass,
                              .at_a = {-1.0, 0.0},
                              .at_b = {0.0, 0.0},
                              .stiffness = stiffness,
                              .damping = damping});
    m.add(AppliedForce{.name = "force", .body = mass, .force = [*this](double t) {
                         return Vec2(force * std::cos(omega * t), 0.0);
                       }});
    return m;
  }
};

/// x'' - mu (1 - x^2) x' + x = 0 from x, at rest.
inline Model van_der_pol(double mu, double x) {
  Model m;
  const BodyId mass = m.add({.name = "mass", .mass = 1.0, .inertia = 1.0, .pose = {{x, 0.0}, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = mass});
  m.add(applied_force("force", mass, {x, 0.0}, [mu](const auto&, const auto& body) {
    using T = std::decay_t<decltype(body.x)>;
    const T f = mu * (1.0 - body.x * body.x) * body.vx - body.x;
    return Eigen::Vector2<T>(f, T(0.0));
  }));
  return m;
}

/// A ball on a table that vibrates, y = A sin(w t), 30 Hz: once up and down a period. Of rigid bodies: with
/// Gamma = A w^2 / g and r the restitution it leaves with g T / 2 where
///   Gamma cos(phi) = pi (1 - r) / (1 + r)
/// and its map has the determinant r^2 and the trace 1 + r^2 - (1 + r)^2 Gamma sin(phi): S F with the flight
/// F = [1 T; 0 1] and the impact S = [-r 0; (1 + r) a / u, -r], a = g (Gamma sin(phi) - 1) and u the relative
/// acceleration and velocity before it. It flips at Gamma sin(phi) = 2 (1 + r^2) / (1 + r)^2.
/// The contact is a spring and a damper that have the same restitution.
struct VibratingTable {
  double acceleration = 0.8;  // Gamma
  double restitution = 0.8;
  double stiffness = 1e7;  // [N/m]

  static constexpr double mass = 0.1, g = 9.81;
  double omega() const { return 2.0 * pi * 30.0; }
  double period() const { return 2.0 * pi / omega(); }
  double phase() const {
    return std::acos(pi * (1.0 - restitution) / (1.0 + restitution) / acceleration);
  }
  double determinant() const { return restitution * restitution; }
  double trace() const {
    const double r = restitution;
    return 1.0 + r * r - (1.0 + r) * (1.0 + r) * acceleration * std::sin(phase());
  }
  static double flip(double r) {
    return std::hypot(pi * (1.0 - r) / (1.0 + r), 2.0 * (1.0 + r * r) / ((1.0 + r) * (1.0 + r)));
  }
  /// How long a contact takes, as a share of the period.
  double contact_share() const { return pi * std::sqrt(mass / stiffness) / period(); }

  /// At t = 0 on the orbit of rigid bodies.
  Model model() const {
    const double A = acceleration * g / (omega() * omega()), t = phase() / omega();
    const double up = 0.5 * g * period();
    const Vec2 centre(0.0, 0.02 + A * std::sin(phase()) + up * t - 0.5 * g * t * t);
    Model m;
    const BodyId table = m.add({.name = "table", .mass = 1.0, .inertia = 1.0});
    const BodyId ball = m.add({.name = "ball",
                               .mass = mass,
                               .inertia = 2e-5,
                               .pose = {centre, 0.0},
                               .twist = {{0.0, g * t - up}, 0.0}});
    m.add(Gravity{.name = "gravity", .acceleration = {0.0, -g}});
    m.add(Prismatic{.name = "table_guide", .a = ground, .b = table, .along = {0.0, 1.0}});
    m.add(Prismatic{.name = "ball_guide", .a = ground, .b = ball, .along = {0.0, 1.0}});
    m.add(DisplacementDriver{.name = "shaker",
                             .body = table,
                             .along = {0.0, 1.0},
                             .displacement = time_function([A, w = omega()](auto s) {
                               using std::sin;
                               return A * sin(w * s);
                             })});
    m.add(DiscOnCurve{.name = "contact",
                      .disc = {ball, centre, 20.0_mm},
                      .body = table,
                      .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                      .law = ContactLaw{PowerLaw{stiffness, 1.0}, KelvinVoigt{.e = restitution}}});
    return m;
  }
};

/// x'' + 2 d x' + x = F cos(w t) that strikes a stop at x = gap once in a period of the force. Between the
/// impacts, at t = 0 and T, of rigid bodies
///   x = e^-dt (a cos + b sin)(w_d t) + c cos(w t) - s sin(w t)      c^2 + s^2 = F^2 / ((1-w^2)^2 + (2dw)^2)
/// with x(0) = x(T) = gap and x'(0) = -r x'(T), a quadratic equation for a. Over a period S F, with F the flow
/// of the free oscillator and S = [-r 0; (r x''(T) + x''(0)) / x'(T), -r].
struct ImpactOscillator {
  double omega = 2.6, force = 1.0, damping = 0.05, gap = 0.0, restitution = 0.8;
  double stiffness = 1e8;  // [N/m] of the stop

  struct Rigid {
    double speed;  // [m/s] of the impact
    double phase;  // of the force at the impact
    double trace, determinant;
    double x, v;  // half a period after the impact
  };

  double period() const { return 2.0 * pi / omega; }
  Rigid rigid() const {
    const double d = damping, r = restitution, T = period(), wd = std::sqrt(1.0 - d * d);
    const double e = std::exp(-d * T), C = std::cos(wd * T), S = std::sin(wd * T);
    const double A = force / std::hypot(1.0 - omega * omega, 2.0 * d * omega);
    // Per unit of a: b, and from x'(0) + r x'(T) = 0 the rate s w of the forced part.
    const double b = (1.0 - e * C) / (e * S);
    const double free_0 = -d + wd * b, free_T = e * (-d * (C + b * S) + wd * (b * C - S));
    const double sw = (free_0 + r * free_T) / (1.0 + r);
    // (gap - a)^2 + (sw a / w)^2 = A^2; the impact is towards the stop: x'(T) > 0.
    const double k = 1.0 + sw * sw / (omega * omega),
                 root = std::sqrt(gap * gap - k * (gap * gap - A * A));
    double a = (gap + root) / k;
    if ((free_T - sw) * a < 0.0) a = (gap - root) / k;
    const double c = gap - a, s = sw * a / omega, u = (free_T - sw) * a, v0 = -r * u;
    const double lag = std::atan2(2.0 * d * omega, 1.0 - omega * omega);
    const double phase = std::atan2(s, c) + lag;  // x_p = A cos(w t + psi), psi = phase - lag
    const auto acceleration = [&](double v) { return force * std::cos(phase) - 2.0 * d * v - gap; };
    const double S21 = (r * acceleration(u) + acceleration(v0)) / u;
    // F = e [C + d S / wd, S / wd; -S / wd, C - d S / wd]
    const double F11 = e * (C + d * S / wd), F12 = e * S / wd, F22 = e * (C - d * S / wd);
    const double t = 0.5 * T, h = std::exp(-d * t), Ct = std::cos(wd * t), St = std::sin(wd * t);
    return {.speed = u,
            .phase = phase,
            .trace = -r * F11 + S21 * F12 - r * F22,
            .determinant = r * r * e * e,
            .x = h * a * (Ct + b * St) - c,
            .v = h * a * (-d * (Ct + b * St) + wd * (b * Ct - St)) + s * omega};
  }

  /// From half a period after the impact on the orbit of rigid bodies, 1 kg.
  Model model() const {
    const Rigid at = rigid();
    Model m;
    const BodyId mass = m.add({.name = "mass",
                               .mass = 1.0,
                               .inertia = 1.0,
                               .pose = {{at.x, 0.0}, 0.0},
                               .twist = {{at.v, 0.0}, 0.0}});
    m.add(Prismatic{.name = "guide", .a = ground, .b = mass});
    m.add(TranslationalSpring{.name = "spring",
                              .a = ground,
                              .b = mass,
                              .at_a = {-10.0, 0.0},
                              .at_b = {at.x, 0.0},
                              .stiffness = 1.0,
                              .damping = 2.0 * damping,
                              .free_length = 10.0});
    m.add(AppliedForce{.name = "force",
                       .body = mass,
                       .at = {at.x, 0.0},
                       .force = [o = *this, phase = at.phase](double t) {
                         return Vec2(-o.force * std::cos(o.omega * t + phase), 0.0);
                       }});
    m.add(DiscOnCurve{.name = "stop",
                      .disc = {mass, {at.x, 0.0}, 0.1},
                      .body = ground,
                      .curve = straight_line({gap + 0.1, 0.0}, {0.0, 1.0}),
                      .law = ContactLaw{PowerLaw{stiffness, 1.0}, KelvinVoigt{.e = restitution}}});
    return m;
  }
};

}  // namespace yoke::tests
