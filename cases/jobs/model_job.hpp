// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The job of a case that is a model and an end time: run it, write it, say how it went.
#pragma once

#include <string>

#include <yoke/cases/case.hpp>
#include <yoke/integrators/analyses/verify.hpp>

namespace yoke::cases {

/// Digits that agree, by quantity: the error bar beside the result.
void print_verification(const std::string& name, const Verification& verification);

RunStatus run_model(const Model& model, double until, const RunRequest& request);

}  // namespace yoke::cases
