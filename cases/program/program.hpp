// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the two programs, yoke and yoke-studies, have in common.
#pragma once

#include <functional>

#include <yoke/cases/program/verb.hpp>

namespace yoke::cases {

/// Parses the command line with the verbs that `add_verbs` adds, runs the chosen one and returns
/// the exit code. Errors are printed to stderr.
int run_program(int argc, char** argv, const std::function<void(CLI::App&, Action&)>& add_verbs);

}  // namespace yoke::cases
