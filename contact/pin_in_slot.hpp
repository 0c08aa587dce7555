// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A round pin of one body in the slot of another, with clearance. With D the distance of the pin's
// centre from the centreline (contact/geometry/slot.hpp)
//   d = D - (half_width - pin radius)
// and its derivatives as in core/curves/relative_point.hpp.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <yoke/contact/geometry/slot.hpp>
#include <yoke/contact/laws/law.hpp>
#include <yoke/contact/wall_law.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

/// One law for each wall of a slot; a single law serves for all. `inner` also serves for the left
/// wall of a curve_slot, which is the inner one of an arc that turns left, `outer` for the right one,
/// `cap` for ends, corners and edges. Or a function of the wall for all of them, see WallLaw.
/// The energy stored jumps where a contact passes from one law to another; the ledger counts the jump
/// as dissipation.
struct SlotLaws {
  /// One for all walls; one each for inner wall, outer wall and the rest; or what follows from the
  /// wall.
  SlotLaws(ContactLaw all) : inner(all), outer(all), cap(std::move(all)) {}
  SlotLaws(ContactLaw at_inner, ContactLaw at_outer, ContactLaw at_cap)
      : inner(std::move(at_inner)), outer(std::move(at_outer)), cap(std::move(at_cap)) {}
  SlotLaws(WallLaw all) : each(std::move(all)) {}
  template <class F>
  requires std::is_invocable_r_v<ContactLaw, const F&, const SlotWall&> SlotLaws(
      F of_wall, Radii radii = Radii::local)
      : each(WallLaw(std::move(of_wall), radii)) {}

  std::optional<ContactLaw> inner, outer, cap;  // all or none of them
  std::optional<WallLaw> each;                  // none or all
};

/// A round pin of a body.
struct Pin {
  BodyId body;          // that carries it
  Vec2 at{0.0, 0.0};    // [m] its centre, a global point in the start pose
  double radius = 0.0;  // [m] > 0, smaller than the half-width of the slot
};

/// A slot and the body that has it.
struct SlotOn {
  BodyId body;  // that has it
  Slot slot;    // placed by global geometry in the start pose: arc_slot({...})
};

/// m.add(PinInSlot{.name = "slot", .pin = {crank, tip, 7.9_mm}, .slot = {slider, arc_slot({...})},
///                 .law = ContactLaw{per_mm(49070, 1.10), HuntCrossley{0.32}}});
/// The normal points from the centreline to the wall touched. Friction is the third part of a law.
struct PinInSlot {
  std::string name;
  Pin pin;      // of one body
  SlotOn slot;  // of another
  SlotLaws law;
  double reference_force = 100.0;  // [N] a light load; its penetration sets the error weights

  /// The contact with the walls that follow one another.
  std::unique_ptr<ForceElement> build(const Model& model) const;
  /// With the flat ends of the slot, if it has any, each a contact of its own.
  Elements elements(const Model& model) const;
};

}  // namespace yoke
