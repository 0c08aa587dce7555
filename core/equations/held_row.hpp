// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The row of friction that may hold, as a constraint among the others. It is there always, so that
// patterns do not change; while it does not hold its blocks are zero and its multiplier is.
#pragma once

#include <algorithm>

#include <yoke/core/constraint.hpp>
#include <yoke/core/force.hpp>

namespace yoke {

class System;

class HeldRow final : public Constraint {
 public:
  HeldRow(const System& system, std::size_t force, const ForceElement& element,
          std::vector<BodyId> bodies)
      : Constraint(element.name(), std::move(bodies), {{"stick", Measure::length}}),
        system_(system),
        force_(force),
        element_(element) {}

  void evaluate(const Motion& motion, const ConstraintRequest& out) const override;

 private:
  const System& system_;
  std::size_t force_;  // index into System::forces()
  const ForceElement& element_;
};

}  // namespace yoke
