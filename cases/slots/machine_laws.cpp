// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/slots/machine_laws.hpp>

#include <utility>

#include <yoke/contact/laws/dissipative/flores.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/core/units.hpp>

namespace yoke::cases {

using namespace yoke::literals;

namespace {

// Of steel cylinders of some millimetres, 10 mm long: Johnson's law near 100 N as a power law. It
// has no end, and no radii.
PowerLaw line_of_steel() { return per_mm(490700.0, 1.1, "line of steel"); }

// Half the speed is lost; below 10 mm/s the damping no longer grows.
Flores oiled_steel() { return {.e = 0.5, .slowest_approach = 0.01}; }

}  // namespace

ContactChoice machine_laws(std::function<std::vector<Wall>(const Parameters&)> walls) {
  return {
      .walls = std::move(walls),
      .laws = {{"steel", "F = K d^1.1, K = 490.7 kN/mm^1.1, with the damping of Flores, e = 0.5",
                [](const Parameters&, const Wall&) {
                  return ContactLaw{line_of_steel(), oiled_steel()};
                }},
               {"johnson", "Johnson's law of steel cylinders, 10 mm long, with the same damping",
                [](const Parameters&, const Wall& wall) {
                  return ContactLaw{johnson(wall.pair, wall.length), oiled_steel()};
                }}},
      .base = "steel"};
}

Wall nearly_flat_wall(const std::string& name, double roller_radius) {
  return {
      .name = name, .pair = {.pin_radius = roller_radius, .wall_radius = 1.0}, .length = 10.0_mm};
}

bool is_onset(const EventRecord& event, std::string_view name) {
  return event.kind == "onset" && std::string_view(event.element).starts_with(name);
}

}  // namespace yoke::cases
