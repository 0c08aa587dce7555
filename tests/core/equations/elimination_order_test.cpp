// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <suitesparse/amd.h>

#include <yoke/core/equations/linear/elimination_order.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

using namespace yoke;

namespace {

using Pairs = std::vector<std::pair<int, int>>;
constexpr double any = std::numeric_limits<double>::infinity();

/// Blocks below the diagonal after elimination in this order.
std::size_t blocks_of(const std::vector<int>& order, Pairs pairs) {
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  for (auto& [i, j] : pairs) {
    i = place[static_cast<std::size_t>(i)];
    j = place[static_cast<std::size_t>(j)];
  }
  BlockPattern filled;
  REQUIRE(fill_in(pattern_of(static_cast<int>(order.size()), std::move(pairs)), any, filled));
  return filled.row.size();
}

std::vector<int> order_of_amd(int columns, const Pairs& pairs) {
  std::vector<std::vector<int>> beside(static_cast<std::size_t>(columns));
  for (const auto& [i, j] : pairs) {
    beside[static_cast<std::size_t>(i)].push_back(j);
    beside[static_cast<std::size_t>(j)].push_back(i);
  }
  std::vector<int> start{0}, row, order(static_cast<std::size_t>(columns));
  for (std::vector<int>& rows : beside) {
    std::ranges::sort(rows);
    row.insert(row.end(), rows.begin(), std::unique(rows.begin(), rows.end()));
    start.push_back(static_cast<int>(row.size()));
  }
  row.reserve(1);  // AMD wants an address
  REQUIRE(amd_order(columns, start.data(), row.data(), order.data(), nullptr, nullptr) >= AMD_OK);
  return order;
}

}  // namespace

TEST_CASE("a chain is eliminated from both ends in turn, without fill") {
  const int columns = 101;
  Pairs pairs;
  for (int k = 1; k < columns; ++k) pairs.emplace_back(k - 1, k);
  const std::vector<int> order = elimination_order(columns, pairs, any);
  REQUIRE(order.size() == columns);
  CHECK(blocks_of(order, pairs) == pairs.size());
  for (std::size_t k = 0; k + 3 < order.size(); k += 2) {
    CHECK(std::abs(order[k + 2] - order[k]) == 1);
    CHECK(std::abs(order[k + 3] - order[k + 1]) == 1);
  }
}

TEST_CASE("turns of branches add no fill to AMD's order of any graph") {
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial) {
    const int columns = 1 + static_cast<int>(random() % 40),
              extra = static_cast<int>(random() % 12);
    const auto any_column = [&](int below) {
      return static_cast<int>(random() % static_cast<unsigned>(below));
    };
    Pairs pairs;
    for (int k = 1; k < columns; ++k)
      if (random() % 8 != 0) pairs.emplace_back(any_column(k), k);  // else another tree begins
    for (int k = 0; k < extra; ++k) {
      const int i = any_column(columns), j = any_column(columns);
      if (i != j) pairs.emplace_back(i, j);
    }
    CAPTURE(trial);
    const std::vector<int> order = elimination_order(columns, pairs, any);
    std::vector<int> sorted = order, all(static_cast<std::size_t>(columns));
    std::ranges::sort(sorted);
    std::iota(all.begin(), all.end(), 0);
    REQUIRE(sorted == all);
    CHECK(blocks_of(order, pairs) <= blocks_of(order_of_amd(columns, pairs), pairs));
  }
}

TEST_CASE("a graph that takes too many multiplications has no order") {
  Pairs pairs;
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < i; ++j) pairs.emplace_back(j, i);
  CHECK(elimination_order(30, pairs, 1e3).empty());
  CHECK(elimination_order(30, pairs, 1e5).size() == 30);
}
