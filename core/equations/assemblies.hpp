// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Which bodies move together: what is true of one assembly must not depend on the others.
#pragma once

#include <vector>

#include <yoke/core/equations/system.hpp>

namespace yoke {

/// [bodies] Which bodies constraints tie together, not by way of the ground: one of them for each.
std::vector<int> assemblies_of(const System& system);

}  // namespace yoke
