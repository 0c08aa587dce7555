// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Lankarani and Nikravesh 1990: F = K d^n (1 + 3/4 (1 - e^2) d'/v_i) (J. Mech. Des. 112, 369-376),
// here with any elastic law F_e for K d^n.
//
// Meant for e near 1: the energy lost is set equal to that of the damper along the undamped path.
// Delivered: 0.990 for e = 0.99, 0.913 for 0.9, 0.725 for 0.5, never less than 0.66. No tension in
// a free impact. Floor on v_i: proportional_damping.hpp.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

struct LankaraniNikravesh1990 {
  double e = 1.0;                  // 0 <= e <= 1
  double slowest_approach = 1e-3;  // [m/s], > 0

  static constexpr LawField<LankaraniNikravesh1990> fields[] = {
      {"restitution", "", &LankaraniNikravesh1990::e}};

  double damping() const { return 0.75 * (1.0 - e) * (1.0 + e); }  ///< X, that is chi v_i
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_approach(in, elastic, damping(), slowest_approach);
  }
  std::string name() const { return "lankarani-nikravesh"; }
  void check() const {
    check_damped_by_approach("law 'lankarani-nikravesh'", e, 0.0, slowest_approach);
  }
};

}  // namespace yoke
