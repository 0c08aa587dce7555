// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Two small things that every file of the equations needs.
#pragma once

#include <cstddef>
#include <limits>

namespace yoke {

/// A row or column number as the subscript of a standard container.
inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Distance from 1 to the next double.
inline constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();

}  // namespace yoke
