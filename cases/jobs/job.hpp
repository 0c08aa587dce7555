// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// `yoke run CASE`: the case under every law asked for, results, comparison and plots.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/cases/jobs/law_run.hpp>
#include <yoke/cases/jobs/plot.hpp>

namespace yoke::cases {

/// Figures beside the standard ones, on each of the request's sheets: writes their data into the folder
/// of the plots. Only runs that completed get here.
using FigureMaker = std::function<std::vector<Figure>(
    const Case&, const RunRequest&, const std::vector<LawRun>&, const std::filesystem::path&)>;

/// Runs the case: with a choice of laws each into OUTPUT/LAW/, else into OUTPUT/. Writes
/// comparison.csv and plots/, prints a report. Throws ModelError for what cannot start, OutputError
/// for a file that cannot be written.
RunStatus run_case(const Case& c, const RunRequest& request, const FigureMaker& more = {});

}  // namespace yoke::cases
