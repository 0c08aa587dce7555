// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <suitesparse/amd.h>

#include <yoke/core/equations/linear/elimination_order.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

// Multiplications for a pivot, for a block below it, for one of the blocks these change.
constexpr double for_pivot = 8.0, for_block = 8.0, for_update = 8.0;

/// By AMD.
std::vector<int> order_of_little_fill(int columns, const std::vector<std::pair<int, int>>& pairs) {
  PatternBuilder builder(columns);
  builder.reserve(2 * pairs.size());
  for (const auto& [i, j] : pairs) {
    builder.add(i, j);
    builder.add(j, i);
  }
  std::vector<int> slot, order(at(columns));
  const SparseMatrix graph = builder.compile(slot);
  std::iota(order.begin(), order.end(), 0);
  if (columns > 1)
    amd_order(columns, graph.column_start.data(), graph.row.data(), order.data(), nullptr, nullptr);
  return order;
}

/// Another order with the same fill. The cliques of the filled pattern make a tree, columns that two of them have in
/// common are in all those between (J. R. S. Blair, B. Peyton, An introduction to chordal graphs and clique trees,
/// 1993): from its ends inward, those with one neighbour left are eliminated but for what they share with it.
class Strands {
 public:
  explicit Strands(const BlockPattern& filled) : filled_(filled) {
    const auto columns = at(filled.columns());
    cliques_.reserve(columns + 1);
    shared_.assign(columns, 0);
    next_member_.assign(columns, -1);
    find_cliques();
    for (const Clique& clique : cliques_)
      for_each_column(clique, [&](int column) { ++shared_[at(column)]; });
  }

  std::vector<int> take_turns() {
    order_.reserve(shared_.size());
    std::array<int, 2> strands = {next_end(), next_end()};
    while (strands[0] >= 0 || strands[1] >= 0)
      for (int& clique : strands)
        if (clique >= 0) clique = eliminate(cliques_[at(clique)], clique);
    return std::move(order_);
  }

 private:
  struct Clique {
    int column;       // it, all that is below it in the pattern,
    int member = -1;  // and a list of others
    int left = 0;     // neighbours not eliminated,
    int around = 0;   // exclusive or of their numbers
    bool taken = false;
  };

  void find_cliques() {
    std::vector<int> home(shared_.size()), size;
    size.reserve(shared_.size());
    for (int k = filled_.columns(); k-- > 0;) {
      const int begin = filled_.start[at(k)], below = filled_.start[at(k) + 1] - begin;
      const int above = below > 0 ? home[at(filled_.row[at(begin)])] : -1;
      if (above >= 0 && size[at(above)] == below) {
        next_member_[at(k)] = std::exchange(cliques_[at(above)].member, k);
        ++size[at(above)];
        home[at(k)] = above;
        continue;
      }
      home[at(k)] = static_cast<int>(cliques_.size());
      cliques_.push_back({.column = k});
      size.push_back(below + 1);
      if (above < 0) continue;
      join(above, home[at(k)]);
      join(home[at(k)], above);
    }
  }

  void join(int clique, int other) {
    ++cliques_[at(clique)].left;
    cliques_[at(clique)].around ^= other;
  }

  template <class Use>
  void for_each_column(const Clique& clique, const Use& use) const {
    use(clique.column);
    for (int i = filled_.start[at(clique.column)]; i < filled_.start[at(clique.column) + 1]; ++i)
      use(filled_.row[at(i)]);
    for (int k = clique.member; k >= 0; k = next_member_[at(k)]) use(k);
  }

  int next_end() {
    for (; next_ < cliques_.size(); ++next_) {
      Clique& clique = cliques_[next_];
      if (clique.taken || clique.left > 1) continue;
      clique.taken = true;
      return static_cast<int>(next_++);
    }
    return -1;
  }

  /// What follows on the same strand.
  int eliminate(const Clique& clique, int number) {
    for_each_column(clique, [&](int column) {
      if (--shared_[at(column)] == 0) order_.push_back(column);
    });
    if (clique.left == 0) return next_end();
    const int follows = clique.around;
    Clique& other = cliques_[at(follows)];
    --other.left;
    other.around ^= number;
    if (other.taken || other.left > 1) return next_end();
    other.taken = true;
    return follows;
  }

  const BlockPattern& filled_;
  std::vector<Clique> cliques_;
  std::vector<int> next_member_;
  std::vector<int> shared_;  // cliques left that a column is in
  std::vector<int> order_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<int> elimination_order(int columns, std::vector<std::pair<int, int>> pairs,
                                   double most) {
  std::vector<int> order = order_of_little_fill(columns, pairs), place(order.size());
  for (int k = 0; k < columns; ++k) place[at(order[at(k)])] = k;
  for (auto& [i, j] : pairs) {
    i = place[at(i)];
    j = place[at(j)];
  }
  BlockPattern filled;
  if (!fill_in(pattern_of(columns, std::move(pairs)), most, filled)) return {};
  std::vector<int> turns = Strands(filled).take_turns();
  for (int& column : turns) column = order[at(column)];
  return turns;
}

bool fill_in(const BlockPattern& pattern, double most, BlockPattern& filled) {
  const int columns = pattern.columns();
  // The children of a column, one after the other.
  std::vector<int> first_child(at(columns), -1), next_child(at(columns), -1);
  std::vector<int> column, seen(at(columns), -1);
  filled.start.reserve(at(columns) + 1);
  filled.row.reserve(pattern.row.size());
  double work = 0.0;
  for (int k = 0; k < columns; ++k) {
    column.clear();
    const auto take = [&](const int* begin, const int* end) {
      for (; begin != end; ++begin) {
        if (*begin == k || seen[at(*begin)] == k) continue;
        seen[at(*begin)] = k;
        column.push_back(*begin);
      }
    };
    take(pattern.row.data() + pattern.start[at(k)], pattern.row.data() + pattern.start[at(k) + 1]);
    for (int child = first_child[at(k)]; child >= 0; child = next_child[at(child)])
      take(filled.row.data() + filled.start[at(child)],
           filled.row.data() + filled.start[at(child) + 1]);
    std::ranges::sort(column);
    const auto count = static_cast<double>(column.size());
    work += for_pivot + for_block * count + 0.5 * for_update * count * (count + 1.0);
    if (work > most) return false;
    if (!column.empty()) next_child[at(k)] = std::exchange(first_child[at(column.front())], k);
    filled.row.insert(filled.row.end(), column.begin(), column.end());
    filled.start.push_back(static_cast<int>(filled.row.size()));
  }
  return true;
}

}  // namespace yoke
