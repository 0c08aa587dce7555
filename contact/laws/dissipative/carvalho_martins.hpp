// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Carvalho and Martins 2019: F = K d^n (1 + 3 (1 - e)(11 - e)/(2 (1 + 9 e)) d'/v_i) (Mech. Mach.
// Theory 139, 174-194), here with any elastic law. A rational fit of the exact balance in
// proportional_damping.hpp, with its limit 3/2 (1 - e) for e near 1. The original was not at hand:
// the formula is as the documentation of Exudyn quotes it (there for e > 1/3), checked against the
// exact balance.
//
// Meant for all e. Delivered: within 2e-4 of e for e >= 0.5, 0.304 for 0.3, 0.129 for 0.1, 0.061
// for 0. No tension in a free impact. Floor on v_i: proportional_damping.hpp.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

struct CarvalhoMartins {
  double e = 1.0;                  // 0 <= e <= 1
  double slowest_approach = 1e-3;  // [m/s], > 0

  static constexpr LawField<CarvalhoMartins> fields[] = {{"restitution", "", &CarvalhoMartins::e}};

  double damping() const {
    return 1.5 * (1.0 - e) * (11.0 - e) / (1.0 + 9.0 * e);
  }  ///< X, that is chi v_i
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_approach(in, elastic, damping(), slowest_approach);
  }
  std::string name() const { return "carvalho-martins"; }
  void check() const {
    check_damped_by_approach("law 'carvalho-martins'", e, 0.0, slowest_approach);
  }
};

}  // namespace yoke
