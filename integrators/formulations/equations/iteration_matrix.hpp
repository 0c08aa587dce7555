// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The sparse iteration matrix of an implicit formulation, put together from the blocks that the
// elements give. A formulation says once where which block goes (a table of placements) and what
// its rows and columns are measured in; it gets the pattern, the values, the scaling and the
// factors. ggl_matrix.cpp shows the use.
//
// The matrix is scaled before KLU sees it: with time in units of 1/rate, lengths in the length
// scale and masses in the mean mass all entries are of order one. Unscaled, the reciprocal
// condition of a matrix of gram-and-millimetre links falls to 1e-12 at steps of a microsecond, and
// the pivots of the last factor are never good enough.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include <yoke/core/equations/dynamics.hpp>

namespace yoke {

/// What can be placed in an iteration matrix; n coordinates, m equations, nz element states.
/// K(x) = d(G^T x)/dq, H = d(G v + Phi_t)/dq. Rows of constraints that the system has dropped
/// are left out of G, G^T and H.
enum class Block {
  mass,         // n x n, diagonal of M
  coordinates,  // n x n, identity
  states,       // nz x nz, identity
  dropped,      // m x m, 1 on the diagonal of equations left out only: their multiplier is zero
  open,         // m x m, 1 on the diagonal of rows of friction that does not hold now
  hold,         // m x m, 1 on the diagonal of all rows of friction that may hold
  G,            // m x n
  G_position,   // m x n, rows of positions only
  G_T,          // n x m
  H,            // m x n, at the velocities
  H_hold,       // m x n, the same of friction that may hold only
  H_second,     // m x n, at the second velocities
  K_lambda,     // n x n
  K_mu,         // n x n
  Q_q,          // n x n, dQ/dq
  Q_v,          // n x n
  Q_z,          // n x nz
  Q_lambda,     // n x m, of forces that depend on reactions
  z_q,          // nz x n, dz'/dq
  z_v,          // nz x n
  z_z,          // nz x nz
  z_lambda,     // nz x m
};
inline constexpr std::size_t block_count = static_cast<std::size_t>(Block::z_lambda) + 1;

/// matrix[row .., column ..] += factors[factor] * block, with the factors of each evaluation.
struct Placement {
  Block block;
  int row, column;
  int factor;
};

/// What a part of the unknowns or of the equations is measured in.
enum class Unit {
  coordinate,  // n: length scale, or 1 rad
  force,       // n: mean mass x length scale, or that x length scale; over time squared
  equation,    // m: length scale or 1 rad
  multiplier,  // m: as force
  state,       // nz: as it is
};

/// A part of the unknowns (columns) or equations (rows), in units of `unit` x rate^power.
struct Part {
  Unit unit;
  int offset;
  int power = 0;
};

struct MatrixLayout {
  int size = 0;
  std::vector<Placement> placements;
  std::vector<Part> rows, columns;
};

/// Multipliers without those of the equations that the system has dropped.
class MultiplierMask {
 public:
  explicit MultiplierMask(const System& system) : system_(system) {
    if (!system.left_out_rows().empty()) kept_.resize(static_cast<std::size_t>(system.rows()));
  }
  const double* kept(const double* multipliers) {
    if (kept_.empty()) return multipliers;
    std::copy_n(multipliers, kept_.size(), kept_.begin());
    for (const int i : system_.left_out_rows()) kept_[static_cast<std::size_t>(i)] = 0.0;
    return kept_.data();
  }

 private:
  const System& system_;
  std::vector<double> kept_;
};

class IterationMatrix {
 public:
  /// Where the blocks are evaluated; what no placement needs may be null.
  struct Point {
    double t;
    const double* q;
    const double* v;
    const double* z = nullptr;
    const double* lambda = nullptr;
    const double* mu = nullptr;
    const double* v_second = nullptr;
  };

  IterationMatrix(System& system, const MatrixLayout& layout);

  int size() const { return matrix_.size; }
  /// Fills the matrix; leaves the motion of `at` in the system.
  void evaluate(const Point& at, std::span<const double> factors);
  /// Scales with `rate` [1/s] and factorises what evaluate() filled. False if singular.
  bool factorise(double rate);
  /// b := (matrix)^-1 b.
  void solve(double* b);
  void reset() { lu_->reset(); }
  const FactorCounters& counters() const { return lu_->counters(); }
  /// The unscaled matrix, for checks.
  const SparseMatrix& matrix() const { return matrix_; }
  /// As KLU saw it last.
  const SparseMatrix& scaled() const { return scaled_; }
  double reciprocal_condition() const { return lu_->reciprocal_condition(); }

 private:
  struct Stamp {
    int entry;  // in the element's block
    int slot;
    int factor;
  };
  struct Stamps {  // of one kind of block; those of element i are [first[i], first[i + 1])
    std::vector<Stamp> list;
    std::vector<std::size_t> first{0};
  };
  struct Diagonal {
    Block block;
    int row, column, factor;
    std::vector<int> slots;
  };

  void build_pattern(const MatrixLayout& layout);
  void place_diagonal(PatternBuilder& pattern, const Placement& p);
  void place_constraint(PatternBuilder& pattern, const ConstraintSlot& c, const Placement& p);
  void place_force(PatternBuilder& pattern, const ForceSlot& f, const Placement& p);
  void size_scratch();
  bool uses(Block block) const { return !stamps(block).list.empty(); }
  Stamps& stamps(Block block) { return stamps_[static_cast<std::size_t>(block)]; }
  const Stamps& stamps(Block block) const { return stamps_[static_cast<std::size_t>(block)]; }
  void add(Block block, std::size_t element, const double* values);
  void add_diagonals();
  void add_constraint(std::size_t i, const Point& at);
  void add_second_velocity(const Point& at);
  void add_force(std::size_t i);
  double unit_of(Unit unit, int i) const;
  int count(Unit unit) const;
  void calc_scaling(double rate);

  System& system_;
  SparseMatrix matrix_, scaled_;
  std::optional<SparseLU> lu_;
  std::vector<Part> rows_, columns_;
  std::vector<Diagonal> diagonals_;
  std::array<Stamps, block_count> stamps_;
  std::span<const double> factors_;
  std::vector<double> H_, K_, scratch_;
  std::vector<double> row_scale_, column_scale_;
  double mean_mass_ = 1.0;
};

}  // namespace yoke
