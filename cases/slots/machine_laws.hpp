// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The contact laws that the cases of slots and cams offer by name, beside those of the catalogue,
// and their walls as laws of two cylinders need to know them. Steel on steel, 10 mm long.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/cases/choices/contact_choice.hpp>
#include <yoke/core/force.hpp>

namespace yoke::cases {

/// "steel" (the base) and "johnson". `walls` as in ContactChoice; none: a case without
/// contact with these parameters.
ContactChoice machine_laws(std::function<std::vector<Wall>(const Parameters&)> walls);

/// A roller or pin on a wall that is flat, or nearly: as on a cylinder of 1 m.
Wall nearly_flat_wall(const std::string& name, double roller_radius);

/// Onsets of contacts whose names begin with `name`, by an event of a run.
bool is_onset(const EventRecord& event, std::string_view name);

}  // namespace yoke::cases
