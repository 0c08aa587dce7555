// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Gharib and Hurmuzlu 2012, second law (J. Appl. Mech. 79): compression F = K_c d^n, restitution
// F = K_r (d - d_p)^n with K_r = K_c/e^(2n), d_p = d_m (1 - e^2), e the energetic coefficient; here
// with any elastic law. Identical to Lankarani and Nikravesh 1994, since K_r (d_m - d_p)^n = K_c
// d_m^n.
//
// Meant for impacts with plastic indentation. Delivers e exactly and leaves the set d_p, where it
// ends without tension. e = 0 would have a vertical unloading line and is rejected. Reloading,
// lasting contact: permanent_indentation.hpp.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/permanent_indentation.hpp>
#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

struct GharibHurmuzlu2 {
  double e = 1.0;  // least_restitution <= e <= 1

  static constexpr LawField<GharibHurmuzlu2> fields[] = {{"restitution", "", &GharibHurmuzlu2::e}};

  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return with_permanent_indentation(in, elastic, e);
  }
  double permanent_set(const ContactMemory& memory, const ElasticLaw&) const {
    return permanent_indentation(memory, e);
  }
  std::string name() const { return "gharib-hurmuzlu-2"; }
  void check() const { require_range("law 'gharib-hurmuzlu-2'", "e", e, least_restitution, 1.0); }
};

}  // namespace yoke
