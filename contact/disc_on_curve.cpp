// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/disc_on_curve.hpp>

#include <cmath>
#include <utility>

#include <yoke/contact/contact_element.hpp>
#include <yoke/contact/details/disc_geometry.hpp>
#include <yoke/contact/geometry/wall.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

namespace {

void require_disc(const std::string& owner, std::string_view what, const Disc& disc) {
  require_finite(owner, fmt::format("{} x", what), disc.at.x());
  require_finite(owner, fmt::format("{} y", what), disc.at.y());
  require_not_negative(owner, fmt::format("radius of the {}", what), disc.radius, "m");
}

/// A disc may start within the material, but not with all of it.
void require_in_front(const std::string& owner, const Disc& disc, const Slot& wall) {
  const Vec2 p = rotate(-wall.angle(), disc.at - wall.origin());
  const double beyond = wall.touch(wall.nearest(p), p).distance;
  if (disc.radius > 0.0 && beyond > disc.radius)
    throw ModelError(fmt::format(
        "{}: the centre of the disc ({:g}, {:g}) m is {:g} m behind the surface in the start pose; "
        "the other side is .side = CurveSide::left or right, the depth of the material .thickness",
        owner, disc.at.x(), disc.at.y(), beyond));
}

}  // namespace

std::unique_ptr<ForceElement> DiscOnCurve::build(const Model& model) const {
  const std::string owner = fmt::format("contact '{}'", name);
  require_disc(owner, "disc", disc);
  require_finite(owner, "surface_speed", surface_speed);
  if (!(thickness > 0.0))
    throw ModelError(
        fmt::format("{}: thickness = {:g} m must be greater than 0", owner, thickness));
  if (std::isfinite(thickness) && (curve.closed() || !std::isfinite(curve.length())))
    throw ModelError(
        fmt::format("{}: thickness = {:g} m is of the material behind a curve with ends; this one "
                    "has none, leave it out",
                    owner, thickness));
  Slot wall = wall_profile({.curve = curve,
                            .disc_on_left = side == CurveSide::left,
                            .disc_radius = disc.radius,
                            .thickness = thickness});
  wall.check_shape(owner);
  require_in_front(owner, disc, wall);
  std::vector<ContactLaw> laws =
      laws_along(owner, wall, disc.radius, reference_force, [this](SlotRegion) { return law; });
  return std::make_unique<ContactElement>(
      name, disc.body, body,
      std::make_unique<DiscGeometry>(model, disc.body, disc.at, disc.radius, body, std::move(wall),
                                     surface_speed),
      std::move(laws), reference_force);
}

std::unique_ptr<ForceElement> DiscInHole::build(const Model& model) const {
  const std::string owner = fmt::format("contact '{}'", name);
  require_positive(owner, "radius of the hole", hole.radius, "m");
  if (!(disc.radius < hole.radius))
    throw ModelError(
        fmt::format("{}: radius of the disc = {:g} m must be less than the {:g} m of the hole",
                    owner, disc.radius, hole.radius));
  return DiscOnCurve{.name = name,
                     .disc = disc,
                     .body = hole.body,
                     .curve = circle(hole.at, hole.radius),
                     .law = law,
                     .reference_force = reference_force}
      .build(model);
}

std::unique_ptr<ForceElement> DiscOnDisc::build(const Model& model) const {
  const std::string owner = fmt::format("contact '{}'", name);
  require_disc(owner, "other disc", other);
  require_positive(owner, "radius of the other disc", other.radius, "m");
  return DiscOnCurve{.name = name,
                     .disc = disc,
                     .body = other.body,
                     .curve = circle(other.at, other.radius),
                     .side = CurveSide::right,
                     .law = law,
                     .reference_force = reference_force}
      .build(model);
}

}  // namespace yoke
