// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/choices/material.hpp>

#include <fmt/format.h>

#include <algorithm>

#include <yoke/cases/choices/quantity.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

double parse_modulus(std::string_view text) {
  const TypedNumber number = parse_number("E", text);
  if (number.unit == "Pa" || number.unit.empty()) return number.value;
  if (number.unit == "kPa") return number.value * 1e3;
  if (number.unit == "MPa" || number.unit == "N/mm2") return number.value * 1e6;
  if (number.unit == "GPa") return number.value * 1e9;
  throw ModelError(
      fmt::format("E: '{}' has the unit '{}'; accepted: Pa, kPa, MPa, GPa", text, number.unit));
}

}  // namespace

Material parse_material(std::string_view text) {
  if (text == "steel") return steel;
  if (text == "aluminium") return aluminium;
  Material material{.E = 0.0, .nu = 0.0, .name = std::string(text)};
  bool has_E = false, has_nu = false;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view item = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), item.size() + 1));
    if (item.starts_with("E=")) {
      material.E = parse_modulus(item.substr(2));
      has_E = true;
    } else if (item.starts_with("nu=")) {
      material.nu = parse_in("nu", item.substr(3), "");
      has_nu = true;
    } else {
      throw ModelError(
          fmt::format("material '{}': accepted are steel, aluminium or E=207GPa,nu=0.3{}", text,
                      text == "aluminum" ? "; did you mean 'aluminium'?" : ""));
    }
  }
  if (!has_E || !has_nu)
    throw ModelError(fmt::format("material '{}': {} is missing; for instance E=207GPa,nu=0.3", text,
                                 has_E ? "nu" : "E"));
  require_positive("material", "E", material.E, "Pa");
  if (!(material.nu > -1.0 && material.nu <= 0.5))
    throw ModelError(
        fmt::format("material '{}': nu must be greater than -1 and at most 0.5", text));
  return material;
}

}  // namespace yoke::cases
