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

}  // namespace yoke::tests
