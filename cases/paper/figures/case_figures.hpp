// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Figures of the paper that a case draws beside the standard ones.
#pragma once

#include <string_view>

#include <yoke/cases/jobs/job.hpp>

namespace yoke::cases {

/// The figures of a case; empty for a case the paper does not show.
FigureMaker paper_figures(std::string_view case_name);

/// Figures 11 to 16 from the last revolution of each run, the exact law of Johnson beside its fits,
/// and the mechanism to scale, still and moving.
std::vector<Figure> scotch_yoke_figures(const Case& c, const RunRequest& request,
                                        const std::vector<LawRun>& runs,
                                        const std::filesystem::path& folder);

}  // namespace yoke::cases
