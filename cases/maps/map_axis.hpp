// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What varies in a map: a parameter of the case, as after --vary of a sweep, or a coordinate or velocity of
// a body at the start, BODY.x_m=LOW:HIGH:N in SI units.
#pragma once

#include <string>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/core/state.hpp>
#include <yoke/integrators/studies/points.hpp>

namespace yoke::cases {

/// One axis of a map.
struct MapAxis {
  StudyAxis axis;                       // numbers, in SI
  std::vector<std::string> settings{};  // of a parameter: NAME=VALUE at each of them
  std::string column{};                 // of the motion, if it is no parameter

  /// What it sets at one of its values.
  std::vector<std::string> settings_at(std::size_t i) const;
};

/// `option` is "--vary" or "--grid", for messages. Throws ModelError that names it, the text and what is accepted.
MapAxis parse_map_axis(const Case& c, const std::string& option, const std::string& text);

/// Sets a coordinate or velocity of a body at a start. Throws ModelError for a column that is none.
void set_start(const Model& model, State& start, const std::string& column, double value);

}  // namespace yoke::cases
