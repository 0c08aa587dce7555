// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Which constraint equations depend on the others. For set-up and error messages; not a hot path.
#pragma once

#include <vector>

#include <yoke/core/system.hpp>

namespace yoke {

/// Rows of G (blocks computed last) that are linear combinations of the others, by a sparse
/// rank-revealing QR of the scaled G^T. Later rows are named first.
std::vector<int> find_dependent_rows(const System& system);

}  // namespace yoke
