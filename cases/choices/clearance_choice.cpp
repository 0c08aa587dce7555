// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/choices/clearance_choice.hpp>

#include <utility>

#include <yoke/contact/laws/dissipative/flores.hpp>
#include <yoke/contact/laws/dissipative/lankarani_nikravesh_1990.hpp>
#include <yoke/contact/laws/elastic/hertz.hpp>
#include <yoke/core/units.hpp>

namespace yoke::cases {

using namespace yoke::literals;

CaseParameter clearance_parameter(std::string default_text, std::string description) {
  return {.name = "clearance",
          .quantity = Quantity::length,
          .default_text = std::move(default_text),
          .low = 1.0_um,
          .high = 5.0_mm,
          .words = {"ideal"},
          .description = std::move(description)};
}

CaseParameter restitution_parameter(std::string default_text) {
  return {.name = "restitution",
          .quantity = Quantity::number,
          .default_text = std::move(default_text),
          .low = 0.01,
          .high = 1.0,
          .description = "coefficient e of the case's own laws"};
}

double clearance_of(const Parameters& p) {
  return p.is_word("clearance") ? 0.0 : p.number("clearance");
}

ContactChoice clearance_laws(std::function<std::vector<Wall>(const Parameters&)> walls) {
  return {
      .walls =
          [walls = std::move(walls)](const Parameters& p) {
            return clearance_of(p) > 0.0 ? walls(p) : std::vector<Wall>{};
          },
      .laws = {
          {"hertz-lankarani-nikravesh",
           "Hertz' point contact with the damping of Lankarani and Nikravesh",
           [](const Parameters& p, const Wall& wall) {
             return ContactLaw{hertz(wall.pair), LankaraniNikravesh1990{p.number("restitution")}};
           }},
          {"hertz-flores", "Hertz' point contact with the damping of Flores and others",
           [](const Parameters& p, const Wall& wall) {
             return ContactLaw{hertz(wall.pair), Flores{p.number("restitution")}};
           }}}};
}

Wall flat_wall_for(const std::string& name, double pin_radius, double length) {
  return {.name = name,
          .pair = {.pin_radius = pin_radius, .wall_radius = 1000.0 * pin_radius},
          .length = length};
}

}  // namespace yoke::cases
