// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#pragma once

#include <yoke/core/equations/system.hpp>

namespace yoke {

/// Can constraint equations become dependent while the mechanism moves? Not if the joints form no
/// closed loop, not counting those that relate angles only.
bool has_closed_loops(const System& system);

}  // namespace yoke
