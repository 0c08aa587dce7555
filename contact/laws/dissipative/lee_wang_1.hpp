// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Lee and Wang 1983, first damping function: F = F_e (1 + 3/4 alpha_1 d'), alpha_1 = (1 - e)/v_i
// the slope of e = 1 - alpha_1 v_i (J. Mech. Transm. Autom. Des. 105, 534-540). Theirs has F_e = K
// d; what follows holds for any elastic law.
//
// The factor 3/4 comes from a series cut before it converges; the energy balance of Hunt and
// Crossley gives 3/2. So the law has half the damping it needs at every e: delivered is about 1 -
// (1 - e)/2, 0.952 for e = 0.9, 0.799 for 0.5, never less than 0.66. No tension in a free impact.
// Floor on v_i: proportional_damping.hpp.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

struct LeeWang1 {
  double e = 1.0;                  // 0 <= e <= 1
  double slowest_approach = 1e-3;  // [m/s], > 0

  static constexpr LawField<LeeWang1> fields[] = {{"restitution", "", &LeeWang1::e}};

  double damping() const { return 0.75 * (1.0 - e); }  ///< X, that is chi v_i
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_approach(in, elastic, damping(), slowest_approach);
  }
  std::string name() const { return "lee-wang-1"; }
  void check() const { check_damped_by_approach("law 'lee-wang-1'", e, 0.0, slowest_approach); }
};

}  // namespace yoke
