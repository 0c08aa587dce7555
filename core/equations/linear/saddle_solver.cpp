// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/linear/saddle_solver.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include <yoke/core/equations/linear/index.hpp>
#include <yoke/core/equations/linear/range_space.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

constexpr std::array<std::string_view, 4> solver_names = {"automatic", "klu", "range-klu",
                                                          "blocks"};
// Multiplications by blocks, for each row, up to which the saddle matrix always takes longer; and how many
// take as long as one of KLU's, which counts only those of its factors and fetches each through an index.
constexpr double always_fewer = 80.0, for_one_of_klu = 4.0;

}  // namespace

LinearSolver linear_solver_named(std::string_view name) {
  const auto found = std::ranges::find(solver_names, name);
  if (found == solver_names.end())
    throw ModelError(
        fmt::format("unknown linear solver '{}': automatic, klu, range-klu or blocks", name));
  return static_cast<LinearSolver>(found - solver_names.begin());
}

std::string_view name_of(LinearSolver solver) {
  return solver_names[static_cast<std::size_t>(solver)];
}

SaddleSolver::~SaddleSolver() = default;

SaddleSolver::SaddleSolver(SaddleLayout layout, LinearSolver choice) : layout_(std::move(layout)) {
  choose(choice);
}

// A model that is solved by blocks may never need it.
void SaddleSolver::build_matrix() {
  const int n = layout_.dofs();
  const std::vector<JacobianEntry> entries = layout_.entries();
  PatternBuilder pattern(n + layout_.rows);
  pattern.reserve(at(n) + layout_.left_out.size() + layout_.switched.size() + 2 * entries.size());
  for (int i = 0; i < n; ++i) pattern.add(i, i);
  for (const int row : layout_.left_out) pattern.add(n + row, n + row);
  for (const int row : layout_.switched) pattern.add(n + row, n + row);
  stamps_.reserve(entries.size());
  for (const JacobianEntry& e : entries) {
    const int lower = pattern.add(n + e.row, e.dof);
    stamps_.push_back({e.entry, lower, pattern.add(e.dof, n + e.row)});
  }
  std::vector<int> slot;
  matrix_ = pattern.compile(slot);
  for (int i = 0; i < n; ++i) matrix_.value[at(slot[at(i)])] = layout_.mass[at(i)];
  std::size_t next = at(n);
  for (std::size_t i = 0; i < layout_.left_out.size(); ++i) matrix_.value[at(slot[next++])] = 1.0;
  for (std::size_t i = 0; i < layout_.switched.size(); ++i)
    switch_diagonal_.push_back(slot[next++]);
  for (Stamp& s : stamps_) {
    s.lower = slot[at(s.lower)];
    s.upper = slot[at(s.upper)];
  }
}

void SaddleSolver::choose(LinearSolver choice) {
  range_is_klu_ = choice == LinearSolver::range_klu;
  if (!layout_.switched.empty()) klu();  // it will be needed, where nothing may be allocated
  if (choice == LinearSolver::klu) return;
  if (range_is_klu_) {
    range_ = RangeSpace::by_klu(layout_);
    return;
  }
  double most = std::numeric_limits<double>::infinity();
  if (choice == LinearSolver::automatic) most = always_fewer * layout_.rows;
  range_ = RangeSpace::by_blocks(layout_, most);
  if (choice == LinearSolver::automatic && range_ == nullptr)
    range_ = RangeSpace::by_blocks(layout_, for_one_of_klu * klu().multiplications());
}

SparseLU& SaddleSolver::klu() {
  if (matrix_.size == 0) build_matrix();
  if (!lu_) lu_.emplace(matrix_);
  return *lu_;
}

LinearSolver SaddleSolver::in_use() const {
  if (range_ == nullptr) return LinearSolver::klu;
  return range_is_klu_ ? LinearSolver::range_klu : LinearSolver::blocks;
}

const SparseMatrix& SaddleSolver::matrix(const double* G, std::span<const char> dropped) {
  if (matrix_.size == 0) build_matrix();
  double* value = matrix_.value.data();
  for (const Stamp& s : stamps_) value[s.lower] = value[s.upper] = G[s.entry];
  for (std::size_t i = 0; i < switch_diagonal_.size(); ++i)
    value[switch_diagonal_[i]] = dropped[at(layout_.switched[i])] != 0 ? 1.0 : 0.0;
  return matrix_;
}

bool SaddleSolver::factorise(const double* G, std::span<const char> dropped) {
  // What friction holds shall rest to the last bit, as pivots on its own rows make it.
  const bool holding =
      std::ranges::any_of(layout_.switched, [&](int row) { return dropped[at(row)] == 0; });
  by_range_ = range_ != nullptr && !holding && range_->factorise(G, dropped);
  if (by_range_) {
    ++counters_.refactorisations;
    return true;
  }
  return factorise_by_klu(G, dropped);
}

bool SaddleSolver::factorise_by_klu(const double* G, std::span<const char> dropped) {
  matrix(G, dropped);
  const FactorCounters before = klu().counters();
  const bool done = lu_->factorise(matrix_);
  counters_.refactorisations += lu_->counters().refactorisations - before.refactorisations;
  counters_.fresh += lu_->counters().fresh - before.fresh;
  return done;
}

void SaddleSolver::solve(double* b) {
  if (by_range_) {
    if (range_->solve(b)) return;
    if (!leave_range()) return;  // what elimination found is the best there is
    range_->restore(b);
  }
  lu_->solve(b);
}

/// Factorises by KLU what the range space has factors of. False: singular.
bool SaddleSolver::leave_range() {
  std::size_t blocks = 0;
  for (const JacobianBlock& c : layout_.blocks)
    blocks = std::max(blocks, at(c.block + c.rows * c.columns));
  G_.assign(blocks, 0.0);
  dropped_.assign(at(layout_.rows), 0);
  range_->unpack(G_.data(), dropped_.data());
  by_range_ = !factorise_by_klu(G_.data(), dropped_);
  return !by_range_;
}

void SaddleSolver::solve_nearly(double* b) {
  if (by_range_ && range_->solve_nearly(b)) return;
  solve(b);
}

void SaddleSolver::reset() {
  if (range_ != nullptr) range_->reset();
  if (lu_) lu_->reset();
}

bool SaddleSolver::well_conditioned() const {
  constexpr double suspicious = 1e-11;  // reciprocal condition: a rank-revealing QR should look
  return by_range_ || lu_->reciprocal_condition() > suspicious;
}

}  // namespace yoke
