// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke study CASE: until when formulations agree about a mechanism.
#pragma once

#include <yoke/cases/jobs/law_run.hpp>
#include <yoke/cases/jobs/request.hpp>

namespace yoke::cases {

/// Runs a case under the first law of the request by several formulations and compares the places of
/// all bodies with those of a tighter tolerance. Prints Markdown.
RunStatus study_agreement(const Case& c, const RunRequest& request);

}  // namespace yoke::cases
