// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/program/studies/agreement_study.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <yoke/cases/jobs/markdown.hpp>
#include <yoke/cases/jobs/progress.hpp>
#include <yoke/integrators/studies/work_pool.hpp>

namespace yoke::cases {

namespace {

constexpr double tightest = 1e-12;
constexpr std::array<const char*, 4> compared = {"arkode-projection", "ida-ggl", "cvode-projection",
                                                 "adams-baumgarte"};
struct Level {
  const char* name;
  double distance;  // [m]
};
constexpr std::array<Level, 3> levels = {{{"1 nm", 1e-9}, {"1 um", 1e-6}, {"0.1 mm", 1e-4}}};

/// A coordinate of a body, and the distance [m] that a unit of it is worth.
struct Coordinate {
  std::size_t column = 0;
  double worth = 1.0;
};

std::vector<Coordinate> coordinates_of(const LawRun& run) {
  std::vector<Coordinate> coordinates;
  for (std::size_t i = 0; i < run.samples.names().size(); ++i) {
    const std::string& name = run.samples.names()[i];
    if (name.ends_with(".x_m") || name.ends_with(".y_m")) coordinates.push_back({i, 1.0});
    if (name.ends_with(".angle_rad")) coordinates.push_back({i, run.summary.length_scale});
  }
  return coordinates;
}

/// "0.0123 s": where a body is first farther from where it is in the reference; or "to the end".
std::string until(const LawRun& run, const LawRun& reference, double distance) {
  const Table &a = run.samples, &b = reference.samples;
  const std::vector<Coordinate> coordinates = coordinates_of(reference);
  const std::size_t time = b.index("t_s"), rows = std::min(a.rows(), b.rows());
  for (std::size_t i = 0; i < rows; ++i)
    for (const auto& [column, worth] : coordinates)
      if (!(std::abs(a.value(i, column) - b.value(i, column)) * worth <= distance))
        return fmt::format("{:.4g} s", a.value(i, time));
  return rows == b.rows() ? "to the end" : "it stopped";
}

}  // namespace

RunStatus study_agreement(const Case& c, const RunRequest& request) {
  std::vector<std::string> names{"reference"};
  names.insert(names.end(), compared.begin(), compared.end());
  std::vector<LawRun> runs(names.size());
  const std::string law = request.laws.empty() ? "" : request.laws.front();
  ProgressLine progress(names);
  run_parallel(runs.size(), request.jobs, [&](std::size_t i) {
    if (interrupted()) return;
    RunRequest one = request;
    one.formulation = i == 0 ? compared.front() : names[i];
    if (i == 0) one.relative_tolerance = tightest;
    runs[i] = run_law(c, one, law, progress.observer(i));
  });
  if (interrupted()) return RunStatus::interrupted;
  const LawRun& reference = runs.front();
  if (!reference.summary.ok()) return RunStatus::failed;
  Document doc;
  doc.print(
      "`{}`{}{}, {:.4g} s: until when all bodies are within a distance (angles times "
      "the length scale) of a run by {} "
      "at rtol {:g} ({} contacts).\n\n",
      c.name, law.empty() ? "" : ", law ", law, reference.summary.t_end, compared.front(), tightest,
      reference.onsets());
  doc.head({fmt::format("at rtol {:g}", request.relative_tolerance), levels[0].name, levels[1].name,
            levels[2].name, "contacts"});
  for (std::size_t i = 1; i < runs.size(); ++i) {
    std::vector<std::string> row{names[i]};
    for (const Level& level : levels) row.push_back(until(runs[i], reference, level.distance));
    row.push_back(fmt::format("{}", runs[i].onsets()));
    doc.row(row);
  }
  fmt::print("{}", doc.plain());
  return RunStatus::completed;
}

}  // namespace yoke::cases
