// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A wall along a curve as a profile (slot.hpp, half-width 0), seen from a disc on one side:
//   wall   D = -D_c        D_c distance from the curve, > 0 on the disc's side
//   edge   D = -|p - T|    an end of the curve, or a corner that points at the disc
#pragma once

#include <yoke/contact/geometry/slot.hpp>
#include <yoke/core/curves/curve.hpp>

namespace yoke {

/// A wall along a curve and the disc that it is for.
struct WallAlong {
  Curve curve;               // in the frame of the profile
  bool disc_on_left = true;  // seen along the curve; the material is on the other side
  double disc_radius = 0.0;  // [m]
  double thickness = 0.0;    // [m], may be infinite
};

/// The profile, its frame that of the curve. Throws ModelError when a contact is built on it.
Slot wall_profile(const WallAlong& wall);

}  // namespace yoke
