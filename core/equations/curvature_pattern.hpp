// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a constraint may tell of its second derivatives besides, so that matrices leave no room for zeros:
// those of a pin have two that are not zero of the 28 that its pattern of first derivatives allows.
#pragma once

namespace yoke {

class CurvaturePattern {
 public:
  virtual ~CurvaturePattern() = default;
  /// May d2 Phi / dq_j dq_l differ from zero, in any row and at any place? Local columns, symmetric.
  virtual bool is_curved(int j, int l) const = 0;
};

}  // namespace yoke
