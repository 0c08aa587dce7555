// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// F = K d^n, dF/dd = n K d^(n-1), U = K d^(n+1)/(n+1). The unit of K depends on n, so a K taken
// from a table in millimetres goes through per_mm().
#pragma once

#include <cmath>
#include <string>

#include <yoke/contact/laws/law.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

struct PowerLaw {
  double K = 0.0;                   // [N/m^n], > 0
  double n = 1.0;                   // >= 1: below, the stiffness at first touch would be infinite
  std::string label = "power-law";  // what results and errors call it

  static constexpr LawField<PowerLaw> fields[] = {{"stiffness", "N/m^n", &PowerLaw::K}};
  PowerLaw with_fields(const double* values) const { return {values[0], n}; }

  ElasticResponse operator()(double penetration) const {
    const double secant = K * std::pow(penetration, n - 1.0);
    const double force = secant * penetration;
    return {force, n * secant, force * penetration / (n + 1.0)};
  }
  std::string name() const { return label; }
  void check() const {
    require_positive("law '" + label + "'", "K", K, "N/m^n");
    require_range("law '" + label + "'", "n", n, 1.0, 10.0);
  }
};

/// K in N/mm^n, as tables print it: F [N] = K (d [mm])^n, so K * 1000^n in N/m^n.
inline PowerLaw per_mm(double K, double n, std::string label = "power-law") {
  return {K * std::pow(1000.0, n), n, std::move(label)};
}

}  // namespace yoke
