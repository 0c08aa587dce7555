// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Basins of attraction: from each start of a grid a run goes on until its transient is over; which attractor
// it has come to is told by the points of its section, their period and where they lie.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <yoke/integrators/studies/maps/bifurcation.hpp>
#include <yoke/integrators/studies/study.hpp>

namespace yoke {

/// How basins are made.
struct BasinOptions {
  PoincareOptions map{};  // of each start; its observer does not count
  /// Attractors are the same if they have one period and the means of their points differ in no column by more
  /// than this part of the widest range of any run, its transient included; those without a period also if
  /// they differ by less than their scatter.
  double tolerance = 1e-2;
  /// A run is unbounded once a column has gone beyond this [its SI unit]; angles do not count.
  double bound = 1e3;
  StudyOptions study{};  // jobs, folder, observer, stop
};

/// What a start leads to, beside the numbers of attractors.
enum BasinKind : int { basin_unbounded = -1, basin_failed = -2, basin_missing = -3 };

/// An attractor that was met.
struct Attractor {
  std::size_t period = 0;         // of its points; 0: none was found
  std::vector<double> mean{};     // of its points in each column
  std::vector<double> scatter{};  // root mean square about it
  std::size_t starts = 0;         // that lead there
  std::size_t first = 0;          // the first of them
};

/// The map.
struct Basins {
  StudyResult study;                   // a row a start: period; mean, scatter, range of the columns
  std::vector<std::string> columns{};  // of the section
  std::vector<int> attractor{};        // of each start: an index into `attractors`, or BasinKind
  std::vector<Attractor> attractors{};  // in the order in which starts first met them
  /// point, the two axes, attractor (from 1; 0 unbounded, nan failed), period.
  Table table() const;
};

/// Makes the model with its start at one point of the grid. Called on several threads.
using ModelOfStart = std::function<SectionedModel(const StudyPoint& point)>;

/// One run for each point of `grid`; the result does not depend on jobs. A run that fails is a start that
/// failed. Throws ModelError as run_study() and for wrong options.
Basins basins(const ModelOfStart& model, const StudyPoints& grid, const BasinOptions& options);

}  // namespace yoke
