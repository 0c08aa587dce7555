// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Dry friction of Amontons and Coulomb (C.A. Coulomb, Theorie des machines simples, 1785): while the
// surfaces slide, T = mu N against the sliding; at rest whatever is needed to stay there, up to
// mu_static N. At rest it is a constraint of the equations of motion, so nothing creeps.
#pragma once

#include <string>

#include <yoke/contact/laws/friction/sliding_curve.hpp>

namespace yoke {

struct Coulomb {
  double mu = 0.0;         // [1] >= 0
  double mu_static = 0.0;  // [1] >= mu

  static constexpr FrictionField<Coulomb> fields[] = {{"mu", "", &Coulomb::mu},
                                                      {"mu_static", "", &Coulomb::mu_static}};

  FrictionOutput operator()(const FrictionInput& in) const {
    return friction_on_curve(in, {mu * in.direction, 0.0});
  }
  double holding_force(double normal_force) const { return mu_static * normal_force; }
  void check() const {
    const std::string owner = "friction '" + name() + "'";
    check_coefficients(owner, mu, mu_static);
  }
  std::string name() const { return "coulomb"; }
};

}  // namespace yoke
