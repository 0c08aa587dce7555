// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a sweep leaves in its folder besides its journal.
#pragma once

#include <string>

#include <yoke/cases/sweep/sweep.hpp>
#include <yoke/integrators/studies/study.hpp>

namespace yoke::cases {

/// What sweep.json calls its form.
inline constexpr const char* sweep_schema = "yoke-sweep-1";

/// Keeps in OUTPUT/sweep.json what was typed. Throws ModelError that names the first option that differs if
/// another sweep is there.
void settle_sweep(const Case& c, const SweepRequest& request);

/// sweep.csv, sweep.h5, summary.json. Throws OutputError.
void write_sweep(const Case& c, const SweepRequest& request, const SweepPoints& points,
                 const StudyResult& study);

/// report.html. Throws OutputError.
void write_sweep_page(const Case& c, const SweepRequest& request, const SweepPoints& points,
                      const StudyResult& study);

/// A dozen lines for people: points, failures and their reasons, least and largest of what varies.
void print_sweep(const Case& c, const SweepRequest& request, const SweepPoints& points,
                 const StudyResult& study);

}  // namespace yoke::cases
