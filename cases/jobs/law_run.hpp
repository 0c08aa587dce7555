// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// One run of a case under one law, and what its contacts did.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/cases/jobs/request.hpp>
#include <yoke/cases/results/run_output.hpp>
#include <yoke/core/result.hpp>
#include <yoke/integrators/analyses/verify.hpp>

namespace yoke::cases {

/// What one contact element went through.
struct ContactRecord {
  std::string element;
  double peak_force = 0.0;           // [N] of the recorded rows
  double largest_penetration = 0.0;  // [m] of the recorded rows
  long onsets = 0;
};

/// The largest force of a run: of a contact; without contacts of a joint.
struct ForcePeak {
  std::string element{};          // "": there is none
  double force = 0.0;             // [N] of the recorded rows
  double t = 0.0;                 // [s]
  std::optional<Vec2> place{};    // [m] global, of a contact
  std::vector<double> history{};  // [N] the largest of equal stretches of the run
};

/// The run under one law.
struct LawRun {
  std::string law{};      // as asked for; "" if the case has no choice
  std::string folder{};   // of the results, within that of the job; "" if it is that of the job
  bool done = false;      // false: not begun, because the job was interrupted
  Table samples{};        // the engine's columns
  Table history{};        // under the case's own names; empty if the case has none
  Table dense{};          // samples and the rows within contacts; empty if there are none
  Table dense_history{};  // the same under the case's own names
  std::vector<EventRecord> events{};
  Summary summary{};
  std::vector<ContactRecord> contacts{};
  std::optional<Verification> verification{};
  std::vector<Check> checks{};
  ForcePeak peak{};
  std::vector<Portrait> portraits{};
  std::string replay{};  // for a report (cases/report/replay.hpp), if one was asked for

  /// What motion.csv shows, uniform in time.
  const Table& motion() const { return history.names().empty() ? samples : history; }
  /// The same with all rows there are.
  const Table& all_motion() const {
    if (history.names().empty()) return all();
    return dense_history.rows() == 0 ? history : dense_history;
  }
  /// All rows there are, not uniform in time.
  const Table& all() const { return dense.rows() == 0 ? samples : dense; }
  double peak_force() const;           ///< [N] of all contacts
  double largest_penetration() const;  ///< [m] of all contacts
  long onsets() const;                 ///< of all contacts
};

/// Runs the case under one law; checkpoints go to request.output. With request.samples = 0 only the
/// events and the summary are kept. `output`, if there is one, is told what the run has so far. Throws
/// ModelError for what cannot start.
LawRun run_law(const Case& c, const RunRequest& request, const std::string& law,
               std::function<bool(const Progress&)> observer, RunOutput* output = nullptr);

/// One contact from onset to release, by the rows of the tables inside it.
struct ContactSpell {
  std::size_t first = 0, last = 0;  // rows, last excluded
  std::string region;               // inner, outer, cap
  bool crossed = false;             // the contact before was in another region
};

/// Contacts of an element that begin and end between two times [s]; "" is any element. Rows are
/// those of `rows`.
std::vector<ContactSpell> contact_spells(const LawRun& run, const Table& rows, double from,
                                         double to, std::string_view element = "");

/// A stretch without contact, from a release to the next onset.
struct Flight {
  double from = 0.0, to = 0.0;  // [s]
  double landing_speed = 0.0;   // [m/s]
  bool crosses = false;         // from one region to another
};

/// Flights of the whole run; "" is any element.
std::vector<Flight> flights(const LawRun& run, std::string_view element = "");

}  // namespace yoke::cases
