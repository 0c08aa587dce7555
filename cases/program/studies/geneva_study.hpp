// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke study geneva: how hard the pin hits a slot.
#pragma once

#include <yoke/cases/jobs/law_run.hpp>
#include <yoke/cases/jobs/request.hpp>

namespace yoke::cases {

/// Both impacts of an index against clearance and speed, beside their formulas; prints Markdown.
RunStatus study_geneva(const RunRequest& request);

}  // namespace yoke::cases
