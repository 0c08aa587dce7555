// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Closed forms of the two cases of forced impacts, for their checks and for who verifies maps with them.
#pragma once

#include <optional>
#include <vector>

#include <yoke/cases/impacts/impact_laws.hpp>

namespace yoke::cases {

/// A periodic motion with one impact in n periods of the force, at a rigid stop.
struct ImpactOrbit {
  double phase = 0.0;     // [rad] w t at the impact, 0 to 2 pi
  double approach = 0.0;  // [m/s] > 0
};

/// A mass on a spring and a damper under F cos(w t), and a stop.
struct ImpactOscillator {
  double mass = 1.0;         // [kg]
  double spring = 1.0;       // [N/m]
  double damping = 0.0;      // [N s/m]
  double force = 1.0;        // [N]
  double frequency = 1.0;    // [Hz]
  double gap = 0.0;          // [m]
  double restitution = 1.0;  // of the rigid stop

  double omega() const;         ///< [rad/s] of the force
  double decay() const;         ///< [1/s] c / (2 m)
  double damped_omega() const;  ///< [rad/s] of free oscillations; needs k/m > decay()^2
  double amplitude() const;     ///< [m] A of the steady state without impacts
  double lag() const;           ///< [rad] p, by which it follows the force
  /// [N] at which the steady state just reaches the stop.
  double grazing_force() const;
  /// [m] without impacts, from position [m] and speed [m/s] at t = 0.
  double free_motion(double x, double speed, double t) const;
  /// [m/s] likewise.
  double free_speed(double x, double speed, double t) const;
  /// Motions with one impact in `n` periods that keep away from the stop in between, at most two.
  std::vector<ImpactOrbit> impact_orbits(int n) const;
};

/// A ball that bounces on a table y = a sin(w t), rigid, restitution e. With G = (1 + e) a w^2 / g it has
/// orbits with one impact in n periods between two bounds of a.
struct TableBall {
  double amplitude = 0.0;    // [m] a
  double frequency = 1.0;    // [Hz]
  double restitution = 1.0;  // e

  double omega() const;                ///< [rad/s]
  double table(double t) const;        ///< [m] its height
  double table_speed(double t) const;  ///< [m/s]

  struct Impact {
    double t = 0.0;        // [s]
    double rebound = 0.0;  // [m/s] of the ball behind the impact, > 0 upwards
  };
  /// The next impact: the exact map, the flight's end found to rounding.
  Impact next(const Impact& from) const;
  /// The same for bounces high beside the amplitude: t' = t + 2 v/g, v' = e v + (1 + e) a w cos(w t').
  Impact next_high(const Impact& from) const;
  /// [m] Amplitude from which on there is an orbit with one impact in n periods:
  /// a w^2 = g n pi (1 - e) / (1 + e).
  double first_amplitude(int n) const;
  /// [m] And where it becomes unstable and its period doubles, in the exact map:
  /// a w^2 = g sqrt((n pi (1 - e)/(1 + e))^2 + (2 (1 + e^2)/(1 + e)^2)^2); in the high one the second term is 1.
  double flip_amplitude(int n) const;
  double high_flip_amplitude(int n) const;  ///< [m] the same of next_high()
  /// The stable orbit with one impact in n periods; none outside of its existence.
  std::optional<Impact> orbit(int n) const;
};

}  // namespace yoke::cases
