// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a solver of the saddle system needs to know of a mechanism.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace yoke {

/// The rows of one constraint: a dense block in the array of all blocks.
struct JacobianBlock {
  int row = 0;  // first of its rows
  int rows = 0;
  int columns = 0;  // 3 for each of its bodies
  int dofs = 0;     // offset into SaddleLayout::dof
  int block = 0;    // offset into the array of blocks
};

/// An element of the array of blocks that may differ from zero, and the coordinate it belongs to.
struct JacobianEntry {
  int entry, row, dof;
};

struct SaddleLayout {
  std::span<const double> mass;  // [dofs] diagonal of M
  std::span<const int>
      dof;  // coordinate of each local column, those of a body in a row; -1: ground
  std::vector<JacobianBlock> blocks;
  // Without those of rows that are left out. Asked for where the saddle matrix is made: that may be never, and
  // these are the most numbers of all.
  std::function<std::vector<JacobianEntry>()> entries;
  std::vector<int> left_out;  // rows that never count
  std::vector<int> switched;  // rows that count at times
  int rows = 0;               // equations
  int dofs() const { return static_cast<int>(mass.size()); }
};

}  // namespace yoke
