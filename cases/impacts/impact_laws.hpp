// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the cases of impacts share: the parameters of their contacts, the laws they offer by name
// beside those of the catalogue, and the impacts of a run, taken from its events.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <yoke/cases/case.hpp>

namespace yoke::cases {

/// Parameters stiffness, exponent and restitution, with these defaults (a restitution of "1" is no
/// loss).
std::vector<CaseParameter> impact_parameters(const char* stiffness, const char* restitution);

/// The laws of a case with those parameters: restitution (the base), hunt-crossley and
/// elastic. `walls` as in ContactChoice.
ContactChoice impact_laws(std::function<std::vector<Wall>(const Parameters&)> walls);

/// A disc on a flat wall, of steel, 10 mm long, as elastic laws of the catalogue need to know it.
/// They take round walls: this one has a radius of 1 km.
Wall flat_wall(const std::string& name, double disc_radius);

/// A contact from onset to release.
struct Impact {
  double start = 0.0, end = 0.0;  // [s]
  double approach = 0.0;          // [m/s] > 0, at the onset
  double rebound = 0.0;           // [m/s] > 0, at the release
  double left_at = 0.0;           // [m] penetration at the release
};

/// Those of one contact that ended within the run.
std::vector<Impact> impacts_of(const Result& run, std::string_view contact);

/// Mass in kg as a parameter: a number.
CaseParameter mass_parameter(const char* name, const char* kilograms, const char* description);

}  // namespace yoke::cases
