// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// `yoke poincare`, `yoke bifurcation`, `yoke basins`: maps of what a case does, as tables and pictures.
#pragma once

#include <string>
#include <vector>

#include <yoke/cases/maps/section_choice.hpp>
#include <yoke/integrators/studies/maps/bifurcation.hpp>

namespace yoke::cases {

/// Writes OUTPUT/poincare.csv, summary.json and plots/poincare.*, also of what there is when the run fails or is
/// interrupted. Throws ModelError, OutputError.
RunStatus run_poincare(const Case& c, const MapRequest& request);

struct BifurcationRequest {
  MapRequest map;
  std::string vary{};  // as typed
  Continuation continuation = Continuation::forward;
};
/// Writes OUTPUT/bifurcation.csv (points), periods.csv (a row a value) and plots/bifurcation.*, likewise.
RunStatus run_bifurcation(const Case& c, const BifurcationRequest& request);

struct BasinRequest {
  MapRequest map;
  std::vector<std::string> grid{};  // two axes, as typed
};
/// Writes OUTPUT/basins.csv (a row a start), attractors.csv and plots/basins.*, likewise; the same request in
/// the same folder goes on where it was ended.
RunStatus run_basins(const Case& c, const BasinRequest& request);

}  // namespace yoke::cases
