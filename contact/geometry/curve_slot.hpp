// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A slot of constant width along any curve, as a cutter of its width would mill it. With D_c the
// distance of the pin's centre p from the centreline, > 0 on its left, k its curvature, h the
// half-width:
//   left    D = D_c        wall of curvature  k/(1 - k h)     (> 0 convex, as the pin sees it)
//   right   D = -D_c       wall of curvature -k/(1 + k h)
//   cap     D = |p - e|    round end about the end e of the centreline, concave, radius h
//   corner  D = |p - c|    outside of a corner c of the centreline, concave, radius h
//   edge    D = h + r - |p - T|    convex edge of radius r about T: the inside of a corner (r = 0),
//                          or an open end, where the pin leaves and enters
//   end     D = (p - e).t  flat end, h beyond the end e of the centreline of direction t
// A flat end is a contact of its own ("slot start", "slot end" for a slot named "slot"), as the pin
// may touch it and a side at once.
#pragma once

#include <yoke/contact/geometry/slot.hpp>
#include <yoke/core/curves/curve.hpp>

namespace yoke {

/// What is at an end of a slot.
enum class SlotEnd {
  round,  ///< semicircle about the end of the centreline
  flat,   ///< wall across, half a width beyond the end of the centreline
  open,   ///< at the end of the centreline
};

/// Placed by global geometry in the start pose. A closed centreline has no ends.
struct CurveSlot {
  Curve centreline;                // along which a cutter of the slot's width goes
  double half_width = 0.0;         // [m] > 0
  SlotEnd start = SlotEnd::round;  // where the centreline begins
  SlotEnd end = SlotEnd::round;    // where it ends
  double edge_radius = 0.0;        // [m] >= 0, of the edges at open ends, 0: sharp or no such end
};

/// Throws ModelError when a contact is built on it: for ends or edges that there are not, a wall whose radius would be below zero (the
/// centreline bends more than the half-width allows), walls that meet because the centreline crosses
/// or comes close to itself, a corner that its neighbours are too short for.
Slot curve_slot(const CurveSlot& slot);

}  // namespace yoke
