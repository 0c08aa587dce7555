// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Joints with clearance: what their field `clearance` takes (core/clearance.hpp). Ideal and real
// joint share name and place, and the results of both can be laid over one another.
#pragma once

#include <yoke/contact/geometry/curve_slot.hpp>
#include <yoke/contact/laws/law.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/clearance.hpp>

namespace yoke {

/// Of Revolute: a journal on body b in a bore of body a, both about the joint's point at the start.
struct BearingClearance {
  double journal_radius = 0.0;  // [m] > 0
  double radial = 0.0;          // [m] > 0, radius of the bore minus that of the journal
  WallLaw law;
  double reference_force = 100.0;  // [N] its penetration sets the error weights

  Elements elements(const Model& model, const JointPlace& place) const;
};

/// Of Prismatic: a block on body b between two parallel walls of body a. Four contacts, one for each
/// corner of the block, "NAME front left" to "NAME back right" as seen along the guide.
struct GuideClearance {
  double length = 0.0;  // [m] > 0 of the block, along the guide
  double width = 0.0;   // [m] > 0 of the block, across
  double gap = 0.0;     // [m] > 0 between block and wall on each side, the block in the middle
  WallLaw law;
  double corner_radius = 0.0;      // [m] >= 0 of the block's corners, within its outline
  double reference_force = 100.0;  // [N] as above

  Elements elements(const Model& model, const JointPlace& place) const;
};

/// Of PointOnCurve: a pin on body a in a slot of body b along the curve.
struct SlotClearance {
  double pin_radius = 0.0;  // [m] > 0
  double radial = 0.0;      // [m] > 0, half-width of the slot minus the pin's radius
  SlotLaws law;
  SlotEnd start = SlotEnd::round;  // at the first end of the curve
  SlotEnd end = SlotEnd::round;    // at the last end of the curve
  double edge_radius = 0.0;        // [m] of open ends, see CurveSlot
  double reference_force = 100.0;  // [N] as above

  Elements elements(const Model& model, const JointPlace& place) const;
};

}  // namespace yoke
