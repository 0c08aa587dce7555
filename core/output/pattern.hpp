// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Names chosen by patterns, as columns are.
#pragma once

#include <string_view>

namespace yoke {

/// Does the whole name fit the pattern? * stands for any text, ? for one character.
bool matches(std::string_view pattern, std::string_view name);

}  // namespace yoke
