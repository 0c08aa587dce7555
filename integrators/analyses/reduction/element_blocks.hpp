// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// All derivatives of one element at a time, in room for the largest of a system.
#pragma once

#include <span>
#include <vector>

#include <yoke/core/equations/system.hpp>

namespace yoke {

/// Of a force element, row-major, k columns and nz states.
class ForceBlocks {
 public:
  explicit ForceBlocks(const System& system);
  /// At the motion set last. False, and nothing is done, for a force that depends on neither position
  /// nor velocity and has no states.
  bool evaluate(const System& system, const ForceSlot& force);

  std::vector<double> Q_q, Q_v;  // [k x k]
  std::vector<double> Q_z;       // [k x nz]
  std::vector<double> z_q, z_v;  // [nz x k]
  std::vector<double> z_z;       // [nz x nz]

 private:
  std::vector<double> Q_, rate_;
};

/// Of a constraint, row-major, r rows and k columns.
class ConstraintBlocks {
 public:
  explicit ConstraintBlocks(const System& system);
  /// At the motion set last; K for the multipliers lambda [rows of the system].
  void evaluate(const System& system, const ConstraintSlot& constraint, const double* lambda);

  std::vector<double> G, H;  // [r x k]
  std::vector<double> K;     // [k x k]
};

/// Forces that change with the reactions they make: no block says how.
class LoadCheck {
 public:
  explicit LoadCheck(const System& system);
  /// At the motion set last under the multipliers `lambda` [rows]: throws ModelError if there is one.
  void refuse(System& system, const double* lambda);

 private:
  std::vector<double> Q_, slope_;
};

}  // namespace yoke
