// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/linear/range_space.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <yoke/core/equations/linear/block_elimination.hpp>
#include <yoke/core/equations/linear/elimination_order.hpp>
#include <yoke/core/equations/linear/index.hpp>
#include <yoke/core/equations/linear/pair.hpp>

namespace yoke {

namespace {

// With a smallest pivot p a solution loses eps/p of its digits, and so does each refinement of what the last
// one left: one is enough above the second, two above the first. Below it a few small pivots after each other may
// lose more than the smallest says: what is left after the last refinement tells.
constexpr double least_pivot = 1e-9, one_refinement = 1e-5;
// What is left of an equation, in parts of its terms, up to which nothing is refined. What a reaction itself
// accelerates counts little beside: that is the rounding of an acceleration that is zero.
constexpr double misfit_allowed = 1e-13, share_of_reaction = 1e-4;
constexpr double misfit_accepted =
    1e-12;  // with loads, in parts of what the largest reaction accelerates
constexpr double rounding_left = 16.0 * machine_epsilon;
// A body with very many joints couples all of them: what that takes is not even listed.
constexpr std::size_t most_products_per_part = 64;

/// An equation all of whose terms are rounding misses by as much as these, always: so all are seen beside the
/// largest reaction, in the metric of the masses, where lengths and angles are alike.
bool is_satisfied(const std::vector<double>& misfit, const std::vector<double>& reaction,
                  const std::vector<double>& diagonal) {
  double missed = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < misfit.size(); ++i) {
    const double root = std::sqrt(diagonal[i]), miss = std::abs(misfit[i]) / root;
    if (!(miss <= missed)) missed = miss;  // also what is not a number
    largest = std::max(largest, root * std::abs(reaction[i]));
  }
  return missed <= misfit_accepted * largest;
}

/// What columns `g` of a body in two rows make of its `a`.
inline Pair product(const double* g, const double* a) {
  return pair_at(g) * a[0] + pair_at(g + 2) * a[1] + pair_at(g + 4) * a[2];
}

/// Both rows of a constraint follow each other.
inline Pair of_rows(const int* row, const double* all) {
  return row[1] >= 0 ? pair_at(all + row[0]) : Pair(all[row[0]], 0.0);
}

}  // namespace

std::unique_ptr<RangeSpace> RangeSpace::by_blocks(const SaddleLayout& layout, double most) {
  return lay_out(layout, most, false);
}

std::unique_ptr<RangeSpace> RangeSpace::by_klu(const SaddleLayout& layout) {
  return lay_out(layout, std::numeric_limits<double>::infinity(), true);
}

std::unique_ptr<RangeSpace> RangeSpace::lay_out(const SaddleLayout& layout, double most, bool klu) {
  const bool have_mass = std::ranges::all_of(layout.mass, [](double m) { return m > 0.0; });
  if (!have_mass || layout.rows == 0) return nullptr;
  std::unique_ptr<RangeSpace> made(new RangeSpace);
  made->dofs_ = layout.dofs();
  made->mobility_.reserve(layout.mass.size());
  for (const double m : layout.mass) made->mobility_.push_back(1.0 / m);
  made->add_nodes(layout);
  const int columns = static_cast<int>(made->nodes_.size()) - 1;
  std::vector<std::pair<int, int>> pairs = made->pairs();
  if (pairs.size() > most_products_per_part * made->parts_.size()) return nullptr;
  if (klu) {
    made->factors_ = std::make_unique<BlockKlu>(columns, std::move(pairs));
  } else {
    const std::vector<int> order = elimination_order(columns, std::move(pairs), most);
    if (order.empty()) return nullptr;
    made->put_in_order(order);
    std::unique_ptr<BlockElimination> blocks = BlockElimination::make(columns, made->pairs());
    made->blocks_ = blocks.get();
    made->factors_ = std::move(blocks);
  }
  made->find_products();
  made->G_.assign(6 * made->parts_.size(), 0.0);
  made->before_.assign(at(made->dofs_), 0.0);
  made->given_.assign(at(made->dofs_ + layout.rows), 0.0);
  for (std::vector<double>* v : {&made->lambda_, &made->x_, &made->diagonal_})
    v->assign(2 * at(columns), 0.0);
  made->counts_.assign(2 * at(columns), 0);
  return made;
}

void RangeSpace::add_nodes(const SaddleLayout& layout) {
  nodes_.reserve(layout.blocks.size() + 1);
  parts_.reserve(layout.dof.size() / 3 + 1);
  for (const JacobianBlock& c : layout.blocks)
    for (int i = 0; i < c.rows; i += 2) {
      const bool both = i + 1 < c.rows;
      nodes_.push_back({.row = {c.row + i, both ? c.row + i + 1 : -1},
                        .part = static_cast<int>(parts_.size()),
                        .place = 0});
      for (int j = 0; j < c.columns; j += 3) {
        const int dof = layout.dof[at(c.dofs + j)], source = c.block + i * c.columns + j;
        if (dof >= 0)
          parts_.push_back(
              {.dof = dof, .source = {source, both ? source + c.columns : -1}, .product = 0});
      }
    }
  nodes_.push_back({.row = {-1, -1}, .part = static_cast<int>(parts_.size()), .place = 0});
}

/// Parts, those of a body in a row in the order of their nodes; `first` gets the place of each body's first,
/// and one behind the last.
std::vector<int> RangeSpace::parts_by_body(std::vector<int>& first) const {
  first.assign(at(dofs_ / 3) + 1, 0);
  const auto count = at(nodes_.back().part);
  for (std::size_t p = 0; p < count; ++p) ++first[at(parts_[p].dof / 3)];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> sorted(count);
  for (std::size_t p = count; p-- > 0;)
    sorted[at(--first[at(parts_[p].dof / 3)])] = static_cast<int>(p);
  return sorted;
}

/// Nodes that have a body in common.
std::vector<std::pair<int, int>> RangeSpace::pairs() const {
  std::vector<int> first;
  std::vector<int> node = parts_by_body(first), of_part(parts_.size());
  for (int k = 0; k + 1 < static_cast<int>(nodes_.size()); ++k)
    for (int p = nodes_[at(k)].part; p < nodes_[at(k + 1)].part; ++p) of_part[at(p)] = k;
  for (int& part : node) part = of_part[at(part)];
  std::vector<std::pair<int, int>> pairs;
  const std::size_t most = most_products_per_part * parts_.size();
  pairs.reserve(node.size());
  for (std::size_t body = 0; body + 1 < first.size(); ++body)
    for (int j = first[body] + 1; j < first[body + 1] && pairs.size() <= most; ++j)
      for (int i = first[body]; i < j; ++i)
        if (node[at(i)] != node[at(j)]) pairs.emplace_back(node[at(i)], node[at(j)]);
  return pairs;
}

void RangeSpace::put_in_order(const std::vector<int>& order) {
  const std::vector<Node> nodes = std::move(nodes_);
  const std::vector<Part> parts = std::move(parts_);
  nodes_.clear();
  parts_.clear();
  nodes_.reserve(nodes.size());
  parts_.reserve(parts.size() + 1);
  for (const int k : order) {
    Node node = nodes[at(k)];
    const auto begin = parts.begin() + node.part, end = parts.begin() + nodes[at(k + 1)].part;
    node.part = static_cast<int>(parts_.size());
    parts_.insert(parts_.end(), begin, end);
    nodes_.push_back(node);
  }
  nodes_.push_back({.row = {-1, -1}, .part = static_cast<int>(parts_.size()), .place = 0});
}

void RangeSpace::find_products() {
  const int columns = static_cast<int>(nodes_.size()) - 1;
  std::vector<int> first;
  const std::vector<int> uses = parts_by_body(first);
  std::vector<int> node(parts_.size());
  for (int k = 0; k < columns; ++k)
    for (int p = nodes_[at(k)].part; p < nodes_[at(k + 1)].part; ++p) node[at(p)] = k;
  const BlockPattern& pattern = factors_->pattern();
  const int blocks = columns + static_cast<int>(pattern.row.size());
  std::vector<bool> used(at(blocks), false);
  products_.reserve(pattern.row.size());
  for (int k = 0; k < columns; ++k) {
    nodes_[at(k)].place = 4 * pattern.place(k, k);
    for (int p = nodes_[at(k)].part; p < nodes_[at(k + 1)].part; ++p) {
      Part& part = parts_[at(p)];
      part.product = static_cast<int>(products_.size());
      const auto body = at(part.dof / 3);
      for (int i = first[body]; i < first[body + 1]; ++i) {
        const int other = uses[at(i)], left = node[at(other)];
        if (left >= k) continue;
        const int place = pattern.place(k, left);
        products_.push_back({.part = other, .place = 4 * place, .first = !used[at(place)]});
        used[at(place)] = true;
      }
    }
    used[at(pattern.place(k, k))] = true;
  }
  for (int place = 0; place < blocks; ++place)
    if (!used[at(place)]) fill_.push_back(4 * place);
  parts_.push_back({.dof = 0, .source = {-1, -1}, .product = static_cast<int>(products_.size())});
}

/// S, and the blocks in the order of its nodes.
void RangeSpace::assemble(const double* G, std::span<const char> dropped) {
  static constexpr double nothing[3] = {0.0, 0.0, 0.0};
  double *S = factors_->values(), *g = G_.data();
  for (const int place : fill_) std::fill_n(S + place, 4, 0.0);
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) {
    const Node& node = nodes_[k];
    char* counts = counts_.data() + 2 * k;
    for (int i = 0; i < 2; ++i)
      counts[i] = node.row[i] >= 0 && dropped[at(node.row[i])] == 0 ? 1 : 0;
    Pair squares(0.0, 0.0), mixed(0.0, 0.0);
    for (int p = node.part; p < nodes_[k + 1].part; ++p, g += 6) {
      const Part& part = parts_[at(p)];
      const double *w = mobility_.data() + part.dof,
                   *first = counts[0] != 0 ? G + part.source[0] : nothing,
                   *second = counts[1] != 0 ? G + part.source[1] : nothing;
      const Pair g0(first[0], second[0]), g1(first[1], second[1]), g2(first[2], second[2]);
      put(g, g0);
      put(g + 2, g1);
      put(g + 4, g2);
      const Pair u0 = g0 * w[0], u1 = g1 * w[1], u2 = g2 * w[2];
      squares += u0 * g0 + u1 * g1 + u2 * g2;
      mixed += u0 * swapped(g0) + u1 * swapped(g1) + u2 * swapped(g2);
      for (int i = part.product; i < parts_[at(p) + 1].product; ++i) {
        const Product& product = products_[at(i)];
        const double* h = G_.data() + 6 * product.part;
        const Pair h0 = pair_at(h), h1 = pair_at(h + 2), h2 = pair_at(h + 4);
        Pair upper = u0[0] * h0 + u1[0] * h1 + u2[0] * h2;
        Pair lower = u0[1] * h0 + u1[1] * h1 + u2[1] * h2;
        double* s = S + product.place;
        if (!product.first) {
          upper += pair_at(s);
          lower += pair_at(s + 2);
        }
        put(s, upper);
        put(s + 2, lower);
      }
    }
    if (counts[0] == 0) squares[0] = 1.0;
    if (counts[1] == 0) squares[1] = 1.0;
    put(diagonal_.data() + 2 * k, squares);
    double* s = S + node.place;
    put(s, {squares[0], mixed[1]});
    put(s + 2, {mixed[1], squares[1]});
  }
}

bool RangeSpace::factorise(const double* G, std::span<const char> dropped) {
  assemble(G, dropped);
  return factors_->factorise(least_pivot);
}

/// x = G a - gamma; where rows do not count, their multipliers.
void RangeSpace::start(const double* gamma) {
  const double* g = G_.data();
  const char* counts = counts_.data();
  double* x = x_.data();
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k, counts += 2, x += 2) {
    const Node& node = nodes_[k];
    Pair sum(0.0, 0.0);
    for (int p = node.part; p < nodes_[k + 1].part; ++p, g += 6)
      sum += product(g, a_ + parts_[at(p)].dof);
    const Pair right = of_rows(node.row, gamma);
    put(x, sum - right);
    if (counts[0] == 0) x[0] = right[0];
    if (counts[1] == 0) x[1] = right[1];
  }
}

/// The same of what is left to do, and how large it is in parts of its terms.
double RangeSpace::find_misfit(const double* gamma) {
  double largest = 0.0;
  const double* g = G_.data();
  const char* counts = counts_.data();
  double* x = x_.data();
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k, counts += 2, x += 2) {
    const Node& node = nodes_[k];
    Pair sum(0.0, 0.0), size(0.0, 0.0);
    for (int p = node.part; p < nodes_[k + 1].part; ++p, g += 6) {
      const double* a = a_ + parts_[at(p)].dof;
      const Pair x0 = pair_at(g) * a[0], x1 = pair_at(g + 2) * a[1], x2 = pair_at(g + 4) * a[2];
      sum += x0 + x1 + x2;
      size += x0.abs() + x1.abs() + x2.abs();
    }
    const Pair right = of_rows(node.row, gamma);
    Pair misfit = sum - right;
    for (int i = 0; i < 2; ++i)
      if (counts[i] == 0) misfit[i] = 0.0;
    put(x, misfit);
    const Pair scale = size + right.abs() +
                       share_of_reaction * pair_at(diagonal_.data() + 2 * k) *
                           pair_at(lambda_.data() + 2 * k).abs();
    for (int i = 0; i < 2; ++i)
      if (counts[i] != 0 && !(std::abs(misfit[i]) <= largest * scale[i]))
        largest = std::abs(misfit[i]) / scale[i];
  }
  return largest;
}

/// lambda and a by what the misfit x asks for.
void RangeSpace::correct() {
  if (loaded_)
    loaded_factors_->solve(x_.data());
  else
    factors_->solve(x_.data());
  const double* g = loaded_ ? H_.data() : G_.data();
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) {
    const double u = x_[2 * k], v = x_[2 * k + 1];
    lambda_[2 * k] += u;
    lambda_[2 * k + 1] += v;
    for (int p = nodes_[k].part; p < nodes_[k + 1].part; ++p, g += 6) {
      double* a = a_ + parts_[at(p)].dof;
      const double* w = mobility_.data() + parts_[at(p)].dof;
      a[0] -= w[0] * (g[0] * u + g[1] * v);
      a[1] -= w[1] * (g[2] * u + g[3] * v);
      a[2] -= w[2] * (g[4] * u + g[5] * v);
    }
  }
}

/// What only rounding is left of was the rounding of forces in balance: what does not move rests to the last bit.
void RangeSpace::refine() {
  std::copy_n(a_, before_.size(), before_.begin());
  correct();
  for (std::size_t i = 0; i < before_.size(); ++i)
    if (std::abs(a_[i]) <= rounding_left * std::abs(before_[i])) a_[i] = 0.0;
}

/// The solution without constraints, and what their equations make of it.
void RangeSpace::begin(double* b) {
  a_ = b;
  for (std::size_t i = 0; i < mobility_.size(); ++i) a_[i] *= mobility_[i];
  std::ranges::fill(lambda_, 0.0);
  start(b + dofs_);
  correct();
}

void RangeSpace::finish(double* b) const {
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k)
    for (int i = 0; i < 2; ++i)
      if (const int row = nodes_[k].row[i]; row >= 0) b[dofs_ + row] = lambda_[2 * k + at(i)];
}

bool RangeSpace::solve(double* b) {
  const double* gamma = b + dofs_;
  loaded_ = false;
  const bool doubtful = factors_->smallest_pivot() < one_refinement;
  if (doubtful) std::copy_n(b, given_.size(), given_.begin());
  begin(b);
  const int refinements = doubtful ? 2 : 1;
  for (int i = 0; i < refinements && find_misfit(gamma) > misfit_allowed; ++i) refine();
  const bool good = !doubtful || find_misfit(gamma) <= misfit_allowed;
  finish(b);
  return good;
}

bool RangeSpace::solve_nearly(double* b) {
  if (factors_->smallest_pivot() < one_refinement) return false;
  loaded_ = false;
  a_ = b;
  std::ranges::fill(lambda_,
                    0.0);  // nobody asks for them, but sums of many corrections may overflow
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) {
    Pair right = of_rows(nodes_[k].row, b + dofs_);
    for (int i = 0; i < 2; ++i)
      if (counts_[2 * k + at(i)] == 0) right[i] = 0.0;
    put(x_.data() + 2 * k, -right);
  }
  correct();
  return true;
}

void RangeSpace::restore(double* b) const { std::ranges::copy(given_, b); }

void RangeSpace::unpack(double* G, char* dropped) const {
  const double* g = G_.data();
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) {
    for (std::size_t i = 0; i < 2; ++i)
      if (const int row = nodes_[k].row[i]; row >= 0)
        dropped[row] = counts_[2 * k + i] == 0 ? 1 : 0;
    for (int p = nodes_[k].part; p < nodes_[k + 1].part; ++p, g += 6)
      for (int i = 0; i < 2; ++i)
        if (const int source = parts_[at(p)].source[i]; source >= 0)
          for (int column = 0; column < 3; ++column) G[source + column] = g[2 * column + i];
  }
}

bool RangeSpace::make_room(std::span<const LoadEntry> entries) {
  if (blocks_ == nullptr) return false;
  std::vector<int> node_of_row;
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k)
    for (const int row : nodes_[k].row) {
      if (row >= static_cast<int>(node_of_row.size())) node_of_row.resize(at(row) + 1, -1);
      if (row >= 0) node_of_row[at(row)] = static_cast<int>(k);
    }
  load_place_.clear();
  load_place_.reserve(entries.size());
  for (const LoadEntry& e : entries) {
    if (e.dof < 0 || e.row < 0) {
      load_place_.push_back(6 * nodes_.back().part);  // behind the last part
      continue;
    }
    const std::size_t k = at(node_of_row[at(e.row)]);
    const int end = nodes_[k + 1].part, body = 3 * (e.dof / 3);
    int p = nodes_[k].part;
    while (p < end && parts_[at(p)].dof != body) ++p;
    if (p == end) return false;
    load_place_.push_back(6 * p + 2 * (e.dof - body) + (nodes_[k].row[0] == e.row ? 0 : 1));
  }
  H_.assign(G_.size(), 0.0);
  loaded_factors_ = std::make_unique<BlockLu>(*blocks_);
  return true;
}

bool RangeSpace::factorise_loaded(std::span<const double> D) {
  std::ranges::copy(G_, H_.begin());
  for (std::size_t i = 0; i < load_place_.size(); ++i) H_[at(load_place_[i])] -= D[i];
  assemble_loaded();
  return loaded_factors_->factorise(least_pivot);
}

/// G M^-1 H^T. Rows that do not count have zeros in both, and no elements of D.
void RangeSpace::assemble_loaded() {
  double *lower = loaded_factors_->lower(), *upper = loaded_factors_->upper();
  for (const int place : fill_) {
    std::fill_n(lower + place, 4, 0.0);
    std::fill_n(upper + place, 4, 0.0);
  }
  const auto multiply = [](const double* g, const double* h, double* out) {
    out[0] = g[0] * h[0] + g[2] * h[2] + g[4] * h[4];
    out[1] = g[0] * h[1] + g[2] * h[3] + g[4] * h[5];
    out[2] = g[1] * h[0] + g[3] * h[2] + g[5] * h[4];
    out[3] = g[1] * h[1] + g[3] * h[3] + g[5] * h[5];
  };
  const auto weigh = [](const double* g, const double* w, double* out) {
    for (int i = 0; i < 6; ++i) out[i] = g[i] * w[i / 2];
  };
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) {
    double* diagonal = lower + nodes_[k].place;
    std::fill_n(diagonal, 4, 0.0);
    for (int p = nodes_[k].part; p < nodes_[k + 1].part; ++p) {
      const double *w = mobility_.data() + parts_[at(p)].dof, *g = G_.data() + 6 * p;
      double wg[6], wh[6], add[4];
      weigh(g, w, wg);
      weigh(H_.data() + 6 * p, w, wh);
      multiply(g, wh, add);
      for (int j = 0; j < 4; ++j) diagonal[j] += add[j];
      for (int i = parts_[at(p)].product; i < parts_[at(p) + 1].product; ++i) {
        const Product& shared = products_[at(i)];
        double *below = lower + shared.place, *above = upper + shared.place, mirrored[4];
        multiply(wg, H_.data() + 6 * shared.part, add);
        multiply(G_.data() + 6 * shared.part, wh, mirrored);
        for (int j = 0; j < 4; ++j) {
          below[j] = shared.first ? add[j] : below[j] + add[j];
          above[j] = shared.first ? mirrored[j] : above[j] + mirrored[j];
        }
      }
    }
    if (counts_[2 * k] == 0) diagonal[0] = 1.0;
    if (counts_[2 * k + 1] == 0) diagonal[3] = 1.0;
  }
}

bool RangeSpace::solve_loaded(double* b) {
  const double* gamma = b + dofs_;
  loaded_ = true;
  begin(b);
  double misfit = find_misfit(gamma);
  for (int i = 0; i < 2 && !(misfit <= misfit_allowed); ++i) {
    refine();
    misfit = find_misfit(gamma);
  }
  finish(b);
  return misfit <= misfit_allowed || is_satisfied(x_, lambda_, diagonal_);
}

}  // namespace yoke
