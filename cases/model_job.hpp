// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The job of a case that is a model and an end time: run it, write it, say how it went.
#pragma once

#include <yoke/cases/case.hpp>

namespace yoke::cases {

RunStatus run_model(const Model& model, double until, const RunRequest& request);

}  // namespace yoke::cases
