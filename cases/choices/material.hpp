// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Materials as people type them.
#pragma once

#include <string_view>

#include <yoke/contact/laws/material.hpp>

namespace yoke::cases {

/// "steel", "aluminium" or "E=207GPa,nu=0.3" (Pa, kPa, MPa, GPa). Throws ModelError.
Material parse_material(std::string_view text);

}  // namespace yoke::cases
