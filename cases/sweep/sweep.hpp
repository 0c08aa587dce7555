// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// `yoke sweep CASE`: the case at many points, each a run of its own; a table of what came out, a page that
// shows it. The same sweep in the same folder goes on where it was ended.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/cases/jobs/request.hpp>
#include <yoke/cases/sweep/sweep_axes.hpp>
#include <yoke/cases/sweep/sweep_quantities.hpp>

namespace yoke::cases {

/// The checked request of one point, with the command that makes its run alone. Throws ModelError.
using PointRequest = std::function<RunRequest(const SweepSetting&)>;

struct SweepRequest {
  SweepChoice choice;
  PointRequest request_of{};            // called from several threads
  std::vector<std::string> measures{};  // as typed
  std::string turn{};                   // column that counts turns; "": that of drivers
  double from = 0.0;                    // [s] where contacts, energy and measures begin to count
  std::filesystem::path output{};       // folder
  bool keep_runs = false;               // results and report of each point in a folder of its own
  bool report = true;                   // report.html
  int jobs = 0;                         // threads; 0: one per processor
  bool quiet = false;
  std::string command{};           // as typed
  nlohmann::ordered_json typed{};  // every option that decides what is computed, by its name
  StudyExecutor executor{};        // in place of threads
  bool leads = true;               // see StudyOptions
};

/// Writes OUTPUT/journal.tsv while it runs; at the end, also if interrupted, sweep.csv, sweep.h5 (built with
/// HDF5), summary.json and report.html. A point that fails is a row; the status is failed only if all do. Throws
/// ModelError for what cannot start, among it another sweep in the folder; OutputError.
RunStatus run_sweep(const Case& c, const SweepRequest& request);

/// The folder of a point whose run is kept, within that of the sweep: "runs/000012".
std::string run_folder(std::size_t point);

}  // namespace yoke::cases
