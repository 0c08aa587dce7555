// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a map takes of a case, as typed: its section after --at, its parameters and law.
//
//   every:0.1s            once in that time
//   every:frequency       once in a period of a parameter of the case, in Hz; every:PARAMETER in time likewise
//   phase:motor=30deg     where a driver, or a body, passes an angle
//   event:stop.onset      at an event of an element
//   plane:mass.vx_m_per_s=0:falling   where a coordinate or velocity passes a value (rising by default, or both)
//   every:...+0.25        a quarter of the period later
#pragma once

#include <string>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/cases/jobs/request.hpp>
#include <yoke/integrators/studies/maps/bifurcation.hpp>

namespace yoke::cases {

/// The section that is typed. Parameters tell the period; driver, body and columns are checked when the
/// section is added to a model. Throws ModelError that names --at, the text and what is accepted.
Section parse_section(std::string_view text, const Case& c, const Parameters& parameters);

/// What all maps ask for.
struct MapRequest {
  std::vector<std::string> settings{};  // of all points, NAME=VALUE
  std::string law{};                    // "": the case's base law
  std::string friction{};
  std::string at{};                    // the section, as typed
  std::string x{}, y{};                // columns of the picture; "": the first of the map
  std::vector<std::string> columns{};  // of the table; empty: free coordinates, with x and y
  std::size_t discard = 100, points = 400;
  double duration =
      0.0;  // [s] of one run at most; 0: as many times that of the case as there are points
  double relative_tolerance = 1e-10;
  std::string formulation = "automatic";
  std::filesystem::path output{};
  int jobs = 0;  // 0: one per processor
  bool plots = true;
  bool quiet = false;
  std::string command{};  // as typed
};

/// The case with these settings besides those of the request, and the section added. Throws ModelError.
SectionedModel sectioned_model(const Case& c, const MapRequest& request,
                               const std::vector<std::string>& settings);

/// Columns, tolerance and durations for a map of such models. Throws ModelError for columns that there are not.
PoincareOptions map_options(const Case& c, const MapRequest& request, const SectionedModel& at);

/// Of a column, for an axis: "mass.x [m]".
std::string axis_label(const std::string& column);

}  // namespace yoke::cases
