// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Andrews' squeezing mechanism: seven bodies K1 ... K7 in the plane, driven by a constant torque on
// K1, held by a spring; problem II-8 of the test set for IVP solvers (F. Mazzia, C. Magherini,
// release 2.4, 2008), described by E. Hairer and G. Wanner, Solving Ordinary Differential
// Equations II, section VII.7. Its seven coordinates are
//
//   beta, Theta, gamma, Phi, delta, Omega, epsilon
//
// where the angles of the bodies K1 ... K7 are beta, beta + Theta, gamma, Phi + delta, delta,
// Omega + epsilon, epsilon, and its six equations close three loops at the point E:
//
//   E by K1 K2 = E by K3,   = E by K5 K4,   = E by K7 K6
//
// Its multipliers are therefore the forces K2 puts on K3, K4 and K6 there.
#pragma once

#include <array>

#include <yoke/core/model.hpp>

namespace yoke::cases {

namespace andrews_data {
// Names as in the test set; kg, kg m^2, m, N/m, N m.
inline constexpr double m1 = 0.04325, m2 = 0.00365, m3 = 0.02373, m4 = 0.00706, m5 = 0.07050,
                        m6 = 0.00706, m7 = 0.05498;
inline constexpr double I1 = 2.194e-6, I2 = 4.410e-7, I3 = 5.255e-6, I4 = 5.667e-7, I5 = 1.169e-5,
                        I6 = 5.667e-7, I7 = 1.912e-5;
inline constexpr double xa = -0.06934, ya = -0.00227, xb = -0.03635, yb = 0.03273, xc = 0.014,
                        yc = 0.072;
inline constexpr double d = 0.028, da = 0.0115, e = 0.02, ea = 0.01421, rr = 0.007, ra = 0.00092;
inline constexpr double ss = 0.035, sa = 0.01874, sb = 0.01043, sc = 0.018, sd = 0.02;
inline constexpr double ta = 0.02308, tb = 0.00916, u = 0.04, ua = 0.01228, ub = 0.00449;
inline constexpr double zf = 0.02, zt = 0.04, fa = 0.01421;
inline constexpr double c0 = 4530.0, l0 = 0.07785, mom = 0.033;

inline const Vec2 O{0.0, 0.0}, A{xa, ya}, B{xb, yb}, C{xc, yc};

inline constexpr std::array<double, 7> start = {
    -0.0617138900142764496358948458001, 0.0,
    0.455279819163070380255912382449,   0.222668390165885884674473185609,
    0.487364979543842550225598953530,   -0.222668390165885884674473185609,
    1.23054744454982119249735015568};
}  // namespace andrews_data

/// The bodies where they start, and the points they are joined at. Where a centre of mass lies is
/// given by the distance from the joint alone for K3, K5 and K7, in any direction: no weight acts.
struct AndrewsBodies {
  std::array<BodyId, 8> k{};  // k[1] ... k[7]
  Vec2 F, E, G, H, D;
};
AndrewsBodies add_andrews_bodies(Model& m);
/// All joints but those at E.
void add_andrews_joints(Model& m, const AndrewsBodies& b);

/// Bodies "K1" ... "K7", ten revolute joints, a spring, a torque: all from the library. The three
/// joints at E are "E3", "E4" and "E6".
Model andrews();

}  // namespace yoke::cases
