// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Lankarani and Nikravesh 1994 (Nonlinear Dyn. 5, 193-207): loading F = K d^n, unloading
// F = F_m ((d - d_p)/(d_m - d_p))^n with d_p = d_m (1 - e^2); here with any elastic law.
//
// Meant for impacts with plastic indentation, e well below 1. Delivers e exactly and leaves the set
// d_p, where it ends without tension. e = 0 would have a vertical unloading line and is rejected.
// Reloading, lasting contact: permanent_indentation.hpp.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/permanent_indentation.hpp>
#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

struct LankaraniNikravesh1994 {
  double e = 1.0;  // least_restitution <= e <= 1

  static constexpr LawField<LankaraniNikravesh1994> fields[] = {
      {"restitution", "", &LankaraniNikravesh1994::e}};

  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return with_permanent_indentation(in, elastic, e);
  }
  double permanent_set(const ContactMemory& memory, const ElasticLaw&) const {
    return permanent_indentation(memory, e);
  }
  std::string name() const { return "lankarani-nikravesh-1994"; }
  void check() const {
    require_range("law 'lankarani-nikravesh-1994'", "e", e, least_restitution, 1.0);
  }
};

}  // namespace yoke
