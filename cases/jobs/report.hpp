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

/// What became of one run, in a dozen lines: how far, how accurate, the largest force with time and place,
/// impacts, cost, files. `name` is of the case and the law.
void print_summary(const std::string& name, const LawRun& run, const std::filesystem::path& folder,
                   const OutputChoice& choice);

/// Of several laws, peak force, deepest penetration, contacts, cost and accuracy of each, a line a law; of
/// one run its summary. Then the agreement that --verify found, and what every user should know: redundant
/// equations, singular positions, runs that failed.
void print_report(const std::string& case_name, const RunRequest& request,
                  const std::vector<LawRun>& runs);

/// The checks of each run, a line each.
void print_checks(const std::vector<LawRun>& runs);

/// comparison.csv in the folder of a job: the same table as CSV, every contact in columns of its own,
/// from summary.json in the folders of its runs. Throws OutputError.
void write_comparison(const std::vector<LawRun>& runs, const std::filesystem::path& output);

}  // namespace yoke::cases
