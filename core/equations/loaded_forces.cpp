// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/loaded_forces.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

constexpr int most_rounds = 40;
constexpr int full_rounds =
    8;  // then every other step is half of it: out of a cycle between two corners
constexpr double rounding = 64.0 * machine_epsilon;  // of the largest reaction

}  // namespace

LoadedForces::Whole::Whole(const SparseMatrix& saddle, const std::vector<LoadEntry>& entries,
                           int dofs)
    : matrix([&] {
        PatternBuilder pattern(saddle.size);
        pattern.reserve(at(saddle.nonzeros()) + entries.size());
        for (int j = 0; j < saddle.size; ++j)
          for (int k = saddle.column_start[at(j)]; k < saddle.column_start[at(j) + 1]; ++k)
            pattern.add(saddle.row[at(k)], j);
        for (const LoadEntry& e : entries) pattern.add(e.row < 0 ? -1 : e.dof, dofs + e.row);
        return pattern.compile(slots);
      }()),
      lu(matrix) {}

LoadedForces::LoadedForces(System& system, SaddleSolver& saddle)
    : system_(system), saddle_(saddle) {
  find_entries();
  slope_.assign(entries_.size(), 0.0);
  x_.assign(at(system.dofs() + system.rows()) + 1, 0.0);
  right_ = x_;
  have_room_ = saddle.range() != nullptr && saddle.range()->make_room(entries_);
  // Friction that holds is solved by KLU, and nothing shall be allocated when it does.
  if (!have_room_ || !system.holds().empty())
    whole_.emplace(saddle.matrix(system.G(), system.dropped()), entries_, system.dofs());
}

void LoadedForces::find_entries() {
  std::size_t columns = 0;
  for (const std::size_t i : system_.loaded()) {
    const ForceSlot& f = system_.forces()[i];
    columns = std::max(columns, at(f.columns));
    for (int j = 0; j < f.columns; ++j)
      for (int l = f.load; l < f.load + f.load_rows; ++l)
        entries_.push_back({system_.dof()[at(f.dofs + j)], system_.is_left_out(l) ? -1 : l});
  }
  Q_.assign(columns, 0.0);
}

void LoadedForces::reset() {
  if (whole_) whole_->lu.reset();
}

FactorCounters LoadedForces::counters() const {
  FactorCounters sum = whole_ ? whole_->lu.counters() : FactorCounters{};
  sum.refactorisations += by_blocks_;
  return sum;
}

/// The forces at these multipliers into the right-hand side, and their slopes. False: they do nothing.
bool LoadedForces::add_forces(const double* lambda) {
  system_.set_multipliers(lambda);
  std::ranges::fill(slope_, 0.0);
  double* slopes = slope_.data();
  bool any = false;
  for (const std::size_t i : system_.loaded()) {
    const ForceSlot& f = system_.forces()[i];
    std::fill_n(Q_.begin(), f.columns, 0.0);
    f.element->evaluate(system_.force_input(f), {.Q = Q_.data(), .dQ_dlambda = slopes});
    for (int j = 0; j < f.columns; ++j, slopes += f.load_rows) {
      double force = Q_[at(j)];
      for (int l = 0; l < f.load_rows; ++l) {
        any = any || slopes[l] != 0.0;
        if (!system_.is_left_out(f.load + l)) force -= slopes[l] * lambda[f.load + l];
      }
      any = any || force != 0.0;
      if (const int dof = system_.dof()[at(f.dofs + j)]; dof >= 0) right_[at(dof)] += force;
    }
  }
  return any;
}

/// x_ from right_ and the slopes.
bool LoadedForces::solve_linear() {
  if (have_room_ && saddle_.by_range()) {
    ++by_blocks_;
    std::ranges::copy(right_, x_.begin());
    if (saddle_.range()->factorise_loaded(slope_) && saddle_.range()->solve_loaded(x_.data()))
      return true;
  }
  return solve_by_klu();
}

bool LoadedForces::solve_by_klu() {
  const SparseMatrix& saddle = saddle_.matrix(system_.G(), system_.dropped());
  if (!whole_) whole_.emplace(saddle, entries_, system_.dofs());
  std::vector<double>& value = whole_->matrix.value;
  std::ranges::fill(value, 0.0);
  const int* slot = whole_->slots.data();
  for (int k = 0; k < saddle.nonzeros(); ++k) value[at(*slot++)] = saddle.value[at(k)];
  for (const double slope : slope_) value[at(*slot++)] -= slope;
  std::ranges::copy(right_, x_.begin());
  if (!whole_->lu.factorise(whole_->matrix)) return false;
  whole_->lu.solve(x_.data());
  return true;
}

/// A multiplier as a force.
double LoadedForces::size_of(int row, double multiplier) const {
  const bool is_force = system_.measure(row) == Measure::length;
  return std::abs(multiplier) / (is_force ? 1.0 : system_.scales().length);
}

/// What is left to do: the error of a Newton step is about its square over the load, whose direction
/// bends that much; in parts of rounding. Not finite if the solution is not.
double LoadedForces::error(const double* lambda) const {
  const double* next = x_.data() + system_.dofs();
  double largest = 0.0, error = 0.0;
  for (const std::size_t i : system_.loaded()) {
    const ForceSlot& f = system_.forces()[i];
    for (int l = f.load; l < f.load + f.load_rows; ++l) {
      const double size = size_of(l, next[l]);
      if (!(size <= largest)) largest = size;
    }
  }
  for (const std::size_t i : system_.loaded()) {
    const ForceSlot& f = system_.forces()[i];
    double size = 0.0, moved = 0.0;
    for (int l = f.load; l < f.load + f.load_rows; ++l) {
      size = std::max(size, size_of(l, next[l]));
      moved = std::max(moved, size_of(l, next[l] - lambda[l]));
    }
    if (moved > rounding * largest)
      error = std::max(error,
                       moved * moved / (std::max(size, rounding * largest) * rounding * largest));
  }
  return std::isfinite(largest) ? error : largest;
}

bool LoadedForces::solve(const double* b, double* x) {
  const int size = system_.dofs() + system_.rows();
  double* lambda = x + system_.dofs();
  for (int round = 0; round < most_rounds; ++round) {
    std::copy_n(b, size, right_.begin());
    if (!add_forces(lambda)) break;
    if (!solve_linear()) return fail(lambda);
    const double left = error(lambda);
    const bool half = round >= full_rounds && round % 2 == 0 && left > 1.0;
    for (int i = 0; i < size; ++i) x[i] = half ? 0.5 * (x[i] + x_[at(i)]) : x_[at(i)];
    if (!std::isfinite(left)) return fail(lambda);
    if (left <= 1.0) break;
    if (round + 1 == most_rounds) return fail(lambda);
  }
  system_.forget_wedged();
  return true;
}

/// Blames the one with the largest load; its force cannot be told from others' that follow from it.
bool LoadedForces::fail(const double* lambda) {
  const ForceSlot* worst = nullptr;
  double most = -1.0;
  for (const std::size_t i : system_.loaded()) {
    const ForceSlot& f = system_.forces()[i];
    double size = 0.0;
    for (int l = f.load; l < f.load + f.load_rows; ++l) size = std::max(size, std::abs(lambda[l]));
    if (!(size > most) && std::isfinite(size)) continue;
    most = size;
    worst = &f;
  }
  if (worst != nullptr) system_.blame_wedged(*worst);
  return false;
}

}  // namespace yoke
