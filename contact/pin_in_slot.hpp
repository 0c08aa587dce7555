// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A round pin of one body in the slot of another, with clearance. With P the pin's centre, s = P -
// r_a and w = P - r_b the arms, n the normal towards the wall and t = perp(n) in global axes, bend
// the curvature of the distance to the centreline (slot.hpp), over (r_a, angle_a, r_b, angle_b):
//   d = D - (half_width - pin radius)
//   g = [n, n.perp(s), -n, -n.perp(w)]      tau = the same with t for n
//   H = bend tau^T tau, and in addition
//       H[angle_a, angle_a] -= n.s      H[angle_b, angle_b] -= n.w      H[angle_a, angle_b] += n.s
//       H[r_a, angle_b] += perp(n)      H[r_b, angle_b] -= perp(n)
#pragma once

#include <memory>
#include <string>

#include <yoke/contact/geometry/slot.hpp>
#include <yoke/contact/laws/law.hpp>
#include <yoke/core/force.hpp>

namespace yoke {

/// One law for each region of a slot; a single law serves for all.
struct SlotLaws {
  SlotLaws(ContactLaw all) : inner(all), outer(all), cap(std::move(all)) {}
  SlotLaws(ContactLaw at_inner, ContactLaw at_outer, ContactLaw at_cap)
      : inner(std::move(at_inner)), outer(std::move(at_outer)), cap(std::move(at_cap)) {}
  ContactLaw inner, outer, cap;
};

struct Pin {
  BodyId body;
  Vec2 at{0.0, 0.0};    // [m] its centre, a global point in the start pose
  double radius = 0.0;  // [m] > 0, smaller than the half-width of the slot
};

struct SlotOn {
  BodyId body;
  Slot slot;  // placed by global geometry in the start pose: arc_slot({...})
};

/// m.add(PinInSlot{.name = "slot", .pin = {crank, tip, 7.9_mm}, .slot = {slider, arc_slot({...})},
///                 .law = ContactLaw{per_mm(49070, 1.10), HuntCrossley{0.32}}});
/// The normal points from the centreline to the wall touched. Without friction.
struct PinInSlot {
  std::string name;
  Pin pin;
  SlotOn slot;
  SlotLaws law;
  double reference_force = 100.0;  // [N] a light load; its penetration sets the error weights

  std::unique_ptr<ForceElement> build(const Model& model) const;
};

}  // namespace yoke
