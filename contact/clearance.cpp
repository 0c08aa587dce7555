// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/clearance.hpp>

#include <algorithm>
#include <string>

#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>

namespace yoke {

Elements BearingClearance::elements(const Model& model, const JointPlace& place) const {
  const std::string owner = fmt::format("revolute '{}', clearance", place.name);
  require_positive(owner, "journal_radius", journal_radius, "m");
  require_positive(owner, "radial", radial, "m");
  Elements made;
  made.forces.push_back(DiscInHole{.name = place.name,
                                   .disc = {place.b, place.at, journal_radius},
                                   .hole = {place.a, place.at, journal_radius + radial},
                                   .law = law,
                                   .reference_force = reference_force}
                            .build(model));
  return made;
}

Elements GuideClearance::elements(const Model& model, const JointPlace& place) const {
  const std::string owner = fmt::format("prismatic '{}', clearance", place.name);
  require_positive(owner, "length", length, "m");
  require_positive(owner, "width", width, "m");
  require_positive(owner, "gap", gap, "m");
  require_range(owner, "corner_radius", corner_radius, 0.0, 0.5 * std::min(length, width), "m");
  Elements made;
  const Vec2 across = perp(place.along);
  for (const bool front : {true, false})
    for (const bool left : {true, false}) {
      const double s = front ? 1.0 : -1.0, n = left ? 1.0 : -1.0;
      const Vec2 corner = place.at + s * (0.5 * length - corner_radius) * place.along +
                          n * (0.5 * width - corner_radius) * across;
      const Vec2 wall = place.at + n * (0.5 * width + gap) * across;
      made.forces.push_back(
          DiscOnCurve{.name = fmt::format("{} {} {}", place.name, front ? "front" : "back",
                                          left ? "left" : "right"),
                      .disc = {place.b, corner, corner_radius},
                      .body = place.a,
                      .curve = straight_line(wall, place.along),
                      .side = left ? CurveSide::right : CurveSide::left,
                      .law = law,
                      .reference_force = reference_force}
              .build(model));
    }
  return made;
}

Elements SlotClearance::elements(const Model& model, const JointPlace& place) const {
  const std::string owner = fmt::format("point on curve '{}', clearance", place.name);
  require_positive(owner, "pin_radius", pin_radius, "m");
  require_positive(owner, "radial", radial, "m");
  return PinInSlot{.name = place.name,
                   .pin = {place.a, place.at, pin_radius},
                   .slot = {place.b, curve_slot({.centreline = *place.curve,
                                                 .half_width = pin_radius + radial,
                                                 .start = start,
                                                 .end = end,
                                                 .edge_radius = edge_radius})},
                   .law = law,
                   .reference_force = reference_force}
      .elements(model);
}

}  // namespace yoke
