// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Four problems that two programs solve, each as one of its users would write them, and three of them by
// hand. What is compared is a coordinate at equal distances in time.
#pragma once

#include <cmath>
#include <vector>

namespace yoke::bench::peer {

/// What a program gives for one accuracy that it is asked for.
struct Trajectory {
  std::vector<double> values;  // of all that is compared, one time after the other
  double seconds = 0.0;        // processor time of the run, from the finished model
};

inline constexpr int samples = 21;
/// Time [s] of sample i of a run of `end` seconds; the start is one of them.
inline double sample_time(int i, double end) { return end * i / (samples - 1.0); }

/// P1: links of 1 m and 1 kg, uniform, hang from one another, horizontal at the start; y of the ends of all
/// [m].
inline constexpr double chain_end = 1.0;  // [s]
Trajectory yoke_chain(int links, double accuracy);
Trajectory simbody_chain(int links, double accuracy);
Trajectory chain_by_hand(double accuracy);  // of ten links

/// P2: N four-bar loops side by side, benchmark A02; x of the tip of the first link [m].
inline constexpr double four_bar_end = 10.0;  // [s]
Trajectory yoke_four_bar(int loops, double accuracy);
Trajectory simbody_four_bar(int loops, double accuracy);
std::vector<double> exact_four_bar(int loops);

/// P3: the scotch-yoke with a curved slot, clearance 0.1 mm, F = K d^1.1 (1 + 3/2 alpha d'); x of the
/// slider [m].
namespace yoke_data {
inline constexpr double crank = 0.045, radius = 0.060, clearance = 1e-4;   // [m]
inline constexpr double slider_mass = 2.353;                               // [kg]
inline constexpr double speed = 24.0 * 3.14159265358979323846;             // [rad/s]
inline constexpr double start = -31.0 * 3.14159265358979323846 / 180.0;    // [rad]
inline constexpr double alpha = 0.32;                                      // [s/m]
inline constexpr double end = 2.0 * 2.0 * 3.14159265358979323846 / speed;  // [s]
/// [N/m^1.1] of the inner and the outer wall.
inline double stiffness(bool outer) { return (outer ? 4.907e4 : 4.914e4) * std::pow(1000.0, 1.1); }
/// Of the arc's centre, without clearance: [m] and [m/s].
inline double slider_x() {
  return crank * std::cos(start) +
         std::sqrt(radius * radius - std::pow(crank * std::sin(start), 2));
}
inline double slider_v() {
  const double root = std::sqrt(radius * radius - std::pow(crank * std::sin(start), 2));
  return -crank * std::sin(start) * (1.0 + crank * std::cos(start) / root) * speed;
}
}  // namespace yoke_data
Trajectory yoke_scotch_yoke(double accuracy);
Trajectory simbody_scotch_yoke(double accuracy);
Trajectory scotch_yoke_by_hand(double accuracy);

/// P4: a disc falls on a floor and bounces, F = K d^1.5 (1 + 3/2 alpha d'); y of its centre [m].
namespace disc_data {
inline constexpr double end = 2.0, height = 0.25, radius = 0.05;  // [s], [m]
inline constexpr double mass = 1.0, gravity = 9.81;               // [kg], [m/s^2]
inline constexpr double stiffness = 1e9, alpha = 0.05;            // [N/m^1.5], [s/m]
}  // namespace disc_data
Trajectory yoke_disc(double accuracy);
Trajectory simbody_disc(double accuracy);
Trajectory disc_by_hand(double accuracy);

}  // namespace yoke::bench::peer
