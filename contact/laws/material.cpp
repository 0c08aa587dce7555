// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/material.hpp>

#include <cmath>

#include <yoke/core/error.hpp>

namespace yoke {

namespace {
double plane_compliance(const Material& m) {
  const std::string owner = "material '" + m.name + "'";
  require_positive(owner, "E", m.E, "Pa");
  if (!(m.nu > -1.0 && m.nu <= 0.5))
    throw ModelError(
        fmt::format("{}: nu = {:g} must be greater than -1 and at most 0.5", owner, m.nu));
  return (1.0 - m.nu * m.nu) / m.E;
}
}  // namespace

double composite_modulus(const Material& first, const Material& second) {
  return 1.0 / (plane_compliance(first) + plane_compliance(second));
}

void RoundPair::check(std::string_view law, bool takes_plane) const {
  const std::string owner = fmt::format("law '{}'", law);
  require_positive(owner, "pin_radius", pin_radius, "m");
  const bool plane = wall_radius > 0.0 && std::isinf(wall_radius);
  if (plane && !takes_plane)
    throw ModelError(
        fmt::format("{}: wall_radius = inf m: on a plane the penetration under this law has no "
                    "bound; take a large finite radius, or hertz",
                    owner));
  if (!plane) require_positive(owner, "wall_radius", wall_radius, "m");
  if (conformity == Conformity::internal && !(pin_radius < wall_radius))
    throw ModelError(
        fmt::format("{}: pin_radius = {:g} m must be smaller than wall_radius = {:g} m for an "
                    "internal contact",
                    owner, pin_radius, wall_radius));
}

double RoundPair::radius_difference() const {
  return conformity == Conformity::external ? wall_radius + pin_radius : wall_radius - pin_radius;
}

double RoundPair::relative_radius() const {
  return std::isinf(wall_radius) ? pin_radius : pin_radius * wall_radius / radius_difference();
}

RoundPair pair_of(double pin_radius, double wall_curvature, const Material& pin,
                  const Material& wall) {
  return {.pin_radius = pin_radius,
          .wall_radius = 1.0 / std::abs(wall_curvature),
          .conformity = wall_curvature < 0.0 ? Conformity::internal : Conformity::external,
          .pin = pin,
          .wall = wall};
}

double RoundPair::printed_radius_difference(std::string_view law) const {
  const double difference = std::abs(wall_radius - pin_radius);
  require_positive(fmt::format("law '{}', as printed or tabulated", law),
                   "wall_radius - pin_radius", difference, "m");
  return difference;
}

}  // namespace yoke
