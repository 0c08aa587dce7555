// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Pictures of maps, drawn from their tables.
#pragma once

#include <string>
#include <vector>

#include <yoke/cases/jobs/plot.hpp>
#include <yoke/integrators/studies/maps/basins.hpp>

namespace yoke::cases {

/// Points y over x of ../poincare.csv.
Figure poincare_figure(const std::string& title, const std::string& x, const std::string& y);

/// A column of ../bifurcation.csv over the parameter; a direction in its own colour.
Figure bifurcation_figure(const std::string& title, const std::string& label,
                          const std::string& column, bool forward, bool backward);

/// The starts of ../basins.csv in the colours of their attractors, y over x.
Figure basins_figure(const std::string& title, const Basins& map);

}  // namespace yoke::cases
