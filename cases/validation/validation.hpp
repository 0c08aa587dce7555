// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The documents `yoke validate` prints. Each measures; none holds a number of its own.
#pragma once

#include <filesystem>
#include <string>

namespace yoke::cases {

/// The scotch-yoke (defaults, Johnson's column of Table 11) by both integrators as the tolerance is
/// tightened: distance to a reference run, amplification of a perturbation, energy ledger, drift.
std::string convergence_document();

/// Central impacts: every dissipative law x elastic law x restitution asked for x geometry, by both
/// integrators, against the law's closed form.
std::string impacts_document();
/// The same as impacts.md, impacts.csv and impacts.json.
void write_impacts(const std::filesystem::path& folder);

/// Mechanisms of the literature with known answers, by every formulation at several tolerances.
std::string benchmarks_document();
/// The same as benchmarks.md, benchmarks.csv, benchmarks.json and work-precision diagrams in
/// plots/.
void write_benchmarks(const std::filesystem::path& folder);

}  // namespace yoke::cases
