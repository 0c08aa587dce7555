// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What mechanisms with clearance offer: the clearance, and contact laws for a restitution.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <yoke/cases/choices/contact_choice.hpp>
#include <yoke/cases/choices/parameters.hpp>

namespace yoke::cases {

/// "clearance": a length, or `ideal` for the joint without it.
CaseParameter clearance_parameter(std::string default_text, std::string description);
/// "restitution" e of the named laws.
CaseParameter restitution_parameter(std::string default_text);
/// [m] 0 if ideal.
double clearance_of(const Parameters& parameters);

/// Laws for the restitution of the parameter: Hertz' law of a point contact with the damping of
/// Lankarani and Nikravesh (the base) or of Flores. `walls` are asked for only if the parameters
/// say a clearance; without it there are none.
ContactChoice clearance_laws(std::function<std::vector<Wall>(const Parameters&)> walls);

/// A pin or corner of steel against a flat wall. Laws take round walls: this one has a radius of
/// 1000 times the pin's.
Wall flat_wall_for(const std::string& name, double pin_radius, double length);

}  // namespace yoke::cases
