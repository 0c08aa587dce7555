// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Runs of the scotch-yoke under its laws: what the job, its plots and the study have in common.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <yoke/cases/scotch_yoke.hpp>
#include <yoke/core/result.hpp>
#include <yoke/integrators/analyses/verify.hpp>

namespace yoke::cases {

/// The run under one law. `history` has the columns of motion.csv but `stride` rows for one of its
/// rows: impacts take less than a millisecond, and peaks and loops want to be seen whole.
struct LawRun {
  std::string law;                     // "" if it was not run
  std::vector<std::string> regions{};  // labels of the column "region"
  Table history{};
  std::vector<EventRecord> events{};
  Summary summary{};
  std::size_t stride = 1;
  double peak_force = 0.0;           // [N]
  double largest_penetration = 0.0;  // [m]
  long contacts = 0;                 // onsets
  std::optional<Verification> verification{};
};

/// One contact from onset to release, by the rows of the history inside it.
struct ContactSpell {
  std::size_t first = 0, last = 0;  // rows, last excluded
  std::string region;               // inner, outer, cap
  bool crossed = false;             // the pin came from the other wall
};

/// A stretch without contact, from a release to the next onset.
struct Flight {
  double from = 0.0, to = 0.0;  // [s]
  double landing_speed = 0.0;   // [m/s]
  bool crosses = false;         // from one wall to the other
};

/// Runs the mechanism under one law; with request.samples = 0 only the events and the summary are
/// kept. Throws ModelError for what cannot start.
LawRun run_law(const RunRequest& request, const ScotchYoke& choices, const std::string& law,
               std::function<bool(const Progress&)> observer);

/// Contacts that begin and end between two times [s].
std::vector<ContactSpell> contact_spells(const LawRun& run, double from, double to);

/// Flights of the whole run.
std::vector<Flight> flights(const LawRun& run);

/// Draws Figures 11 to 16 and the mechanism into `folder`; returns what to tell the user.
std::string plot_scotch_yoke(const ScotchYoke& choices, const std::vector<LawRun>& runs,
                             const std::filesystem::path& folder, int jobs);

/// The job of the case, and the study of what the paper says in words.
RunStatus run_scotch_yoke(const RunRequest& request);
RunStatus study_scotch_yoke(const RunRequest& request);

}  // namespace yoke::cases
