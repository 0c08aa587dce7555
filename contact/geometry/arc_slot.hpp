// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A slot along a circular arc with semicircular ends. In the profile's frame the centre of the arc
// is the origin and the middle of the arc lies on the x axis; R radius of the centreline, h
// half-width:
//   outer  D = |p| - R        wall of radius R + h, concave; bend  1/|p|
//   inner  D = R - |p|        wall of radius R - h, convex;  bend -1/|p|
//   cap    D = |p - e|        wall of radius h, concave;     bend  1/D, e the end of the centreline
#pragma once

#include <yoke/contact/geometry/slot.hpp>

namespace yoke {

/// Placed by global geometry in the start pose.
struct ArcSlot {
  Vec2 center{0.0, 0.0};    // [m] of the arc
  double radius = 0.0;      // [m] of the centreline, > half_width
  double direction = 0.0;   // [rad] from the centre to the middle of the arc, from the x axis
  double angle = 0.0;       // [rad] of the arc, 0 < angle < 2 pi, and so that the caps do not meet
  double half_width = 0.0;  // [m] > 0
};

/// The arc starts at direction - angle/2 (cap_start) and ends at direction + angle/2 (cap_end). Its
/// dimensions are checked when a contact is built on it, so that the message can name the contact.
Slot arc_slot(const ArcSlot& arc);

}  // namespace yoke
