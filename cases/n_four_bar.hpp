// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The N-four-bar mechanism, problem A02 of the IFToMM library of multibody benchmarks: N four-bar
// loops side by side, all links alike, so that every link is in line twice a cycle, where the rank
// of the constraints falls by N for an instant.
#pragma once

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <string>

#include <yoke/core/model.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

/// What may be changed; the defaults are the benchmark's.
struct NFourBar {
  int loops = 1;
  double angle = pi / 2.0;  // [rad] of the upright links at the start
  double speed = 1.0;       // [m/s] of their tips, clockwise
  double length = 1.0;      // [m]
  double mass = 1.0;        // [kg]
};

/// Bodies "link 0" ... upright, "bar 1" ... across; joints "pivot i", "left i", "right i", the bar
/// i between links i - 1 and i.
inline Model n_four_bar(const NFourBar& o = {}) {
  Model model;
  const double l = o.length, inertia = o.mass * l * l / 12.0, omega = -o.speed / l;
  const Vec2 along = rotate(o.angle, {l, 0.0});
  BodyId last;
  for (int i = 0; i <= o.loops; ++i) {
    const std::string n = std::to_string(i);
    const Vec2 foot(i * l, 0.0), tip = foot + along;
    const BodyId link = model.add(Body{.name = "link " + n,
                                       .mass = o.mass,
                                       .inertia = inertia,
                                       .pose = {foot + 0.5 * along, o.angle},
                                       .twist = {0.5 * omega * perp(along), omega}});
    model.add(Revolute{.name = "pivot " + n, .a = ground, .b = link, .at = foot});
    if (i > 0) {
      const Vec2 before = tip - Vec2(l, 0.0);
      const BodyId bar = model.add(Body{.name = "bar " + n,
                                        .mass = o.mass,
                                        .inertia = inertia,
                                        .pose = {0.5 * (before + tip), 0.0},
                                        .twist = {omega * perp(along), 0.0}});
      model.add(Revolute{.name = "left " + n, .a = last, .b = bar, .at = before});
      model.add(Revolute{.name = "right " + n, .a = bar, .b = link, .at = tip});
    }
    last = link;
  }
  model.add(Gravity{});
  return model;
}

/// Angle [rad] of the upright links at time t for the defaults but N: theta'' = -k cos(theta),
/// k = 3 g (3N + 1) / (2 (4N + 1)), from the top with -1 rad/s, by Jacobi's amplitude.
inline double n_four_bar_angle(int loops, double t) {
  const double k = 1.5 * 9.81 * (3.0 * loops + 1.0) / (4.0 * loops + 1.0);
  const double modulus = std::sqrt(4.0 * k / (1.0 + 4.0 * k));
  const double K = boost::math::ellint_1(modulus);
  const double u = K - 0.5 * std::sqrt(1.0 + 4.0 * k) * t;
  const double turns = std::round(u / (2.0 * K));
  double cn = 1.0, dn = 1.0;
  const double sn = boost::math::jacobi_elliptic(modulus, u - 2.0 * K * turns, &cn, &dn);
  return 2.0 * (turns * pi + std::atan2(sn, cn)) - 0.5 * pi;
}

}  // namespace yoke::cases
