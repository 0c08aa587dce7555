// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Khulief and Shabana 1986: F = F_e (1 + 3/4 (1 - e^2) d'/v_i) (J. Mech. Transm. Autom. Des. 108,
// 38-45; Mech. Mach. Theory 22, 1987, 213-224). Theirs has F_e = K d: the law of Lankarani and
// Nikravesh 1990 for n = 1. What follows holds for any elastic law.
//
// Meant for e near 1, where the loss is small against the energy of the impact. Delivered: 0.913
// for e = 0.9, 0.725 for 0.5, never less than 0.66. No tension in a free impact. Floor on v_i:
// proportional_damping.hpp.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

struct KhuliefShabana {
  double e = 1.0;                  // 0 <= e <= 1
  double slowest_approach = 1e-3;  // [m/s], > 0

  static constexpr LawField<KhuliefShabana> fields[] = {{"restitution", "", &KhuliefShabana::e}};

  double damping() const { return 0.75 * (1.0 - e) * (1.0 + e); }  ///< X, that is chi v_i
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_approach(in, elastic, damping(), slowest_approach);
  }
  std::string name() const { return "khulief-shabana"; }
  void check() const {
    check_damped_by_approach("law 'khulief-shabana'", e, 0.0, slowest_approach);
  }
};

}  // namespace yoke
