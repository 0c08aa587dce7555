// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The yoke program; apart from its main, which is compiled without the headers of the command line.
#pragma once

namespace yoke::cases {

/// Returns the exit code; verbs of yoke-studies replace this program by that one.
int run_yoke(int argc, char** argv);

}  // namespace yoke::cases
