// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// In which order the columns of a symmetric matrix of blocks are eliminated, and what that fills in.
#pragma once

#include <utility>
#include <vector>

#include <yoke/core/equations/linear/symmetric_blocks.hpp>

namespace yoke {

/// An order of elimination that makes little fill: the old number of each column. `pairs` couples columns. Where
/// branches do not wait for each other, columns of two of them take turns: a processor works at both at once.
/// Empty: more than `most` multiplications.
std::vector<int> elimination_order(int columns, std::vector<std::pair<int, int>> pairs,
                                   double most);

/// The columns of `pattern` with what elimination fills in: a column takes over what is below the ones
/// whose first block below the diagonal is in its row. False: more than `most` multiplications.
bool fill_in(const BlockPattern& pattern, double most, BlockPattern& filled);

}  // namespace yoke
