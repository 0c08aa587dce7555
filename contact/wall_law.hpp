// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Which law a wall has: one, or one that follows from the wall, for laws that take radii.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <yoke/contact/geometry/slot.hpp>
#include <yoke/contact/laws/law.hpp>

namespace yoke {

/// A wall as a law sees it.
struct SlotWall {
  SlotRegion region = SlotRegion::wall;  // what it is
  double curvature = 0.0;                // [1/m] > 0 convex, < 0 concave, infinite at a sharp edge
};

/// Which radius a law that takes radii gets where the curvature varies along a wall.
enum class Radii {
  local,  ///< that of the point touched: the stiffness follows it smoothly (default)
  mean,   ///< one for each region: its mean curvature, what it turns by over its length
};

/// One law, or a function of the wall that gives the exact law for a curvature,
///   [](const SlotWall& w) { return ContactLaw{johnson(pair_of(pin_radius, w.curvature), 10.0_mm)}; }
/// It is called before a run only. With Radii::local, the law of a wall of varying curvature k is made
/// from it by interpolation, exact to 1e-11 (contact/laws/graded_law.hpp). The energy U stored in the
/// contact then depends on the place too, and the force is its gradient: besides F = dU/dd along the
/// normal, (dU/dk)(dk/dl) along the wall, at the centre of the disc. contact/contact_element.hpp says why.
/// Friction is that of the wall's mean curvature. The dissipative part has to be the same for all curvatures, must keep no dent and have no kink;
/// others, and laws that are not smooth in k, are refused with a ModelError.
class WallLaw {
 public:
  /// One law, its parts, or a function of the wall.
  WallLaw(ContactLaw law) : law_(std::move(law)) {}
  WallLaw(ElasticLaw elastic, DissipativeLaw dissipation = {}, FrictionLaw friction = {})
      : law_(ContactLaw{std::move(elastic), std::move(dissipation), std::move(friction)}) {}
  template <class F>
  requires std::is_invocable_r_v<ContactLaw, const F&, const SlotWall&> WallLaw(
      F of_wall, Radii radii = Radii::local)
      : of_wall_(std::move(of_wall)), radii_(radii) {}

  /// For a disc of this radius [m]. `reference_force` [N]: a light load. Throws ModelError, whose
  /// message begins with the owner.
  ContactLaw at(const std::string& owner, const Slot& slot, int region, SlotRegion kind,
                const CurvatureRange& range, double disc_radius, double reference_force) const;

 private:
  std::optional<ContactLaw> law_;                         // or
  std::function<ContactLaw(const SlotWall&)> of_wall_{};  // one of both
  Radii radii_ = Radii::local;
};

/// The law of each region of a profile.
std::vector<ContactLaw> laws_along(const std::string& owner, const Slot& slot, double disc_radius,
                                   double reference_force,
                                   const std::function<WallLaw(SlotRegion)>& law_of);

}  // namespace yoke
