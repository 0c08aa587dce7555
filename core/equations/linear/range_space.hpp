// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The saddle system solved in the range space of the constraints,
//
//   S lambda = G M^-1 Q - gamma,   a = M^-1 (Q - G^T lambda),   S = G M^-1 G^T
//
// S has two rows for a joint where the saddle matrix has eight for a joint and its body, and is positive
// definite. What it loses are digits where light bodies sit between heavy ones: there its condition is
// that of the masses; and an acceleration that is zero comes out as the rounding of its forces. What is left
// of G a = gamma tells, and a step of refinement on the saddle system gives the digits back.
//
// Forces Q + D lambda put G^T - D in the place of G^T, and S is no longer symmetric. Where a force acts on the bodies
// of the constraint whose multipliers it depends on, the blocks are the same.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <yoke/core/equations/linear/block_lu.hpp>
#include <yoke/core/equations/linear/saddle_layout.hpp>
#include <yoke/core/equations/linear/symmetric_blocks.hpp>

namespace yoke {

/// An element of D, how the force on a coordinate depends on the multiplier of a row. Coordinate -1 or row -1: it
/// does not count.
struct LoadEntry {
  int dof, row;
};

class RangeSpace {
 public:
  /// Null where a body lacks mass, or elimination by blocks takes more than `most` multiplications.
  static std::unique_ptr<RangeSpace> by_blocks(const SaddleLayout& layout, double most);
  /// S by KLU; null where a body lacks mass, or bodies have very many joints.
  static std::unique_ptr<RangeSpace> by_klu(const SaddleLayout& layout);

  /// With the blocks `G`, without the rows marked in `dropped` [rows]. False where S is not well enough
  /// conditioned, or a number is not finite. Allocates nothing by blocks.
  bool factorise(const double* G, std::span<const char> dropped);
  /// In place, b [dofs + rows]. False: equations are not satisfied to rounding.
  bool solve(double* b);
  /// Accelerations alone, for Q = 0, up to about 1e-10 of the largest. False, and nothing is done: some pivots are
  /// small.
  bool solve_nearly(double* b);
  void restore(double* b) const;  ///< what solve() was given, after it was false
  /// What factorise() was given; of `G` only blocks that do not belong to the ground, zeros in rows that are dropped.
  void unpack(double* G, char* dropped) const;
  void reset() { factors_->reset(); }

  /// Makes room for a D with these entries, and finds their places. False where it takes other blocks than S has,
  /// or those are for KLU.
  bool make_room(std::span<const LoadEntry> entries);
  /// With D [entries], after factorise(). False where blocks in their order of elimination are not good enough.
  bool factorise_loaded(std::span<const double> D);
  /// In place, after factorise_loaded(). False where an equation is not satisfied to rounding.
  bool solve_loaded(double* b);

 private:
  struct Part {  // of two rows of a constraint, the columns of a body
    int dof;
    int source[2];  // of these rows in the array of blocks, -1: none
    int product;    // first one
  };
  struct Product {  // with a part of earlier rows for the same body
    int part;
    int place;   // of what both contribute to, in values of S
    bool first;  // nothing has been put there before
  };
  struct Node {  // two rows of S, the second may be empty
    int row[2];  // -1: none
    int part;    // first one
    int place;   // of the diagonal block in values of S
  };

  RangeSpace() = default;
  static std::unique_ptr<RangeSpace> lay_out(const SaddleLayout& layout, double most, bool klu);
  void add_nodes(const SaddleLayout& layout);
  std::vector<std::pair<int, int>> pairs() const;
  std::vector<int> parts_by_body(std::vector<int>& first) const;
  void put_in_order(const std::vector<int>& order);
  void find_products();
  void assemble(const double* G, std::span<const char> dropped);
  void assemble_loaded();
  void begin(double* b);
  void finish(double* b) const;
  void start(const double* gamma);
  double find_misfit(const double* gamma);
  void correct();
  void refine();

  int dofs_ = 0;
  std::vector<double> mobility_;  // [dofs] M^-1
  std::vector<Node> nodes_;       // and one behind the last
  std::vector<Part> parts_;       // and one behind the last
  std::vector<Product> products_;
  std::vector<int> fill_;         // places where nothing is put
  std::vector<double> G_;         // [6 for each part] three columns of two rows
  std::vector<char> counts_;      // [2 for each node] rows that are equations
  std::vector<double> diagonal_;  // [2 for each node] of S
  std::vector<double> given_, before_, lambda_, x_;
  double* a_ = nullptr;  // of the solution under way, in place of Q
  std::unique_ptr<SymmetricFactors> factors_;
  const BlockElimination* blocks_ = nullptr;  // the same, where they are blocks
  // With loads.
  std::vector<int> load_place_;  // [entries] in H_
  std::vector<double> H_;        // as G_, of G - D^T
  std::unique_ptr<BlockLu> loaded_factors_;
  bool loaded_ = false;  // the solution under way
};

}  // namespace yoke
