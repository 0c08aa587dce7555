// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the parts of the study of the scotch-yoke have in common.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <yoke/cases/jobs/law_run.hpp>
#include <yoke/cases/jobs/markdown.hpp>
#include <yoke/cases/scotch_yoke.hpp>
#include <yoke/contact/laws/catalog/table11.hpp>

namespace yoke::cases {

/// The last revolution of a run, on the same uniform grid for every law.
struct Revolution {
  std::string law;
  Eigen::VectorXd angle;  // [deg] from the start of the revolution
  Eigen::VectorXd force, penetration, x, v, a;
  std::vector<Flight> flights;  // times replaced by angles [deg]
};

struct Study {
  RunRequest request;
  ScotchYoke choices;
  std::vector<LawRun> runs;
  std::vector<Revolution> laws;  // the five columns of Table 11, then the others
  Document doc{};

  const Revolution& of(std::string_view law) const {
    return *std::ranges::find(laws, law, &Revolution::law);
  }
  Texts columns() const { return table11_names(); }
};

/// "johnson" of "table11-johnson".
std::string_view short_name(std::string_view law);

/// The request with other parameters.
RunRequest with(RunRequest request, const std::vector<std::pair<std::string, std::string>>& set);

/// Flights that end in the last revolution, their times replaced by angles [deg] from its start.
std::vector<Flight> flights_by_angle(const ScotchYoke& choices, const LawRun& run);

/// Contact-free share of a window of angles, and how many separations it holds.
struct Separations {
  int count = 0;
  double share = 0.0;
};

/// Between two angles [deg].
Separations separations(const std::vector<Flight>& all, double from, double to);

/// Tests what section 4 of the paper says in words; prints Markdown.
RunStatus study_scotch_yoke(const RunRequest& request);

/// The map of separations over damping, stiffness, crank length and start.
void print_map(Study& s);

}  // namespace yoke::cases
