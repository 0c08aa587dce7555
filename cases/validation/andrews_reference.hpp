// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What Andrews' squeezing mechanism (cases/andrews.hpp) must do, in the coordinates of the problem.
#pragma once

#include <array>

#include <yoke/core/model.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

/// The coordinates of the problem, their rates, their second derivatives and the multipliers, at
/// one time.
struct AndrewsState {
  std::array<double, 7> p{}, v{}, a{};
  std::array<double, 6> lambda{};
};

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
