// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/linear/symmetric_blocks.hpp>

#include <algorithm>
#include <iterator>
#include <numeric>

#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

int BlockPattern::place(int below, int left) const {
  const auto begin = row.begin() + start[at(left)], end = row.begin() + start[at(left) + 1];
  const int before = start[at(left)] + left;  // blocks of the columns before
  if (below == left) return before;
  return before + 1 + static_cast<int>(std::lower_bound(begin, end, below) - begin);
}

BlockPattern pattern_of(int columns, std::vector<std::pair<int, int>> pairs) {
  std::vector<int> next(at(columns) + 1, 0), below(pairs.size());
  for (auto& [i, j] : pairs) {
    if (i > j) std::swap(i, j);
    ++next[at(i) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (const auto& [i, j] : pairs) below[at(next[at(i)]++)] = j;
  BlockPattern pattern;
  pattern.start.reserve(at(columns) + 1);
  auto begin = below.begin();
  for (int column = 0; column < columns; ++column) {
    const auto end = below.begin() + next[at(column)];
    std::sort(begin, end);
    std::unique_copy(begin, end, std::back_inserter(pattern.row));
    begin = end;
    pattern.start.push_back(static_cast<int>(pattern.row.size()));
  }
  return pattern;
}

BlockKlu::BlockKlu(int columns, std::vector<std::pair<int, int>> pairs)
    : pattern_(pattern_of(columns, std::move(pairs))) {
  PatternBuilder builder(2 * columns);
  const auto add = [&](int below, int left) {
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) slot_.push_back(builder.add(2 * below + i, 2 * left + j));
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) slot_.push_back(builder.add(2 * left + j, 2 * below + i));
  };
  for (int column = 0; column < columns; ++column) {
    add(column, column);
    for (int k = pattern_.start[at(column)]; k < pattern_.start[at(column) + 1]; ++k)
      add(pattern_.row[at(k)], column);
  }
  value_.assign(4 * (at(columns) + pattern_.row.size()), 0.0);
  std::vector<int> slot;
  matrix_ = builder.compile(slot);
  for (int& s : slot_) s = slot[at(s)];
  lu_ = std::make_unique<SparseLU>(matrix_, SparseLU::Scaling::none);
}

bool BlockKlu::factorise(double least) {
  const int* slot = slot_.data();
  for (std::size_t block = 0; block < value_.size(); block += 4, slot += 8)
    for (std::size_t i = 0; i < 4; ++i)
      matrix_.value[at(slot[i])] = matrix_.value[at(slot[4 + i])] = value_[block + i];
  return lu_->factorise(matrix_) && lu_->reciprocal_condition() > least;
}

}  // namespace yoke
