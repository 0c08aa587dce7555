// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The version of the library.
#pragma once

namespace yoke {

/// The version of the project; the build reads it from this line.
inline constexpr const char* version = "0.2.0";

}  // namespace yoke
