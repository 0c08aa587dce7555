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

LoadedForces::LoadedForces(System& system, const SparseMatrix& saddle)
    : system_(system),
      first_slope_(at(saddle.nonzeros())),
      matrix_(pattern(system, saddle, slots_)),
      lu_(matrix_) {
  x_.assign(at(saddle.size) + 1, 0.0);
  std::size_t columns = 0, rows = 0;
  for (const std::size_t i : system.loaded()) {
    columns = std::max(columns, at(system.forces()[i].columns));
    rows = std::max(rows, at(system.forces()[i].load_rows));
  }
  Q_.assign(columns, 0.0);
  slope_.assign(columns * rows, 0.0);
}

SparseMatrix LoadedForces::pattern(const System& system, const SparseMatrix& saddle,
                                   std::vector<int>& slots) {
  PatternBuilder pattern(saddle.size);
  for (int j = 0; j < saddle.size; ++j)
    for (int k = saddle.column_start[at(j)]; k < saddle.column_start[at(j) + 1]; ++k)
      pattern.add(saddle.row[at(k)], j);
  for (const std::size_t i : system.loaded()) {
    const ForceSlot& f = system.forces()[i];
    for (int j = 0; j < f.columns; ++j)
      for (int l = 0; l < f.load_rows; ++l)
        pattern.add(system.is_left_out(f.load + l) ? -1 : system.dof()[at(f.dofs + j)],
                    system.dofs() + f.load + l);
  }
  return pattern.compile(slots);
}

void LoadedForces::start(const SparseMatrix& saddle, const double* b) {
  std::ranges::fill(matrix_.value, 0.0);
  for (int k = 0; k < saddle.nonzeros(); ++k)
    matrix_.value[at(slots_[at(k)])] = saddle.value[at(k)];
  std::copy_n(b, saddle.size, x_.begin());
}

/// The forces at these multipliers into the matrix and the right-hand side. False: they do nothing.
bool LoadedForces::add_forces(const double* lambda) {
  system_.set_multipliers(lambda);
  const int* slot = slots_.data() + first_slope_;
  bool any = false;
  for (const std::size_t i : system_.loaded()) {
    const ForceSlot& f = system_.forces()[i];
    std::fill_n(Q_.begin(), f.columns, 0.0);
    std::fill_n(slope_.begin(), f.columns * f.load_rows, 0.0);
    f.element->evaluate(system_.force_input(f), {.Q = Q_.data(), .dQ_dlambda = slope_.data()});
    const double* slope = slope_.data();
    for (int j = 0; j < f.columns; ++j) {
      double force = Q_[at(j)];
      for (int l = 0; l < f.load_rows; ++l, ++slope, ++slot) {
        any = any || *slope != 0.0;
        matrix_.value[at(*slot)] -= *slope;
        if (!system_.is_left_out(f.load + l)) force -= *slope * lambda[f.load + l];
      }
      any = any || force != 0.0;
      if (const int dof = system_.dof()[at(f.dofs + j)]; dof >= 0) x_[at(dof)] += force;
    }
  }
  return any;
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

bool LoadedForces::solve(const SparseMatrix& saddle, const double* b, double* x) {
  double* lambda = x + system_.dofs();
  for (int round = 0; round < most_rounds; ++round) {
    start(saddle, b);
    if (!add_forces(lambda)) break;
    if (!lu_.factorise(matrix_)) return fail(lambda);
    lu_.solve(x_.data());
    const double left = error(lambda);
    const bool half = round >= full_rounds && round % 2 == 0 && left > 1.0;
    for (int i = 0; i < saddle.size; ++i) x[i] = half ? 0.5 * (x[i] + x_[at(i)]) : x_[at(i)];
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
