// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Which friction holds. At an event, all friction that is at rest (grip held, carried or undecided, or
// sliding at a rate that is rounding) is settled together: for each either
//
//   at rest   |T| <= holding force, and no acceleration along the surface
//   slides    T is the law's, against the direction in which it begins to slide
//
// Normal forces are functions of the state, so this is the optimality condition of a convex problem
// with bounds (the accelerations of least constraint, |T| <= mu N) and has a solution where static and
// kinetic friction are equal. It is found by pivoting from "all at rest": the worst violation first,
// later the first in order, which cannot cycle (K.G. Murty, Linear Complementarity, Linear and Nonlinear
// Programming, 1988, ch. 4). What broke at this instant does not hold again at it.
//
// Rows at rest that depend on others get none (Grip::carried): two feet of a rigid block, say.
// Dynamics::share_hold_forces() says how they share. Those that joints and drivers leave no motion get
// none and bear nothing (Grip::guided): there is no telling what they bear.
#pragma once

#include <span>
#include <vector>

#include <yoke/core/equations/dynamics.hpp>

namespace yoke {

/// Settles the grips of `state`, which is on the constraints, and makes its velocities and accelerations
/// agree. `before` [contacts] are the memories before the event. Not ok: no friction forces are
/// consistent; `why` names the elements.
Outcome settle_grips(Dynamics& dynamics, State& state, std::span<const ContactMemory> before);

/// Projects the velocities of `state` after a blow, which friction, of a finite force, cannot hold: what
/// rested and moves now slides. To be settled afterwards. False: not finite.
bool let_go_of_grips(Dynamics& dynamics, State& state);

}  // namespace yoke
