// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a job writes and prints about its runs.
#pragma once

#include <string>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/cases/jobs/law_run.hpp>

namespace yoke::cases {

/// Writes summary.json, the tables of `output` and, where the run has one, replay.json into `folder`.
/// Throws OutputError.
void write_run(const Case& c, const RunRequest& request, const LawRun& run,
               const std::filesystem::path& folder, RunOutput& output);

/// Peak force, deepest penetration, contacts, cost and accuracy of each law, a line a law; for a
/// case without a choice of laws what became of its run. Then the agreement that --verify found,
/// and what every user should know: redundant equations, singular positions, runs that failed.
void print_report(const std::vector<LawRun>& runs);

/// The checks of each run, a line each.
void print_checks(const std::vector<LawRun>& runs);

/// comparison.csv in the folder of a job: the same table as CSV, every contact in columns of its own,
/// from summary.json in the folders of its runs. Throws OutputError.
void write_comparison(const std::vector<LawRun>& runs, const std::filesystem::path& output);

}  // namespace yoke::cases
