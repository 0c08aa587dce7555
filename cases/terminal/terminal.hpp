// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a terminal can show, and lines made for it.
#pragma once

#include <cstdio>
#include <span>
#include <string>
#include <string_view>

namespace yoke::cases {

bool is_terminal(std::FILE* stream);
/// A terminal, NO_COLOR (https://no-color.org) not set to anything, TERM not dumb.
bool has_colours(std::FILE* stream);
/// A terminal whose locale is UTF-8.
bool has_blocks(std::FILE* stream);

enum class Paint { bold, good, bad };
/// The text, in colour if the stream has colours.
std::string painted(std::string_view text, Paint paint, std::FILE* stream);

/// One character of eight heights a value, from the least to the largest of them; those that are not
/// finite are blank.
std::string sparkline(std::span<const double> values);

}  // namespace yoke::cases
