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
#include <yoke/core/result.hpp>

namespace yoke::cases {

/// The coordinates above, their rates, their second derivatives and the multipliers, at one time.
struct AndrewsState {
  std::array<double, 7> p{}, v{}, a{};
  std::array<double, 6> lambda{};
};

/// Bodies "K1" ... "K7", ten revolute joints, a spring, a torque: all from the library. The three
/// joints at E are "E3", "E4" and "E6".
Model andrews();

/// The same from a user's own elements: one joint "E" that holds the four bodies at E together by
/// six equations, written as the problem writes them, and a spring of its own; a torque from a
/// lambda.
Model andrews_own_elements();

/// The last sample of a run of either model in the coordinates of the problem.
AndrewsState andrews_end(const Result& run);

/// At 0.03 s as published: PSIDE on a Cray C90, tolerance 1e-14. Good to about 1e-9 in p, 1e-7 in
/// v, 3e-6 in a and lambda, relative: quadruple precision differs by that much.
const AndrewsState& andrews_published();

/// At time t [s] from the published equations M(p) p'' + G^T lambda = f, G p'' = -G' p' by a
/// Runge-Kutta-Fehlberg method of order 7(8), tolerance 1e-14: nothing of the engine but its
/// scalars for automatic differentiation, of which G and G' p' are made.
AndrewsState andrews_by_published_equations(double t);

}  // namespace yoke::cases
