// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The readings of a published law; elastic_catalog.hpp explains each.
#pragma once

#include <string_view>

namespace yoke {

enum class Reading { consistent, printed, tabulated };

std::string_view name_of(Reading reading);  ///< "consistent", "printed", "tabulated".

/// Throws ModelError that lists the names.
Reading reading_named(std::string_view name);

/// Throws the ModelError of a law that is not to be had in `reading`.
[[noreturn]] void throw_no_reading(std::string_view law, Reading reading,
                                   std::string_view existing);

}  // namespace yoke
